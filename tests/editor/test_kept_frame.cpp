// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <backends/imgui_impl_opengl3.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include "editor/viewport/frame_changes.h"
#include "editor/viewport/kept_frame.h"
#include "editor/viewport/offscreen.h"

namespace standpoint {
namespace {

constexpr int kWide = 400, kHigh = 300;

struct ShownWindow {
  ImVec2 at, size;
  std::string text;
  bool open = true, with_picture = false;
};

// Windows over each other and a picture, drawn once whole and once by what differs.
class KeptFrames : public ::testing::Test {
 protected:
  void SetUp() override {
    auto made = Offscreen::create(kWide, kHigh, 1);
    if (!made) GTEST_SKIP() << describe(made.error());
    offscreen_ = std::move(*made);
    glGenTextures(1, &picture_);
    paint(40);
  }
  void TearDown() override {
    if (picture_ != 0) glDeleteTextures(1, &picture_);
  }

  void paint(int grey) {
    std::array<unsigned char, 16> rgba{};
    for (std::size_t i = 0; i < rgba.size(); ++i)
      rgba[i] = i % 4 == 3 ? 255 : static_cast<unsigned char>((i * 37 + static_cast<unsigned>(grey)) % 256);
    glBindTexture(GL_TEXTURE_2D, picture_);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 2, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    repainted_.push_back({picture_, true});
  }

  const ImDrawData& layOut(float pixels = 1) {
    auto& io = ImGui::GetIO();
    io.DisplaySize = {kWide / pixels, kHigh / pixels};
    io.DisplayFramebufferScale = {pixels, pixels};
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    for (std::size_t i = 0; i < windows_.size(); ++i) {
      const ShownWindow& w = windows_[i];
      if (!w.open) continue;
      ImGui::SetNextWindowPos(w.at);
      ImGui::SetNextWindowSize(w.size);
      ImGui::Begin(("window " + std::to_string(i)).c_str(), nullptr, ImGuiWindowFlags_NoSavedSettings);
      ImGui::TextUnformatted(w.text.c_str());
      if (w.with_picture)
        ImGui::Image(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(picture_)), picture_size_);
      ImGui::End();
    }
    ImGui::Render();
    return *ImGui::GetDrawData();
  }

  std::vector<PixelRect> changes(const ImDrawData& laid_out) {
    return changes_.next(laid_out, std::exchange(repainted_, {}));
  }

  // "" or the first pixel in which the two differ.
  std::string difference(const ImDrawData& laid_out) {
    const PlainDrawing plain;
    const auto pixelsOf = [&](DrawnTexture& target, auto&& draw) {
      target.bind(kWide, kHigh);
      draw();
      return drawnPixels(kWide, kHigh).rgba;
    };
    const auto repainted = std::exchange(repainted_, {});
    const auto kept = pixelsOf(kept_target_, [&] { kept_.draw(laid_out, repainted); });
    const auto turned = pixelsOf(turned_target_, [&] { turned_.draw(laid_out, repainted); });
    const auto whole = pixelsOf(whole_target_, [&] { KeptFrame(KeptFrame::Rows::upwards).draw(laid_out, {}); });
    const auto turned_whole =
        pixelsOf(whole_target_, [&] { KeptFrame(KeptFrame::Rows::downwards).draw(laid_out, {}); });
    // In the order of a window's bytes, Mesa's rasteriser may round the blending of large rectangles otherwise.
    const auto alike = [](const auto& a, const auto& b) {
      return std::equal(a.begin(), a.end(), b.begin(), [](int x, int y) { return std::abs(x - y) <= 1; });
    };
    std::size_t otherwise = 0;  // of edges through the middle of a pixel
    for (std::size_t i = 0; i < whole.size(); ++i) otherwise += alike(turned_whole[i], whole[i]) ? 0 : 1;
    if (otherwise > whole.size() / 100) return std::to_string(otherwise) + " pixels of the turned one";
    for (std::size_t i = 0; i < whole.size(); ++i)
      if (kept[i] != whole[i] || !alike(turned[i], turned_whole[i]))
        return std::to_string(i % kWide) + ", " + std::to_string(i / kWide) + (kept[i] != whole[i] ? "" : " turned");
    return "";
  }

