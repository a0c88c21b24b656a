// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <vector>

#include "editor/model/view_state.h"
#include "editor/viewport/frame_changes.h"

namespace standpoint {

class PaintedScene : public SceneView {
 public:
  // Textures that have been drawn or filled since this was asked last.
  virtual std::vector<Repainted> takeRepainted() = 0;
};

// Draws scenes with VTK into a texture of the OpenGL context that is current when it is made and whenever it is used.
std::unique_ptr<PaintedScene> makeVtkSceneView();

std::vector<Repainted> takeRepainted(std::initializer_list<PaintedScene*> scenes);

}  // namespace standpoint
