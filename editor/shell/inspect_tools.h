// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <imgui.h>

namespace standpoint {

struct Editor;
class LabelBoard;

// The tools that measure in the model and in clouds.
bool measures(const Editor& editor);  // one of them is taken
// Once a frame before clicks: what is under the pointer, and the keys that end or shorten a polygon.
void followInspectTools(Editor& editor, ImVec2 origin, bool hovered);
void clickMeasure(Editor& editor);
void clickWall(Editor& editor);
// Measurements, and the wall that was measured.
void drawInspectMarks(Editor& editor, ImVec2 origin, LabelBoard& labels);

}  // namespace standpoint