  std::vector<ShownWindow> windows_ = {
      {{20, 20}, {150, 120}, "one"}, {{100, 90}, {180, 150}, "two", true, true}, {{300, 10}, {80, 80}, "three"}};
  std::unique_ptr<Offscreen> offscreen_;
  GLuint picture_ = 0;
  ImVec2 picture_size_{90.3F, 70.7F};
  std::vector<Repainted> repainted_;
  FrameChanges changes_;
  KeptFrame kept_{KeptFrame::Rows::upwards}, turned_{KeptFrame::Rows::downwards};
  DrawnTexture kept_target_{GL_RGBA8}, turned_target_{GL_RGBA8}, whole_target_{GL_RGBA8};
};

TEST_F(KeptFrames, TheFirstFrameIsDrawnWholeAndNothingOfOneThatIsTheSame) {
  for (int i = 0; i < 8; ++i) layOut();  // windows find their sizes
  EXPECT_EQ(changes(layOut()), std::vector<PixelRect>({{0, 0, kWide, kHigh}}));
  EXPECT_EQ(changes(layOut()), std::vector<PixelRect>());
}

TEST_F(KeptFrames, AnotherTextIsDrawnWithinItsWindowAlone) {
  for (int i = 0; i < 8; ++i) changes(layOut());
  windows_[2].text = "four";
  const auto changed = changes(layOut());
  ASSERT_EQ(changed.size(), 1U);
  EXPECT_EQ(intersection(changed[0], {299, 9, 381, 91}), changed[0]);  // with its border
  EXPECT_FALSE(empty(changed[0]));
}

TEST_F(KeptFrames, APictureThatIsPaintedAnewIsDrawnWhereItIsShown) {
  for (int i = 0; i < 8; ++i) changes(layOut());
  paint(90);
  const auto changed = changes(layOut());
  ASSERT_EQ(changed.size(), 1U);
  EXPECT_LE(changed[0].right - changed[0].left, 92);
  EXPECT_LE(changed[0].bottom - changed[0].top, 72);
  EXPECT_GE(changed[0].right - changed[0].left, 90);
}

TEST_F(KeptFrames, ALargerWindowAndForgottenFontsAreDrawnWhole) {
  for (int i = 0; i < 8; ++i) changes(layOut());
  changes_.forget();
  EXPECT_EQ(changes(layOut()), std::vector<PixelRect>({{0, 0, kWide, kHigh}}));
  ImGui::GetIO().DisplaySize = {kWide, kHigh};
  windows_[0].open = false;
  EXPECT_EQ(changes(layOut()), std::vector<PixelRect>({{0, 0, kWide, kHigh}}));
}

// At fractions of pixels, too: the window is scaled by 1, 1.25 and 1.5.
TEST_F(KeptFrames, EveryPixelIsThatOfAFrameDrawnWhole) {
  std::mt19937 random(7);
  const auto upTo = [&](int most) { return static_cast<int>(random() % static_cast<unsigned>(most)); };
  for (const float pixels : {1.0F, 1.25F, 1.5F})
    for (int frame = 0; frame < 150; ++frame) {
      ShownWindow& w = windows_[static_cast<std::size_t>(upTo(3))];
      switch (upTo(7)) {
        case 0: w.at = {static_cast<float>(upTo(3000)) / 10, static_cast<float>(upTo(2000)) / 10}; break;
        case 1: w.size.x = 60 + static_cast<float>(upTo(1500)) / 10; break;
        case 2: w.open = !w.open; break;
        case 3: paint(upTo(256)); break;
        case 4: w.with_picture = !w.with_picture; break;
        default: w.text = std::to_string(upTo(100000)); break;
      }
      ASSERT_EQ(difference(layOut(pixels)), "") << "frame " << frame << " at " << pixels;
    }
}

// Under an opaque picture nothing is drawn: what it hides may be anything.
TEST_F(KeptFrames, WhatAnOpaquePictureHidesIsNotDrawn) {
  picture_size_ = {90, 70};  // all of each pixel that it meets
  for (int i = 0; i < 8; ++i) ASSERT_EQ(difference(layOut()), "");
  glBindTexture(GL_TEXTURE_2D, picture_);
  std::array<unsigned char, 16> clear{};  // which would let the window under it through, if that were drawn
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 2, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, clear.data());
  repainted_.push_back({picture_, true});
  EXPECT_NE(difference(layOut()), "");
  repainted_.push_back({picture_, false});
  EXPECT_EQ(difference(layOut()), "") << "it is not opaque";
}

}  // namespace
}  // namespace standpoint
