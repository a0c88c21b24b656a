// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/panels/panels.h"

#include <algorithm>
#include <iterator>

#include "editor/widgets/icons.h"

namespace standpoint {

// A new panel is one file, which has its state and its function, and one line here: the function, id, title, icon, and
// the areas in the workspaces Environment, Optimise, Materials, Georeference, Survey, Instrument and Inspect.
#define STANDPOINT_PANELS(ROW)                                                                \
  ROW(drawMaterialsPanel, "materials", "Materials", ICON_PAINT, N, N, L, N, N, N, N)          \
  ROW(drawSurveyPanel, "survey", "Survey", ICON_STATION, N, N, N, N, L, L, L)                 \
  ROW(drawOutlinerPanel, "outliner", "Outliner", ICON_LIST, L, L, L, L, L, N, L)              \
  ROW(drawBookmarksPanel, "bookmarks", "Bookmarks", ICON_BOOKMARK, L, N, N, N, N, N, N)       \
  ROW(drawGuidePanel, "guide", "Guide", ICON_FLAG, L, L, L, L, L, L, L)                       \
  ROW(drawPointsPanel, "points", "Points", ICON_DROP, N, N, N, N, N, N, L)                    \
  ROW(drawClipPanel, "clip", "Clip", ICON_CUT, N, N, N, N, N, N, L)                           \
  ROW(drawScanPanel, "scan", "Scan", ICON_PLAY, N, N, N, N, R, N, N)                          \
  ROW(drawPlanPanel, "plan", "Plan", ICON_EYE, N, N, N, N, R, N, N)                           \
  ROW(drawInstrumentPanel, "instrument", "Instrument", ICON_TABLET, N, N, N, N, N, R, N)      \
  ROW(drawMeasurePanel, "measure", "Measure", ICON_MEASURE, N, N, N, N, N, N, R)              \
  ROW(drawWallPanel, "wall", "Wall", ICON_CROSSHAIRS, N, N, N, N, N, N, R)                    \
  ROW(drawQualityPanel, "quality", "Quality", ICON_CHECK_CIRCLE, N, N, N, N, R, R, R)         \
  ROW(drawMaterialCardPanel, "material", "Material", ICON_PAINT, N, N, R, N, N, N, N)         \
  ROW(drawVerifyPanel, "verify", "Measured", ICON_CHECK_CIRCLE, N, N, R, N, N, N, R)          \
  ROW(drawOptimisePanel, "optimise", "Optimise", ICON_COMPRESS, N, R, N, N, N, N, N)          \
  ROW(drawGeoreferencePanel, "georeference", "Georeference", ICON_GLOBE, N, N, N, R, N, N, N) \
  ROW(drawInspectorPanel, "inspector", "Inspector", ICON_INFO, R, R, R, R, R, N, R)           \
  ROW(drawCollisionPanel, "collision", "Collision", ICON_WALK, R, N, N, N, N, N, N)           \
  ROW(drawFindingsPanel, "findings", "Findings", ICON_FLAG, N, N, B, N, N, N, N)              \
  ROW(drawTargetsPanel, "targets", "Targets", ICON_TARGET, N, N, N, N, B, N, N)               \
  ROW(drawPanoramaPanel, "panorama", "Panorama", ICON_EYE, N, N, N, N, N, N, B)               \
  ROW(drawComparePanel, "compare", "Compare", ICON_COMPRESS, N, N, N, N, N, N, B)             \
  ROW(drawLogPanel, "log", "Log", ICON_LOG, B, B, B, B, B, B, B)                              \
  ROW(drawTasksPanel, "tasks", "Tasks", ICON_TASKS, B, B, B, B, B, B, B)                      \
  ROW(drawHistoryPanel, "history", "History", ICON_HISTORY, B, B, B, B, B, B, B)

#define DECLARED(function, id, title, icon, ...) void function(const Model&, PanelStates&, Actions&);
STANDPOINT_PANELS(DECLARED)
#undef DECLARED

namespace {

constexpr Area L = Area::left, R = Area::right, B = Area::bottom, N = Area::none;

#define LISTED(function, id, title, icon, ...) Panel{id, title, icon, {__VA_ARGS__}, function},
constexpr Panel kPanels[] = {STANDPOINT_PANELS(LISTED)};
#undef LISTED

}  // namespace

std::span<const Panel> panels() { return kPanels; }

Area areaOf(std::string_view panel, Workspace workspace) {
  const auto found =
      std::find_if(std::begin(kPanels), std::end(kPanels), [&](const Panel& p) { return p.id == panel; });
  return found == std::end(kPanels) ? Area::none : found->area[static_cast<std::size_t>(workspace)];
}

}  // namespace standpoint
