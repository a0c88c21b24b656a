// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "editor/points/splatter.h"
#include "editor/viewport/full_screen.h"

namespace standpoint {

// Puts a picture of points into the one that OpenGL draws, each pixel at its own depth: what of the model is nearer
// stays before them.
class PointComposer {
 public:
  PointComposer() = default;
  ~PointComposer();
  PointComposer(const PointComposer&) = delete;
  PointComposer& operator=(const PointComposer&) = delete;

  const std::string& problem() const { return program_.problem(); }
  void take(const PointPicture& picture);
  void draw() const;  // to what is bound, over its whole viewport

 private:
  static const char* const kShader;
  FullScreenProgram program_{kShader};
  GLuint colours_ = 0, depths_ = 0;
  int width_ = 0, height_ = 0;
};

}  // namespace standpoint
