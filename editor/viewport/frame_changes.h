// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <imgui.h>

namespace standpoint {

// Pixels of the window: from its upper left corner, without those of the right and the lower edge.
struct PixelRect {
  int left = 0, top = 0, right = 0, bottom = 0;
  bool operator==(const PixelRect&) const = default;
};

// A texture with other contents than in the frame before.
struct Repainted {
  std::uint64_t texture = 0;
  bool opaque = false;  // every pixel of it: it hides what is drawn before it
};

bool empty(const PixelRect& r);
PixelRect intersection(const PixelRect& a, const PixelRect& b);

PixelRect windowOf(const ImDrawData& laid_out);
// The pixels that the renderer of Dear ImGui lets a command draw to.
PixelRect drawnBy(const ImDrawCmd& command, const ImDrawData& laid_out);
// A command that may draw to just these.
ImVec4 clipRectOf(const PixelRect& pixels, const ImDrawData& laid_out);

// Which pixels of a frame may differ from those of the frame before. Not said of what lies within a list of Dear ImGui
// that differs: all that the list covers, then and now.
class FrameChanges {
 public:
  // Rectangles without a pixel in common.
  std::vector<PixelRect> next(const ImDrawData& laid_out, const std::vector<Repainted>& repainted);
  void forget() { known_ = false; }  // all of the next frame counts as changed

 private:
  struct Command {
    PixelRect drawn;
    ImTextureID texture;
    unsigned vertices_from, indices_from, count;
    bool operator==(const Command&) const = default;
  };
  struct List {
    std::string owner;
    std::vector<ImDrawVert> vertices;
    std::vector<ImDrawIdx> indices;
    std::vector<Command> commands;
    PixelRect covered;
  };
  static bool same(const List& list, const ImDrawList& now, const ImDrawData& laid_out);
  static void take(List& list, const ImDrawList& now, const ImDrawData& laid_out);
  bool sameOwners(const ImDrawData& laid_out) const;

  std::vector<List> lists_;
  PixelRect window_;
  bool known_ = false;
};

}  // namespace standpoint
