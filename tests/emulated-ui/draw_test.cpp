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

// The place of a key, and a tap on it.
std::optional<KeyCap> capOf(const Keyboard& keyboard, const std::string& key) {
  for (const auto& cap : keyCaps(keyboard.page, keyboard.width, keyboard.height, 2))
    if (cap.key == key) return cap;
  return std::nullopt;
}

class Typing : public Draw {
 protected:
  // Taps down the page until a field has the keyboard.
  void edit(const std::string& screen, const std::string& field) {
    open(screen);
    for (float y = 60; y < kHeight && view.keyboard.field != field; y += 10) (void)finger({kWidth / 2, y}, 0);
    ASSERT_EQ(view.keyboard.field, field);
    (void)frame();
  }
  std::optional<Press> key(const std::string& name) {
    const auto cap = capOf(view.keyboard, name);
    EXPECT_TRUE(cap) << name;
    if (!cap) return std::nullopt;
    return finger({view.keyboard.left + cap->x + cap->width / 2, view.keyboard.top + cap->y + cap->height / 2}, 0);
  }
};

TEST_F(Typing, AFieldBringsAKeyboardAndItsOkKeyTakesOverWhatWasTyped) {
  edit("new_project", "name");
  for (const char* name : {"shift", "h", "a", "l", "back", "l", "l", " ", "signs", "@", "letters", "7"})
    EXPECT_FALSE(key(name)) << name;
  const auto press = key("ok");
  ASSERT_TRUE(press);
  EXPECT_EQ(press->widget, "name");
  EXPECT_EQ(press->value, "Hall @7") << "what was there before was selected, and is replaced";
  (void)frame();
  EXPECT_EQ(view.keyboard.field, "") << "it goes when nothing is edited";
}

TEST_F(Typing, TheRealKeyboardGoesOnBesideIt) {
  edit("new_project", "name");
  EXPECT_FALSE(key("a"));
  ImGui::GetIO().AddInputCharactersUTF8("ü");
  EXPECT_FALSE(frame());
  EXPECT_FALSE(key("c"));
  EXPECT_FALSE(key("back"));
  EXPECT_FALSE(key("back")) << "one letter, though it has two bytes";
  EXPECT_FALSE(key("b"));
  const auto press = key("ok");
  ASSERT_TRUE(press);
  EXPECT_EQ(press->value, "ab");
}

TEST_F(Typing, AFieldForANumberHasFigures) {
  edit("scan_area", "horizontal_from");
  EXPECT_EQ(view.keyboard.page, KeyPage::figures);
  for (const char* name : {"1", "2", ".", "5"}) EXPECT_FALSE(key(name)) << name;
  const auto press = key("ok");
  ASSERT_TRUE(press);
  EXPECT_EQ(press->value, "12.5");
}

TEST_F(Typing, TheFieldStaysAboveTheKeyboard) {
  edit("scan_area", "vertical_to");
  (void)frame();
  const ImRect page = ImGui::GetCurrentContext()->ActiveIdWindow->Rect();
  EXPECT_LE(page.Max.y, view.keyboard.top + 1) << "the page ends where the keyboard begins";
  EXPECT_GE(ImGui::GetCurrentContext()->ActiveIdWindow->Scroll.y, 1) << "the last field of the page has moved up";
}

TEST(Keyboard, HasItsKeysBesideOneAnotherAndLargeEnough) {
  constexpr float kWide = 250, kGap = 2.5F;  // a display of 25 units with 10 pixels each
  for (const auto page : {KeyPage::letters, KeyPage::capitals, KeyPage::signs, KeyPage::figures}) {
    const float height = static_cast<float>(keyRows(page)) * 28.5F + kGap;
    const auto caps = keyCaps(page, kWide, height, kGap);
    for (std::size_t i = 0; i < caps.size(); ++i) {
      const auto& a = caps[i];
      EXPECT_GE(a.x, 0) << a.key;
      EXPECT_LE(a.x + a.width, kWide) << a.key;
      EXPECT_LE(a.y + a.height, height) << a.key;
      EXPECT_GE(a.width, 22) << a.key << ": nine tenths of a finger's two and a half units";
      EXPECT_GE(a.height, 25) << a.key;
      for (std::size_t j = 0; j < i; ++j) {
        const auto& b = caps[j];
        const bool beside = a.x >= b.x + b.width || b.x >= a.x + a.width;
        EXPECT_TRUE(beside || a.y >= b.y + b.height || b.y >= a.y + a.height) << a.key << ' ' << b.key;
      }
    }
  }
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
  for (const auto& device : emulatedDevices()) {
    const auto type = loadDevice(device);
    ASSERT_TRUE(type) << describe(type.error());
    const auto s = skinOf((*type)->definition.skin);
    for (const auto below : {s.display, s.tile})
      for (const auto text : {s.text, s.dim, s.warning}) EXPECT_GE(contrast(text, below), 4.5) << device.id;
    EXPECT_GE(contrast(s.tile_text, s.tile_hover), 4.5) << device.id;
    EXPECT_GE(contrast(s.accent_text, s.accent), 4.5) << device.id;
    EXPECT_GE(contrast(s.key_text, s.key), 4.5) << device.id;
    EXPECT_GE(contrast(s.title_text, s.title_bar), 4.5) << device.id;
    EXPECT_GE(contrast(s.off, s.tile), 3) << device.id;
  }
}

}  // namespace
}  // namespace standpoint
