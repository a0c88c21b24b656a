// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "editor/model/view_state.h"

namespace standpoint {

// Draws scenes with VTK into a texture of the OpenGL context that is current when it is made and whenever it is used.
std::unique_ptr<SceneView> makeVtkSceneView();

}  // namespace standpoint
