// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <imgui.h>

#include "editor/widgets/widgets.h"

namespace standpoint {

struct Editor;
class LabelBoard;

// Drawn over the picture of the scene with Dear ImGui's draw list: crisp at any scale, and no redraw of the scene.
// Stations, targets, what else has a name, and the tool's preview.
void drawMarkers(Editor& editor, ImVec2 origin, LabelBoard& labels);
void targetChip(Editor& editor);  // the kind of target that the next click puts up, while its tool is chosen
// Of a list's chip: as its label needs it, so that none is cut off, but not less, so that few changes of it move
// others.
float chipWidth(const Editor& editor, const std::string& label, float least_pt);
void drawOverlay(Editor& editor, ImVec2 origin, ImVec2 size);  // view controls, cut, cube, legend
// How to read the colours of the model, or of the points that are shown instead of it.
void drawColourLegend(Editor& editor, ImVec2 origin, ImVec2 size);
// Where the row of controls must end in which the cursor is.
float overlayEnd(const Editor& editor);
// To the next row of chips, unless the cursor is at the beginning of one.
void nextRow();
// Behind the last chip where there is room for one of this width before that end, else below.
void beside(const Editor& editor, float width);
// Behind the chip that is drawn next: what it lies on may be as light as letters and switches.
void drawChipGround(const Editor& editor, float width);
// A ground for words over the view.
void drawPlate(const Editor& editor, ImVec2 at, ImVec2 size);
// The lower right corner of the controls at the view's upper left one, as they were drawn last.
ImVec2 controlsCorner(const Editor& editor, ImVec2 origin);
// Is the pointer on one of the overlay's controls, so that the scene must not take the click?
bool overOverlay(const Editor& editor, ImVec2 origin, ImVec2 size);

}  // namespace standpoint
