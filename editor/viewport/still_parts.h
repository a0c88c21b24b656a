// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vtk_glew.h>

namespace standpoint {

// What of a scene does not move, as it was drawn: its colours and depths, to be put behind what moves instead of being
// drawn again.
class StillParts {
 public:
  StillParts() = default;
  ~StillParts();
  StillParts(const StillParts&) = delete;
  StillParts& operator=(const StillParts&) = delete;

  bool kept() const { return kept_; }
  void drop() { kept_ = false; }
  // From textures of this size. Not kept where the driver cannot.
  void keep(GLuint colours, GLuint depths, int width, int height);
  void putBack() const;  // into the framebuffer that is drawn to

 private:
  void forget();

  GLuint source_ = 0, framebuffer_ = 0, colours_ = 0, depths_ = 0;
  GLint colour_format_ = 0, depth_format_ = 0;
  int width_ = 0, height_ = 0;
  bool kept_ = false;
};

}  // namespace standpoint
