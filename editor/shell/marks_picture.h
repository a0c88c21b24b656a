// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "editor/model/view_state.h"

namespace standpoint {

struct Editor;

// Draws what marks and names the scene in the view, measurements and the legend of its colours too, over a picture of
// it from this camera. Within a frame of Dear ImGui.
void drawMarksOver(Editor& editor, const Camera& camera, PixelPicture& picture);

}  // namespace standpoint
