// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/display_picture.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include <vtk_glew.h>

namespace standpoint {

namespace {

constexpr float kMostPixels = 512;  // of a side: more is not seen on something that is a hand wide

// Of a window or of one inside it, by its name: "panel/device_1A2B3C4D/body_5E6F7A8B".
bool belongsTo(const ImDrawList* list, const std::string& window) {
  return list->_OwnerName != nullptr && std::string_view(list->_OwnerName).starts_with(window);
}

}  // namespace

DisplayPicture::~DisplayPicture() {
  if (framebuffer_ != 0) glDeleteFramebuffers(1, &framebuffer_);
  if (texture_ != 0) glDeleteTextures(1, &texture_);
}

bool DisplayPicture::makeTarget(int width, int height) {
  if (framebuffer_ != 0 && width == width_ && height == height_) return true;
  width_ = width;
  height_ = height;
  if (texture_ == 0) glGenTextures(1, &texture_);
  if (framebuffer_ == 0) glGenFramebuffers(1, &framebuffer_);
  glBindTexture(GL_TEXTURE_2D, texture_);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
  return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

std::shared_ptr<const PixelPicture> DisplayPicture::taken(const ImDrawData& laid_out, const DrawnDisplay& display) {
  taken_ = std::chrono::steady_clock::now();
  const auto [left, top, wide, high] = display.at;
  const float scale = std::min(laid_out.FramebufferScale.x, kMostPixels / std::max({wide, high, 1.0F}));
  const int width = static_cast<int>(std::lround(wide * scale)), height = static_cast<int>(std::lround(high * scale));
  if (width < 8 || height < 8) return nullptr;
  GLint bound = 0, bound_texture = 0;
  glGetIntegerv(GL_FRAMEBUFFER_BINDING, &bound);
  glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound_texture);
  PixelPicture picture{width, height, {}};
  if (makeTarget(width, height)) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glClearColor(0.04F, 0.043F, 0.047F, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    ImDrawData part = laid_out;
    part.DisplayPos = {left, top};
    part.DisplaySize = {wide, high};
    part.FramebufferScale = {static_cast<float>(width) / wide, static_cast<float>(height) / high};
    std::vector<ImDrawList*> lists;
    for (int i = 0; i < laid_out.CmdListsCount; ++i)
      if (belongsTo(laid_out.CmdLists[i], display.window)) lists.push_back(laid_out.CmdLists[i]);
    part.CmdListsCount = static_cast<int>(lists.size());
#if IMGUI_VERSION_NUM >= 18980  // a vector since then, a pointer before
    part.CmdLists.resize(part.CmdListsCount);
    std::copy(lists.begin(), lists.end(), part.CmdLists.begin());
#else
    part.CmdLists = lists.data();
#endif
    ImGui_ImplOpenGL3_RenderDrawData(&part);
    picture.rgba.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, picture.rgba.data());
  }
  glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(bound));
  glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(bound_texture));
  if (picture.rgba.empty()) return nullptr;
  for (int row = 0; row < height / 2; ++row)  // OpenGL's first row is the lowest
    std::swap_ranges(picture.rgba.begin() + row * width, picture.rgba.begin() + (row + 1) * width,
                     picture.rgba.begin() + (height - 1 - row) * width);
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
