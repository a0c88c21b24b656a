// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "editor/viewport/frame_changes.h"
#include "editor/viewport/full_screen.h"

namespace standpoint {

// The window as it was drawn last. Of the next frame only what differs is drawn: while the view turns, the panels
// beside it stay, which take a processor that draws as long as the scene does. Pixels are those of a frame that is
// drawn whole.
class KeptFrame {
 public:
  // Into the framebuffer that is drawn to. `repainted`: textures with other contents than in the frame before.
  void draw(const ImDrawData& laid_out, const std::vector<std::uint64_t>& repainted);
  void forget() { changes_.forget(); }  // of fonts, which no list of Dear ImGui tells apart, there are others

 private:
  FrameChanges changes_;
  DrawnTexture kept_{GL_RGBA8};
};

}  // namespace standpoint
