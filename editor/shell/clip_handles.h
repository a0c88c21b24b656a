// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <imgui.h>

namespace standpoint {

struct Editor;

// The faces of the clip box, to be pulled. True while the pointer is on one or pulls it.
bool dragClip(Editor& editor, ImVec2 origin, bool hovered);
void drawClip(Editor& editor, ImVec2 origin);
// The tool that puts a section through what is clicked.
void clickSection(Editor& editor);

}  // namespace standpoint
