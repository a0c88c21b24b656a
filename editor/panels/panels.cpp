// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/panels/panels.h"

#include <array>

#include "editor/panels/panels_list.h"
#include "editor/widgets/icons.h"

namespace standpoint {

namespace {

constexpr Area L = Area::left, R = Area::right, B = Area::bottom, N = Area::none;

//                                                                       Model Materials Survey Instrument
const std::array kPanels = {
    Panel{"materials", "Materials", ICON_PAINT, {N, L, N, N}, drawMaterialsPanel},
    Panel{"survey", "Survey", ICON_STATION, {N, N, L, L}, drawSurveyPanel},
    Panel{"outliner", "Outliner", ICON_LIST, {L, L, L, N}, drawOutlinerPanel},
    Panel{"scan", "Scan", ICON_PLAY, {N, N, R, N}, drawScanPanel},
    Panel{"plan", "Plan", ICON_EYE, {N, N, R, N}, drawPlanPanel},
    Panel{"instrument", "Instrument", ICON_TABLET, {N, N, N, R}, drawInstrumentPanel},
    Panel{"material", "Material", ICON_PAINT, {N, R, N, N}, drawMaterialCardPanel},
    Panel{"verify", "Measured", ICON_CHECK_CIRCLE, {N, R, N, N}, drawVerifyPanel},
    Panel{"inspector", "Inspector", ICON_INFO, {R, R, R, N}, drawInspectorPanel},
    Panel{"optimise", "Optimise", ICON_COMPRESS, {R, N, N, N}, drawOptimisePanel},
    Panel{"collision", "Collision", ICON_WALK, {R, N, N, N}, drawCollisionPanel},
    Panel{"georeference", "Place", ICON_GLOBE, {R, N, N, N}, drawGeoreferencePanel},
    Panel{"findings", "Findings", ICON_FLAG, {N, B, N, N}, drawFindingsPanel},
    Panel{"targets", "Targets", ICON_TARGET, {N, N, B, N}, drawTargetsPanel},
    Panel{"log", "Log", ICON_LOG, {B, B, B, B}, drawLogPanel},
    Panel{"tasks", "Tasks", ICON_TASKS, {B, B, B, B}, drawTasksPanel},
};

}  // namespace

std::span<const Panel> panels() { return kPanels; }

}  // namespace standpoint
