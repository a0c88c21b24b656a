// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <imgui.h>

#include "editor/model/view_state.h"
#include "editor/shell/label_board.h"

namespace standpoint {

struct Editor;

// What no station sees, over the picture: each hole hatched as it lies, on walls that a plan shows from above as a bar;
// then its area; then what the hatching means, and what is known of the hole under the pointer.
void drawHoles(Editor& editor, const ViewState& view, ImVec2 origin);
void nameHoles(Editor& editor, const ViewState& view, ImVec2 origin, LabelBoard& labels);
void drawHolesLegend(Editor& editor, ImVec2 origin, ImVec2 size, bool hovered);

}  // namespace standpoint
