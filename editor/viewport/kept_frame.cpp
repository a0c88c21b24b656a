// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/kept_frame.h"

#include <algorithm>

#include <backends/imgui_impl_opengl3.h>

#include "editor/widgets/draw_lists.h"

namespace standpoint {

namespace {

ImDrawData upsideDown(const ImDrawData& laid_out) {
  ImDrawData turned = laid_out;
  turned.DisplayPos.y += laid_out.DisplaySize.y;
  turned.DisplaySize.y = -laid_out.DisplaySize.y;
  turned.FramebufferScale.y = -laid_out.FramebufferScale.y;
  return turned;
}
bool isUpsideDown(const ImDrawData& target) { return target.FramebufferScale.y < 0; }

// A rectangle of an opaque texture over the middle of each of these pixels: nothing that is drawn before it is seen.
bool hides(const ImDrawCmd& command, const ImDrawList& list, const PixelRect& pixels, const ImDrawData& laid_out,
           const std::set<std::uint64_t>& opaque) {
  constexpr unsigned kOfRectangle = 6;
  constexpr float kMiddle = 0.5F;
  if (command.ElemCount != kOfRectangle || command.UserCallback != nullptr ||
      !opaque.contains(reinterpret_cast<std::uintptr_t>(command.TextureId)) ||
      !(intersection(drawnBy(command, laid_out), pixels) == pixels))
    return false;
  const auto corner = [&](unsigned i) -> const ImDrawVert& {
    return list
        .VtxBuffer[static_cast<int>(command.VtxOffset) + list.IdxBuffer[static_cast<int>(command.IdxOffset + i)]];
  };
  ImVec2 low = corner(0).pos, high = low;
  for (unsigned i = 0; i < kOfRectangle; ++i) {
    const ImVec2 at = corner(i).pos;
    low = {std::min(low.x, at.x), std::min(low.y, at.y)};
    high = {std::max(high.x, at.x), std::max(high.y, at.y)};
  }
  for (unsigned i = 0; i < kOfRectangle; ++i) {
    const ImDrawVert& at = corner(i);
    const bool in_corner = (at.pos.x == low.x || at.pos.x == high.x) && (at.pos.y == low.y || at.pos.y == high.y);
    if (!in_corner || (at.col & IM_COL32_A_MASK) != IM_COL32_A_MASK) return false;
  }
  const ImVec2 scale = laid_out.FramebufferScale, from = laid_out.DisplayPos;
  return (low.x - from.x) * scale.x < static_cast<float>(pixels.left) + kMiddle &&
         (low.y - from.y) * scale.y < static_cast<float>(pixels.top) + kMiddle &&
         (high.x - from.x) * scale.x > static_cast<float>(pixels.right) - kMiddle &&
         (high.y - from.y) * scale.y > static_cast<float>(pixels.bottom) - kMiddle;
}

// Until its end, commands draw to these pixels of `target` alone, and those not at all that something opaque hides
// there.
class DrawnWithin {
 public:
  DrawnWithin(const PixelRect& pixels, const ImDrawData& laid_out, const ImDrawData& target,
              const std::set<std::uint64_t>& opaque) {
    const int height = windowOf(laid_out).bottom;
    const ImDrawCmd* first = nullptr;
    for (int i = 0; i < laid_out.CmdListsCount; ++i)
      for (const ImDrawCmd& command : laid_out.CmdLists[i]->CmdBuffer)
        if (hides(command, *laid_out.CmdLists[i], pixels, laid_out, opaque)) first = &command;
    bool seen = first == nullptr;
    for (int i = 0; i < laid_out.CmdListsCount; ++i) {
      bool any = false;
      for (ImDrawCmd& command : laid_out.CmdLists[i]->CmdBuffer) {
        seen = seen || &command == first;
        const PixelRect drawn = drawnBy(command, laid_out);
        const PixelRect within = seen ? intersection(drawn, pixels) : PixelRect();
        any = any || !empty(within);
        if (within == drawn && !isUpsideDown(target)) continue;
        changed_.push_back({&command, command.ClipRect});
        const PixelRect turned{within.left, height - within.bottom, within.right, height - within.top};
        command.ClipRect = empty(within) ? ImVec4() : clipRectOf(isUpsideDown(target) ? turned : within, target);
      }
      if (any) lists_.push_back(laid_out.CmdLists[i]);
    }
  }
  ~DrawnWithin() {
    for (const auto& [command, clip] : changed_) command->ClipRect = clip;
  }
  DrawnWithin(const DrawnWithin&) = delete;
  DrawnWithin& operator=(const DrawnWithin&) = delete;

  std::vector<ImDrawList*>& lists() { return lists_; }

 private:
  struct Changed {
    ImDrawCmd* command;
    ImVec4 clip;
  };
  std::vector<Changed> changed_;
  std::vector<ImDrawList*> lists_;
};

void clear(const PixelRect& pixels, int lowest_row) {
  glEnable(GL_SCISSOR_TEST);
  glScissor(pixels.left, lowest_row, pixels.right - pixels.left, pixels.bottom - pixels.top);
  glClearColor(0.09F, 0.10F, 0.11F, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  glDisable(GL_SCISSOR_TEST);
}

}  // namespace

void KeptFrame::forget() {
  changes_.forget();
  opaque_.clear();
}

void KeptFrame::draw(const ImDrawData& laid_out, const std::vector<Repainted>& repainted) {
  const PixelRect window = windowOf(laid_out);
  const int width = window.right, height = window.bottom;
  for (const auto& [texture, opaque] : repainted) {
    opaque_.erase(texture);
    if (opaque) opaque_.insert(texture);
  }
  const PlainDrawing plain;
  GLint shown = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &shown);
  const bool keeps = kept_.bind(width, height);
  if (!keeps) {
    glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(shown));
    changes_.forget();
  }
  const bool turns = keeps && rows_ == Rows::downwards;
  const ImDrawData target = turns ? upsideDown(laid_out) : laid_out;
  for (const PixelRect& changed : changes_.next(laid_out, repainted)) {
    clear(changed, turns ? changed.top : height - changed.bottom);
    DrawnWithin within(changed, laid_out, target, opaque_);
    DrawListsOf part(target, within.lists());
    ImGui_ImplOpenGL3_RenderDrawData(&part.data());
  }
  if (!keeps) return;
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(shown));
  glBlitFramebuffer(0, turns ? height : 0, width, turns ? 0 : height, 0, 0, width, height, GL_COLOR_BUFFER_BIT,
                    GL_NEAREST);
}

}  // namespace standpoint
