// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <imgui.h>

namespace standpoint {

struct Editor;

// In the view's upper right corner; a click turns the view to the part that was clicked.
void drawNavigationCube(Editor& editor, ImVec2 origin, ImVec2 size);
bool overNavigationCube(const Editor& editor, ImVec2 origin, ImVec2 size);  // the pointer is

// Lower left of the room that it takes.
ImVec2 navigationCubeCorner(const Editor& editor, ImVec2 origin, ImVec2 size);

}  // namespace standpoint
