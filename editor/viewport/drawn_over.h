// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "editor/model/view_state.h"

namespace standpoint {

// Puts what Dear ImGui has laid out for the size of the picture over it. Needs the OpenGL context and the renderer of
// Dear ImGui; where OpenGL cannot draw it, the picture stays as it is.
void putOver(PixelPicture& picture, ImDrawData& drawing);

}  // namespace standpoint
