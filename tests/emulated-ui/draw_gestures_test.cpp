// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "tests/emulated-ui/drawn.h"

namespace standpoint {
namespace {

// An RTC360 with three set-ups in its job, four metres from one another from west to east.
class DrawnGestures : public Draw {
 protected:
  DrawnGestures() : Draw("leica-rtc360") { layOut("leica-rtc360"); }

  void openMap(const std::string& screen) {
    open("home");
    DeviceProject project{.name = "House"};
    for (int n = 1; n <= 3; ++n) {
      StoredSetup s;
      s.number = n;
      s.file = s.name = "Setup 00" + std::to_string(n);
      s.plan_x_m = 4 * (n - 1);
      project.setups.push_back(s);
    }
    d->change().projects = {project};
    d->change().project = 0;
    d->show(screen);
    for (int i = 0; i < 3; ++i) (void)frame();
    for (const auto* window : ImGui::GetCurrentContext()->Windows)
      if (window->Active && std::string(window->Name).find("/region") != std::string::npos &&
          window->Size.x * window->Size.y > area_) {
        area_ = window->Size.x * window->Size.y;
        at_ = window->Pos, size_ = window->Size;
      }
  }
  // The map shows 8 m from west to east between its margins, in the middle of its height.
  ImVec2 mark(int n) {
    const bool ring = d->screen().id == "align";
    const float margin = unit() + (ring ? std::min({6 * unit(), 0.3F * size_.x, 0.3F * size_.y}) : 0.6F * unit());
    const float scale = std::min((size_.x - 2 * margin) / 8, (size_.y - 2 * margin) / 2);
    return {at_.x + size_.x / 2 + scale * (4.0F * static_cast<float>(n - 1) - 4), at_.y + size_.y / 2};
  }
  float unit() {
    const auto& face = faceOf(*view.layout, d->screen().id);
    return 0.8F * face.text * std::min((kWidth - 16) / face.box[0], (kHeight - 16) / face.box[1]);
  }
  // Stays down so long; what came by then, and what came when it lifted.
  std::pair<std::vector<Press>, std::vector<Press>> hold(ImVec2 at, double seconds, ImVec2 then_by = {}) {
    auto& io = ImGui::GetIO();
    std::pair<std::vector<Press>, std::vector<Press>> presses;
    io.MousePos = at;
    (void)frame();
    io.MouseDown[0] = true;
    for (int i = 0; i < static_cast<int>(seconds * 60); ++i) {
      if (i == 10) io.MousePos = {at.x + then_by.x, at.y + then_by.y};
      if (auto p = frame()) presses.first.push_back(*p);
    }
    io.MouseDown[0] = false;
    for (int i = 0; i < 3; ++i)
      if (auto p = frame()) presses.second.push_back(*p);
    return presses;
  }
  // The middle of the key on the body.
  ImVec2 key(const std::string& widget) const {
    const auto& face = view.layout->faces.front();
    const float scale = std::min((kWidth - 16) / face.box[0], (kHeight - 16) / face.box[1]);
    for (const auto& k : face.keys)
      if (k.widget == widget)
        return {8 + (kWidth - 16 - face.box[0] * scale) / 2 + scale * (k.x + k.width / 2),
                8 + scale * (k.y + k.height / 2)};
    return {};
  }

