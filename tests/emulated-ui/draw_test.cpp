// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <imgui.h>
#include <imgui_internal.h>

#include "emulated-ui/draw/device_view.h"
#include "emulated-ui/draw/skin.h"
#include "tests/emulated-ui/support.h"

namespace standpoint {
namespace {

// A device in a window without a display, and a finger on it.
class Draw : public testing::Test {
 protected:
  static constexpr float kWidth = 420, kHeight = 560;

  Draw() {
    ImGui::CreateContext();
    auto& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {800, 700};
    unsigned char* pixels = nullptr;
    int w = 0, h = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &w, &h);
  }
  ~Draw() override { ImGui::DestroyContext(); }

  void open(const std::string& screen) {
    ASSERT_TRUE(d.press({"power"}));
    d->tick(200);
    d->show(screen);
    frame();
    frame();
  }
  std::optional<Press> frame() {
    ImGui::GetIO().DeltaTime = 1.0F / 60;
    ImGui::NewFrame();
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize({kWidth, kHeight});
    ImGui::Begin("device", nullptr, ImGuiWindowFlags_NoDecoration);
    const auto press = drawDevice(*d, view, kWidth - 16, kHeight - 16);
    ImGui::End();
    ImGui::EndFrame();
    return press;
  }
  // The finger goes down, moves by `by`, and lifts.
  std::optional<Press> finger(ImVec2 at, float by) {
    auto& io = ImGui::GetIO();
    std::optional<Press> press;
    const auto step = [&] {
      if (auto p = frame()) press = p;
    };
    io.MousePos = at;
    step();
    io.MouseDown[0] = true;
    step();
    for (int i = 0; i < 5; ++i) {
      io.MousePos.y += by / 5;
      step();
    }
    io.MouseDown[0] = false;
    step();
    step();
    return press;
  }
  ImGuiWindow* scrolled() const {
    for (auto* window : ImGui::GetCurrentContext()->Windows)
      if (std::string(window->Name).find("/screen_") != std::string::npos && window->ScrollMax.y > 0) return window;
    return nullptr;
  }

  TestDevice d{"faro-focus"};
  DeviceView view;
};

TEST_F(Draw, AFingerMovesALongScreenAndPressesNothing) {
  open("scan_area");
  auto* window = scrolled();
  ASSERT_NE(window, nullptr) << "the page is longer than the display";
  const ImVec2 low{window->Pos.x + window->Size.x / 2, window->Pos.y + window->Size.y - 30};
  EXPECT_FALSE(finger(low, -200));
  EXPECT_NEAR(window->Scroll.y, std::min(200.0F, window->ScrollMax.y), 2);
}

TEST_F(Draw, ATapPressesWhatIsBelowIt) {
  open("manage");
  std::optional<Press> press;
  for (float y = 60; y < kHeight && !press; y += 10) press = finger({kWidth / 2, y}, 0);
  ASSERT_TRUE(press);
  EXPECT_EQ(press->widget, "scan_projects");
}

TEST_F(Draw, ATrembleIsStillATap) {
  open("manage");
  std::optional<Press> press;
  for (float y = 60; y < kHeight && !press; y += 10) press = finger({kWidth / 2, y}, 2);
  EXPECT_TRUE(press);
}

double luminance(unsigned colour) {
  const auto channel = [&](int shift) {
    const double v = (colour >> shift & 255U) / 255.0;
    return v <= 0.03928 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * channel(0) + 0.7152 * channel(8) + 0.0722 * channel(16);
}
double contrast(unsigned a, unsigned b) {
  const double la = luminance(a), lb = luminance(b);
  return (std::max(la, lb) + 0.05) / (std::min(la, lb) + 0.05);
}

// WCAG 2.1: 4.5 for text (1.4.3), 3 for what tells a control's state (1.4.11).
TEST(Skins, CanBeReadOutdoors) {
  for (const auto& s : skins()) {
    for (const auto below : {s.display, s.tile})
      for (const auto text : {s.text, s.dim, s.warning}) EXPECT_GE(contrast(text, below), 4.5) << s.name;
    EXPECT_GE(contrast(s.tile_text, s.tile_hover), 4.5) << s.name;
    EXPECT_GE(contrast(s.accent_text, s.accent), 4.5) << s.name;
    EXPECT_GE(contrast(s.key_text, s.key), 4.5) << s.name;
    EXPECT_GE(contrast(s.title_text, s.title_bar), 4.5) << s.name;
    EXPECT_GE(contrast(s.off, s.tile), 3) << s.name;
  }
}

}  // namespace
}  // namespace standpoint
