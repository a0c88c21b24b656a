// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "editor/camera/camera.h"
#include "editor/model/graphics.h"
#include "editor/viewport/full_screen.h"
#include "editor/viewport/ground_shadow.h"

namespace standpoint {

// What is behind everything: a sky above the horizon and the ground below it, with the shadow of what stands there. It
// has no depth, so it hides nothing.
class Backdrop {
 public:
  Backdrop() = default;
  ~Backdrop();
  Backdrop(const Backdrop&) = delete;
  Backdrop& operator=(const Backdrop&) = delete;

  const std::string& problem() const { return program_.problem(); }  // why it cannot be drawn; "" mostly
  void cast(const GroundShadow& shadow);                             // an empty one takes it away
  // Through a camera in perspective, over all of what is bound.
  void draw(const Camera& camera, double width_to_height, Theme theme, double ground_m) const;

 private:
  static const char* const kShader;
  FullScreenProgram program_{kShader};
  GLuint shadow_ = 0;
  double x_ = 0, y_ = 0, width_m_ = 0, height_m_ = 0;  // of the shadow; no width: there is none
};

}  // namespace standpoint
