// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/kept_frame.h"

#include <cmath>

#include <backends/imgui_impl_opengl3.h>

#include "editor/widgets/draw_lists.h"

namespace standpoint {

namespace {

// Commands draw to these pixels alone, until its end.
class DrawnWithin {
 public:
  DrawnWithin(const PixelRect& pixels, const ImDrawData& laid_out) {
    for (int i = 0; i < laid_out.CmdListsCount; ++i) {
      bool any = false;
      for (ImDrawCmd& command : laid_out.CmdLists[i]->CmdBuffer) {
        const PixelRect drawn = drawnBy(command, laid_out), within = intersection(drawn, pixels);
        if (within == drawn) {
          any = any || !empty(drawn);
          continue;
        }
        any = any || !empty(within);
        changed_.push_back({&command, command.ClipRect});
        command.ClipRect = empty(within) ? ImVec4() : clipRectOf(within, laid_out);
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

void clear(const PixelRect& pixels, int height) {
  glEnable(GL_SCISSOR_TEST);
  glScissor(pixels.left, height - pixels.bottom, pixels.right - pixels.left, pixels.bottom - pixels.top);
  glClearColor(0.09F, 0.10F, 0.11F, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  glDisable(GL_SCISSOR_TEST);
}

}  // namespace

void KeptFrame::draw(const ImDrawData& laid_out, const std::vector<std::uint64_t>& repainted) {
  const PixelRect window = windowOf(laid_out);
  const int width = window.right, height = window.bottom;
  const PlainDrawing plain;
  GLint shown = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &shown);
  const bool keeps = kept_.bind(width, height);
  if (!keeps) {
    glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(shown));
    forget();
  }
  for (const PixelRect& changed : changes_.next(laid_out, repainted)) {
    clear(changed, height);
    DrawnWithin within(changed, laid_out);
    DrawListsOf part(laid_out, within.lists());
    ImGui_ImplOpenGL3_RenderDrawData(&part.data());
  }
  if (!keeps) return;
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(shown));
  glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

}  // namespace standpoint
