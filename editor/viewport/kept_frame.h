// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "editor/viewport/frame_changes.h"
#include "editor/viewport/full_screen.h"

namespace standpoint {

// The window as it was drawn last. Of the next frame only what differs is drawn: while the view turns, the panels
// beside it stay, which take a processor that draws as long as the scene does. Pixels are those of a frame that is
// drawn whole.
class KeptFrame {
 public:
  // How the rows of the framebuffer that is drawn to lie in memory: a texture's begin at the bottom, a window's at the
  // top. What is kept in the same order is copied there byte by byte; a processor that draws would take each pixel
  // through a shader to turn it over (1280 × 800: 10 CPU-ms instead of 0.3).
  enum class Rows { upwards, downwards };
  explicit KeptFrame(Rows rows) : rows_(rows), kept_(rows == Rows::downwards ? DrawnTexture::kAsWindows : GL_RGBA8) {}

  // Into the framebuffer that is drawn to.
  void draw(const ImDrawData& laid_out, const std::vector<Repainted>& repainted);
  void forget();  // of fonts, which no list of Dear ImGui tells apart, there are others

 private:
  Rows rows_;
  FrameChanges changes_;
  std::set<std::uint64_t> opaque_;  // textures, as far as they were painted since it forgot
  DrawnTexture kept_;
};

}  // namespace standpoint
