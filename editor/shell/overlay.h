// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <imgui.h>

#include "editor/widgets/widgets.h"

namespace standpoint {

struct Editor;

// Drawn over the picture of the scene with Dear ImGui's draw list: crisp at any scale, and no redraw of the scene.
void drawMarkers(Editor& editor, ImVec2 origin);  // stations, targets, the measured distance, the tool's preview
// Of a list's chip: as its label needs it, so that none is cut off, but not less, so that few changes of it move
// others.
float chipWidth(const Editor& editor, const std::string& label, float least_pt);
void drawOverlay(Editor& editor, ImVec2 origin, ImVec2 size);  // view controls, cut, cube, legend
// A line of words over the lower edge of the view.
void drawBanner(const Editor& editor, ImVec2 origin, ImVec2 size, const ui::Text& words, float above_pt, ImU32 ground);
// A ground for words over the view: the dark gradient of the lowest level needs none.
void drawPlate(const Editor& editor, ImVec2 at, ImVec2 size);
// Is the pointer on one of the overlay's controls, so that the scene must not take the click?
bool overOverlay(const Editor& editor, ImVec2 origin, ImVec2 size);

}  // namespace standpoint
