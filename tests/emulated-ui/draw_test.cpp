// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <imgui.h>
#include <imgui_internal.h>

#include "emulated-ui/draw/skin.h"
#include "emulated-ui/layout/place.h"
#include "tests/emulated-ui/drawn.h"

namespace standpoint {
namespace {

// The phase that shows the screen; else one in which the device is on and waits.
const PhaseRow& phaseWith(const DeviceType& type, const std::string& screen) {
  const PhaseRow* waits = nullptr;
  for (const auto& phase : type.definition.phases) {
    if (phase.on && phase.screen == screen) return phase;
    if (phase.on && !phase.ends()) waits = &phase;
  }
  return *waits;
}

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

class DrawnFace : public Draw {
 protected:
  DrawnFace() { layOut("faro-focus"); }
  // The middle of a widget, by its place in the layout.
  ImVec2 middleOf(const std::string& id) {
    const auto& face = faceOf(*view.layout, d->screen().id);
    const auto [width, height] = deviceSize(*d, view, kWidth - 16, kHeight - 16);
    const float scale = width / face.box[0];
    const auto [left, top, wide, high] = face.display;
    const PlacingState state{[&](const std::string& w) { return findWidget(d->screen(), w) != nullptr; },
                             [](const Region&) { return 0; }, 40};
    for (const auto& placed :
         placeRegions(view.layout->screens.at(d->screen().id).root, {left, top, wide, high}, state))
      if (placed.region->widget == id)
        return {8 + scale * (placed.box.x + placed.box.width / 2), 8 + scale * (placed.box.y + placed.box.height / 2)};
    ADD_FAILURE() << id;
    (void)height;
    return {};
  }
};

TEST_F(DrawnFace, ATileIsPressedWhereItStands) {
  open("home");
  const auto press = finger(middleOf("parameters"), 0);
  ASSERT_TRUE(press);
  EXPECT_EQ(press->widget, "parameters");
}

TEST_F(DrawnFace, ASliderStopsAtWhatCanBeChosen) {
  open("resolution_quality");
  ImVec2 at = middleOf("resolution");
  at.y += 6;
  const auto press = finger(at, 0);
  ASSERT_TRUE(press);
  EXPECT_EQ(press->widget, "resolution");
  EXPECT_EQ(press->value, "1/8") << "the fifth of nine, in the middle";
}

TEST_F(DrawnFace, ADragOnASliderChoosesOnceWhenTheFingerLifts) {
  open("resolution_quality");
  ImVec2 at = middleOf("resolution");
  auto& io = ImGui::GetIO();
  io.MousePos = {at.x, at.y + 6};
  EXPECT_FALSE(frame());
  io.MouseDown[0] = true;
  for (int i = 0; i < 6; ++i) {
    EXPECT_FALSE(frame());
    io.MousePos.x += 40;
  }
  io.MouseDown[0] = false;
  const auto press = frame();
  ASSERT_TRUE(press);
  EXPECT_EQ(press->value, "1/32");
}

TEST(DrawnLayouts, CutNothingInAnyLanguageAtAnySize) {
  const std::filesystem::path letters = "/usr/share/fonts/opentype/inter/Inter-Regular.otf";
  if (!std::filesystem::exists(letters)) GTEST_SKIP() << "fonts-inter is not installed";
  constexpr std::array<ImWchar, 5> kRanges = {0x20, 0x17F, 0x400, 0x52F, 0};
  for (const float scale : {1.0F, 1.5F, 2.5F}) {
    ImGui::CreateContext();
    auto& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {2000, 2000};
    io.Fonts->AddFontFromFileTTF(letters.c_str(), std::round(14.5F * scale), nullptr, kRanges.data());
    unsigned char* pixels = nullptr;
    int w = 0, h = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &w, &h);
    for (const auto& device : emulatedDevices()) {
      const auto type = *loadDevice(device);
      const auto layout = std::make_shared<const Layout>(*loadLayout(device, *type));
      for (const auto& language : type->words->languages())
        for (const auto& screen : type->definition.screens) {
          Device shown = working(type, phaseWith(*type, screen.id), screen.id);
          shown.change().language = language;
          DeviceView view;
          view.layout = layout;
          io.DeltaTime = 1.0F / 60;
          ImGui::NewFrame();
          ImGui::SetNextWindowPos({0, 0});
          ImGui::SetNextWindowSize({2000, 2000});
          ImGui::Begin("device", nullptr, ImGuiWindowFlags_NoDecoration);
          (void)drawDevice(shown, view, kLayoutRoom[0] * scale, kLayoutRoom[1] * scale);
          ImGui::End();
          ImGui::EndFrame();
          EXPECT_TRUE(view.cut.empty()) << device.id << '/' << screen.id << " in " << language << " at " << scale
                                        << ": " << view.cut.front();
        }
    }
    ImGui::DestroyContext();
  }
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
