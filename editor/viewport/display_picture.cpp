// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/display_picture.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include "editor/widgets/draw_lists.h"

namespace standpoint {

namespace {

constexpr float kMostPixels = 512;  // of a side: more is not seen on something that is a hand wide

// Of a window or of one inside it, by its name: "panel/device_1A2B3C4D/body_5E6F7A8B".
bool belongsTo(const ImDrawList* list, const std::string& window) {
  return list->_OwnerName != nullptr && std::string_view(list->_OwnerName).starts_with(window);
}

}  // namespace

std::shared_ptr<const PixelPicture> DisplayPicture::taken(const ImDrawData& laid_out, const DrawnDisplay& display) {
  taken_ = std::chrono::steady_clock::now();
  const auto [left, top, wide, high] = display.at;
  const float scale = std::min(laid_out.FramebufferScale.x, kMostPixels / std::max({wide, high, 1.0F}));
  const int width = static_cast<int>(std::lround(wide * scale)), height = static_cast<int>(std::lround(high * scale));
  if (width < 8 || height < 8) return nullptr;
  const PlainDrawing plain;
  if (!target_.bind(width, height)) return nullptr;
  glClearColor(0.04F, 0.043F, 0.047F, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  ImDrawData part = laid_out;
  part.DisplayPos = {left, top};
  part.DisplaySize = {wide, high};
  part.FramebufferScale = {static_cast<float>(width) / wide, static_cast<float>(height) / high};
  std::vector<ImDrawList*> lists;
  for (int i = 0; i < laid_out.CmdListsCount; ++i)
    if (belongsTo(laid_out.CmdLists[i], display.window)) lists.push_back(laid_out.CmdLists[i]);
  ImGui_ImplOpenGL3_RenderDrawData(&DrawListsOf(part, lists).data());
  auto picture = drawnPixels(width, height);
  if (last_ == nullptr || last_->width != width || last_->height != height || last_->rgba != picture.rgba)
    last_ = std::make_shared<const PixelPicture>(std::move(picture));
  return last_;
}

bool DisplayPicture::isFresh() const {
  constexpr std::chrono::milliseconds kFresh(100);
  return last_ != nullptr && std::chrono::steady_clock::now() - taken_ < kFresh;
}

bool takeDisplay(Model& model, DisplayPicture& picture, const ImDrawData& laid_out) {
  if (!model.drawn_display || (model.held.moves && picture.isFresh())) return false;
  auto taken = picture.taken(laid_out, *model.drawn_display);
  if (taken == model.display) return false;
  model.display = std::move(taken);
  return true;
}

}  // namespace standpoint
