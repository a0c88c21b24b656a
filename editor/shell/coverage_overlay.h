// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <imgui.h>

#include "editor/model/coverage_view.h"
#include "editor/model/view_state.h"

namespace standpoint {

struct Editor;

std::optional<CoverageQuantity> coverageQuantity(ColourMode mode);

// The map of what the stations see, over the model; its legend and what is under the pointer; and its chips.
void drawCoverage(Editor& editor, ImVec2 origin, ImVec2 size);
void drawCoverageLegend(Editor& editor, ImVec2 origin, ImVec2 size);
void coverageChips(Editor& editor);

}  // namespace standpoint