  ImVec2 at_, size_;
  float area_ = 0;
};

TEST_F(DrawnGestures, AFingerThatStaysDownHoldsOnceAndTheLiftPressesNothing) {
  open("home");
  const auto [down, up] = hold(key("power"), 0.8);
  ASSERT_EQ(down.size(), 1U);
  EXPECT_EQ(down.front().widget, "power");
  EXPECT_EQ(down.front().by, Gesture::hold);
  EXPECT_TRUE(up.empty());
}

TEST_F(DrawnGestures, AShortPressIsATap) {
  open("home");
  const auto [down, up] = hold(key("power"), 0.3);
  EXPECT_TRUE(down.empty());
  ASSERT_EQ(up.size(), 1U);
  EXPECT_EQ(up.front().by, Gesture::tap);
}

TEST_F(DrawnGestures, TheRightButtonAndShiftEnterHoldAtOnce) {
  open("home");
  auto& io = ImGui::GetIO();
  io.MousePos = key("power");
  (void)frame();
  io.MouseDown[1] = true;
  const auto press = frame();
  io.MouseDown[1] = false;
  ASSERT_TRUE(press);
  EXPECT_EQ(press->by, Gesture::hold);
  (void)finger({4, 4}, 0);  // elsewhere
  io.MousePos = key("power");
  (void)frame();
  io.KeyMap[ImGuiKey_Enter] = 13;
  io.KeyShift = io.KeysDown[13] = true;
  const auto by_key = frame();
  ASSERT_TRUE(by_key);
  EXPECT_EQ(by_key->by, Gesture::hold);
}

TEST_F(DrawnGestures, AFingerThatMovesOffHoldsNothing) {
  open("home");
  const auto [down, up] = hold(key("power"), 1, {0, -120});
  EXPECT_TRUE(down.empty());
  EXPECT_TRUE(up.empty());
}

TEST_F(DrawnGestures, AHeldFingerThatWandersOnTheKeyHoldsNothing) {
  open("home");
  const auto [down, up] = hold(key("power"), 1, {2 * unit(), 0});
  EXPECT_TRUE(down.empty()) << "it has become a drag";
}

TEST_F(DrawnGestures, ARingGrowsAboutTheFingerMeanwhile) {
  open("home");
  const auto ring = [] { return ImGui::GetForegroundDrawList()->VtxBuffer.Size; };
  auto& io = ImGui::GetIO();
  io.MousePos = key("power");
  (void)frame();
  io.MouseDown[0] = true;
  for (int i = 0; i < 4; ++i) (void)frame();
  EXPECT_EQ(ring(), 0) << "not for a tap";
  for (int i = 0; i < 12; ++i) (void)frame();
  const int early = ring();
  EXPECT_GT(early, 0);
  for (int i = 0; i < 12; ++i) (void)frame();
  EXPECT_GT(ring(), early);
  for (int i = 0; i < 12; ++i) (void)frame();
  EXPECT_EQ(ring(), 0) << "it is done";
}

TEST_F(DrawnGestures, ATapOnAMarkPressesIt) {
  openMap("link");
  const auto press = drag(mark(2), mark(2));
  ASSERT_TRUE(press);
  EXPECT_EQ(press->widget, "plan");
  EXPECT_EQ(press->value, "1");
  EXPECT_EQ(press->by, Gesture::tap);
}

TEST_F(DrawnGestures, ALineFromMarkToMarkJoinsThemAndOneIntoNothingDoesNot) {
  openMap("link");
  const auto press = drag(mark(3), mark(1));
  ASSERT_TRUE(press);
  EXPECT_EQ(press->value, "2,0");
  EXPECT_EQ(press->by, Gesture::join);
  EXPECT_FALSE(drag(mark(3), {mark(2).x, mark(2).y - 60}));
  EXPECT_EQ(view.maps.begin()->second.x, 0) << "a line does not move the map";
}

TEST_F(DrawnGestures, TheGroundStillMovesTheMap) {
  openMap("link");
  EXPECT_FALSE(drag({mark(2).x, mark(2).y - 50}, {mark(2).x + 40, mark(2).y - 50}));
  EXPECT_GT(view.maps.begin()->second.x, 0.05F);
}

TEST_F(DrawnGestures, AHeldMarkAndAHeldLinkAreTwoThings) {
  openMap("link");
  const auto on_mark = hold(mark(2), 0.8).first;
  ASSERT_EQ(on_mark.size(), 1U);
  EXPECT_EQ(on_mark.front().by, Gesture::hold);
  EXPECT_EQ(on_mark.front().value, "1");
  d->project()->setups[2].link = LinkResult{true, 0.002, 0.6, 0, 0};
  const ImVec2 between{(mark(2).x + mark(3).x) / 2, mark(2).y};
  const auto on_link = hold(between, 0.8).first;
  ASSERT_EQ(on_link.size(), 1U);
  EXPECT_EQ(on_link.front().by, Gesture::part);
  EXPECT_EQ(on_link.front().value, "2");
}

TEST_F(DrawnGestures, TheCloudIsMovedInItsRingByMetres) {
  openMap("align");
  const float metre = (mark(3).x - mark(1).x) / 8;
  const ImVec2 m = mark(3);
  const auto press = drag(m, {m.x - metre, m.y - metre / 2});
  ASSERT_TRUE(press);
  EXPECT_EQ(press->by, Gesture::lay);
  double x = 0, y = 0, turn = 0;
  ASSERT_EQ(std::sscanf(press->value.c_str(), "%lf,%lf,%lf", &x, &y, &turn), 3);
  EXPECT_NEAR(x, -1, 0.05);
  EXPECT_NEAR(y, 0.5, 0.05) << "north is up";
  EXPECT_EQ(turn, 0);
}

TEST_F(DrawnGestures, TheRingTurnsItAnticlockwiseAboutItsSetup) {
  openMap("align");
  const float r = std::min({6 * unit(), 0.3F * size_.x, 0.3F * size_.y});
  const ImVec2 m = mark(3);
  const auto press = drag({m.x - r, m.y}, {m.x, m.y + r});
  ASSERT_TRUE(press);
  double x = 0, y = 0, turn = 0;
  ASSERT_EQ(std::sscanf(press->value.c_str(), "%lf,%lf,%lf", &x, &y, &turn), 3);
  EXPECT_EQ(x, 0);
  EXPECT_NEAR(turn, 90, 1);
}

// A picture of 8 x 4 cells under the cross.
class DrawnCross : public DrawnGestures {
 protected:
  void openCross() {
    openMap("targets");
    for (auto& setup : d->project()->setups) setup.points = 1000, setup.preview = smallPreview();
    d->change().shown = 2;
    ASSERT_TRUE(d.press({"pick_targets"}));
    for (int i = 0; i < 3; ++i) (void)frame();
    const auto& io = ImGui::GetIO();
    middle_ = {0, 0};
    // The largest part of the screen holds the picture; its middle is found by where a drag begins.
    for (float y = 0; y < io.DisplaySize.y && middle_.x == 0; y += 6)
      for (float x = 0; x < kWidth && middle_.x == 0; x += 6)
        if (const auto press = drag({x, y}, {x + 12, y}); press && press->widget == "pick_view")
          middle_ = {x + 30, y + 30};
  }
  static std::pair<double, double> uv(const Press& press) {
    double u = 0, v = 0;
    EXPECT_EQ(std::sscanf(press.value.c_str(), "%lf,%lf", &u, &v), 2);
    return {u, v};
  }
  ImVec2 middle_;
};

TEST_F(DrawnCross, APictureIsDraggedUnderItAndTheAimIsWhatLiesThere) {
  openCross();
  ASSERT_GT(middle_.x, 0);
  const auto press = drag(middle_, {middle_.x - 10, middle_.y});
  ASSERT_TRUE(press);
  EXPECT_EQ(press->widget, "pick_view");
  EXPECT_GT(uv(*press).first, 0.5) << "what lay to the right has come";
  EXPECT_NEAR(uv(*press).second, 0.5, 1e-6);
}

TEST_F(DrawnCross, ATapBringsWhatItIsOnUnderTheCross) {
  openCross();
  ASSERT_GT(middle_.x, 0);
  d->change().entries["aim"] = "0.50000,0.50000";
  const auto there = drag(middle_, middle_);
  ASSERT_TRUE(there);
  EXPECT_EQ(there->widget, "pick_view");
  const auto [u, v] = uv(*there);
  EXPECT_GT(std::hypot(u - 0.5, v - 0.5), 0.01) << "the finger was not in the middle";
  d->change().entries["aim"] = there->value;
  // The picture has come by as much as the finger was off: the same tap again is as far from there.
  const auto again = drag(middle_, middle_);
  ASSERT_TRUE(again);
  EXPECT_NEAR(std::remainder(uv(*again).first - u - (u - 0.5), 1), 0, 1e-4);
}

TEST_F(DrawnCross, AnArrowKeyNudgesByACellAndGoesRoundAtTheEdgeWhereverThePointerIs) {
  openCross();
  ASSERT_GT(middle_.x, 0);
  d->change().entries["aim"] = "0.93750,0.50000";  // the last of the eight columns
  auto& io = ImGui::GetIO();
  io.MousePos = {1, 1};
  io.KeyMap[ImGuiKey_RightArrow] = 14;
  (void)frame();
  io.KeysDown[14] = true;
  const auto press = frame();
  io.KeysDown[14] = false;
  ASSERT_TRUE(press);
  EXPECT_EQ(press->widget, "pick_view");
  EXPECT_NEAR(uv(*press).first, 0.0625, 1e-4);
  EXPECT_NEAR(uv(*press).second, 0.5, 1e-4);
}

}  // namespace
}  // namespace standpoint
