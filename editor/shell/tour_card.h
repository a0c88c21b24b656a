// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <imgui.h>

namespace standpoint {

struct Editor;

// Opens the sample house and begins the first steps.
void beginTour(Editor& editor);

// The step of the tour that is to be done, at the upper left of the view.
void drawTour(Editor& editor, ImVec2 origin, ImVec2 size);

}  // namespace standpoint
