// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <imgui.h>

namespace standpoint {

struct Editor;

// Whether the view is halved for what proves a mistake.
bool showsTwoClouds(const Editor& editor);
// The student's points on the left, those of the sample solution on the right; `half` is the size of each.
void drawTwoClouds(Editor& editor, ImVec2 origin, ImVec2 half);
// The place itself, in each half, over the scene.
void drawProofPlace(const Editor& editor, ImVec2 origin, ImVec2 size);

}  // namespace standpoint
