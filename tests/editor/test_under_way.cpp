// SPDX-License-Identifier: GPL-3.0-or-later
// Carried instruments as bodies: what they look like, and where along a trajectory they are drawn.
#include <algorithm>
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/motion/limbs.h"
#include "core/units.h"
#include "demo_verbs.h"
#include "editor/bodies/under_way.h"
#include "editor/model/trajectory_steps.h"
#include "editor/shell/actions.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/keyboard.h"
#include "editor/widgets/theme.h"
#include "item_probe.h"
#include "survey/instruments.h"
#include "tests/temporary_folder.h"

namespace standpoint {
namespace {

// Edges that are not walked once each way.
std::size_t gapsIn(const BodyMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> walked;
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = t[i], b = t[(i + 1) % 3];
      walked[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  return static_cast<std::size_t>(
      std::count_if(walked.begin(), walked.end(), [](const auto& e) { return e.second != 0; }));
}

struct Extent {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e9), high = Eigen::Vector3d::Constant(-1e9);
  explicit Extent(const BodyMesh& mesh) {
    for (const auto& p : mesh.positions) low = low.cwiseMin(p.cast<double>()), high = high.cwiseMax(p.cast<double>());
  }
};

CarriedInstrument walking(const char* instrument, const char* carrier, double height_m) {
  CarriedInstrument made;
  made.body = &carriedBodyOf(instrument);
  made.pose.translation = {0, 0, height_m};
  made.carrier = carrier;
  made.height_m = height_m;
  Pose on_floor;
  if (std::string_view(carrier) == "hand") on_floor.translation.x() = -0.4;
  made.limbs.assign(kLimbs.size(), on_floor);
  return made;
}

TEST(CarriedBodies, AreSmallClosedSolidsAroundWhereTheirBeamsBegin) {
  for (const auto& body : carriedBodies()) {
    const BodyMesh& mesh = body.look.head;
    EXPECT_EQ(gapsIn(mesh), 0U) << body.look.id;
    EXPECT_EQ(mesh.paints.size(), mesh.triangles.size()) << body.look.id;
    EXPECT_LE(mesh.triangles.size(), 1500U) << body.look.id;
    const Extent extent(mesh);
    EXPECT_NEAR(extent.low.z(), -body.look.foot_m, body.worn ? 0.2 : 0.012) << body.look.id;
    EXPECT_NEAR(extent.high.z(), body.top_m, 0.02) << body.look.id;
    EXPECT_LT(extent.low.z(), 0) << body.look.id;
    EXPECT_GT(extent.high.z(), 0) << body.look.id;
    if (body.grip_m) {
      EXPECT_LT(body.grip_m->z(), 0) << body.look.id;
      EXPECT_GT(body.grip_m->z(), -body.look.foot_m) << body.look.id;
    }
  }
}

TEST(CarriedBodies, HaveTheSizesOfTheirSheets) {
  const auto size = [](const char* id) {
    const Extent e(carriedBodyOf(id).look.head);
    return Eigen::Vector3d(e.high - e.low);
  };
  EXPECT_NEAR(size("leica-blk2go").z(), 0.279, 0.002);
  EXPECT_NEAR(size("leica-blk2go").x(), 0.08, 0.012);
  EXPECT_NEAR(size("velodyne-vlp-16").x(), 0.103, 0.004);
  EXPECT_NEAR(size("velodyne-vlp-16").z(), 0.072, 0.012) << "on a plate";
  EXPECT_NEAR(size("riegl-vux-1uav").x(), 0.227, 0.01);
  EXPECT_NEAR(size("riegl-vux-1uav").y(), 0.18, 0.002);
}

TEST(CarriedBodies, EachCarriedInstrumentHasItsOwnAndOthersABox) {
  const auto known = knownInstruments();
  ASSERT_TRUE(known);
  std::set<std::string_view> used;
  for (const auto& instrument : *known)
    if (instrument.moving) used.insert(carriedBodyOf(instrument.id).look.id);
  EXPECT_GE(used.size(), 9U);
  EXPECT_EQ(carriedBodyOf("").look.id, "generic");
  EXPECT_EQ(carriedBodyOf("leica-rtc360").look.id, "generic");
}

TEST(Bearers, StandOnTheFloorBelowTheirInstrument) {
  for (const char* carrier : {"hand", "backpack"}) {
    const Extent extent(bearerOf(walking("leica-blk2go", carrier, carrier[0] == 'h' ? 1.3 : 1.9)));
    EXPECT_NEAR(extent.low.z(), 0, 0.01) << carrier;
    EXPECT_NEAR(extent.high.z(), 1.75, 0.05) << carrier;
  }
  for (const char* carrier : {"trolley", "vehicle"}) {
    auto instrument = walking("ouster-os1-128", carrier, 2.1);
    instrument.limbs.clear();
    const BodyMesh mesh = bearerOf(instrument);
    const Extent extent(mesh);
    EXPECT_NEAR(extent.low.z(), 0, 0.01) << carrier;
    EXPECT_NEAR(extent.high.z(), 2.1 - instrument.body->look.foot_m, 0.02) << carrier << ": the mast reaches it";
    EXPECT_EQ(gapsIn(mesh), 0U) << carrier;
  }
  auto flown = walking("riegl-vux-1uav", "uav", 20);
  flown.limbs.clear();
  EXPECT_GT(Extent(bearerOf(flown)).low.z(), 19) << "in the air";
  flown.carrier = "";
  EXPECT_TRUE(bearerOf(flown).triangles.empty()) << "nobody knows";
}

TEST(Bearers, TheRightHandReachesTheHandle) {
  const auto instrument = walking("leica-blk2go", "hand", 1.3);
  const Eigen::Vector3d grip = instrument.pose * *instrument.body->grip_m;
  double nearest_m = 1e9;
  for (const auto& p : bearerOf(instrument).positions)
    nearest_m = std::min(nearest_m, (p.cast<double>() - grip).norm());
  EXPECT_LT(nearest_m, 0.05);
}

// The demo house, its ground floor cut open, and a walk through it.
class UnderWay : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
    gui.settle();
    editor.picker.wait();
    editor.workspace = Workspace::survey;
    look(editor.view.camera, StandardView::top);
    editor.view.frame_wanted = true;
    gui.frames(4);
  }
  void add(const char* name, std::vector<std::array<double, 2>> places, const char* carrier = "hand") {
    CarriedTrajectory trajectory;
    trajectory.name = name;
    trajectory.carrier = carrier;
    for (const auto& p : places) trajectory.waypoints.push_back({{p[0], p[1], 0}, 0, {}});
    auto options = changeTo(trajectory, *editor.session.document().georeference);
    options.add = std::exchange(options.change, std::nullopt);
    ASSERT_TRUE(editor.session.start(options, "Add"));
    settle();
    ASSERT_TRUE(editor.session.errors().empty()) << describe(editor.session.errors().front().error);
  }
  void settle() {
    gui.settle();
    editor.trajectory_ways.wait();
    gui.frames(3);
  }
  void choose(int trajectory) {
    editor.choose(SurveyChoice{.trajectory = trajectory});
    gui.frames(3);
  }
  std::vector<CarriedInstrument> shown() const {
    const auto state = editor.viewState();
    return state.under_way ? state.under_way->carried : std::vector<CarriedInstrument>();
  }
  Pose trueAt(double after_s) const {
    const auto& truth = editor.trajectory_ways.of(0)->motion.truth;
    return truth->pose(truth->first_s() + after_s);
  }
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor, {1400, 1300}};
};

TEST_F(UnderWay, NothingIsDrawnWithoutATrajectory) {
  EXPECT_EQ(editor.viewState().under_way, nullptr);
  EXPECT_THAT(whyNot(*findAction("play-trajectory"), editor), testing::HasSubstr("Select a trajectory"));
}

TEST_F(UnderWay, TheInstrumentIsAtTheTruePoseOfTheMomentThatIsShown) {
  add("W1", {{1, 1}, {4.2, 1}, {4.2, 5}});
  ASSERT_EQ(shown().size(), 1U);
  EXPECT_EQ(shown()[0].body->look.id, "leica-blk2go") << "which would scan there";
  EXPECT_LT((shown()[0].pose.translation - trueAt(0).translation).norm(), 1e-12) << "at the beginning";
  choose(0);
  editor.path_moment = {"W1", 3.5, false};
  const auto there = shown();
  ASSERT_EQ(there.size(), 1U);
  const Pose truth = trueAt(3.5);
  EXPECT_LT((there[0].pose.translation - truth.translation).norm(), 1e-12);
  EXPECT_LT(there[0].pose.rotation.angularDistance(truth.rotation), 1e-12) << "with gait and shaking";
  EXPECT_GT((truth.translation - trueAt(0).translation).norm(), 1);
  ASSERT_EQ(there[0].limbs.size(), kLimbs.size());
  const Eigen::Vector3d walker = there[0].limbs[0].translation;
  EXPECT_NEAR(std::hypot(walker.x() - truth.translation.x(), walker.y() - truth.translation.y()), 0.4, 0.1);
  EXPECT_EQ(editor.viewState().under_way, editor.viewState().under_way) << "the same as long as nothing changes";
}

TEST_F(UnderWay, ASlideOfTheInspectorAndTheKeysMoveIt) {
  add("W1", {{1, 1}, {4.2, 1}, {4.2, 5}});
  choose(0);
  ASSERT_NE(gui.find("###path-moment"), nullptr);
  ASSERT_TRUE(gui.click("###path-moment"));
  gui.frames(2);
  gui.type("4");
  gui.key(kKeyEnter);
  gui.frames(3);
  EXPECT_NEAR(shownMoment_s(editor), 4, 1e-9);
  gui.key(kKeyRight);
  gui.frames(2);
  EXPECT_NEAR(shownMoment_s(editor), 4.5, 1e-9);
  gui.key(kKeyLeft);
  gui.frames(2);
  gui.key(kKeyLeft);
  gui.frames(2);
  EXPECT_NEAR(shownMoment_s(editor), 3.5, 1e-9);
  EXPECT_LT((shown().at(0).pose.translation - trueAt(3.5).translation).norm(), 1e-9);
  for (int i = 0; i < 20; ++i) {
    gui.key(kKeyLeft);
    gui.frames(2);
  }
  EXPECT_EQ(shownMoment_s(editor), 0) << "not before it begins";
}

TEST_F(UnderWay, IsPlayedToTheEndAndThenFromTheBeginning) {
  add("W1", {{1, 1}, {2.2, 1}});
  choose(0);
  const double seconds = editor.trajectory_ways.of(0)->seconds;
  EXPECT_TRUE(gui.find("###play-trajectory")->label.starts_with(ICON_PLAY "  Play"));
  ASSERT_TRUE(gui.click("###play-trajectory"));
  EXPECT_TRUE(editor.path_moment.plays);
  gui.frame();
  EXPECT_TRUE(gui.find("###play-trajectory")->label.starts_with(ICON_STOP "  Stop"));
  gui.frames(3);
  const double early_s = shownMoment_s(editor);
  EXPECT_GT(early_s, 0);
  EXPECT_LT(early_s, seconds);
  stepMoment(editor, 1000);
  EXPECT_FALSE(editor.path_moment.plays);
  EXPECT_NEAR(shownMoment_s(editor), seconds, 1e-9);
  playMoments(editor);
  EXPECT_EQ(shownMoment_s(editor), 0);
  EXPECT_TRUE(editor.path_moment.plays);
  playMoments(editor);
  EXPECT_FALSE(editor.path_moment.plays);
}

TEST_F(UnderWay, TheViewGoesAlongWhileItPlaysAndIsWhereItWasAtTheEnd) {
  add("W1", {{1, 1}, {4.2, 1}, {4.2, 5}});
  choose(0);
  editor.visibility.cut_height_m = 1.5;
  const Camera before = editor.view.camera;
  ASSERT_TRUE(gui.click("###play-trajectory"));
  gui.frames(60);
  EXPECT_FALSE(editor.visibility.cut_height_m) << "it may go upstairs";
  for (int i = 0; i < 6; ++i) {
    gui.frames(15);
    ASSERT_TRUE(editor.path_moment.plays);
    const Eigen::Vector3d carried = trueAt(shownMoment_s(editor)).translation, eye = editor.view.camera.eye();
    EXPECT_LT((carried - eye).norm(), 4);
    EXPECT_GT((carried - eye).norm(), 0.5);
    EXPECT_GT(editor.view.camera.forward().dot((carried - eye).normalized()), 0.9) << "it is in the middle";
    EXPECT_TRUE(editor.picker.sees(carried, eye, editor.viewState())) << "no wall is between";
  }
  stepMoment(editor, 1000);
  gui.frames(2);
  EXPECT_EQ(editor.view.camera, before);
  EXPECT_EQ(editor.visibility.cut_height_m, 1.5);
}

// How much of the way, in the colour of the chosen one, is drawn over a pixel; `anywhere`: over any.
bool ribbonOver(ImVec2 p, bool anywhere = false) {
  const auto cross = [](ImVec2 a, ImVec2 b, ImVec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); };
  const ImU32 accent = tone::kAccent;
  const auto& drawn = *ImGui::GetDrawData();
  for (int l = 0; l < drawn.CmdListsCount; ++l) {
    const auto& list = *drawn.CmdLists[l];
    for (const auto& command : list.CmdBuffer)
      for (unsigned i = 0; i + 2 < command.ElemCount; i += 3) {
        const auto corner = [&](unsigned k) -> const ImDrawVert& {
          return list.VtxBuffer[static_cast<int>(command.VtxOffset) +
                                list.IdxBuffer[static_cast<int>(command.IdxOffset + i + k)]];
        };
        const ImU32 alpha = corner(0).col >> IM_COL32_A_SHIFT;
        if ((corner(0).col & ~IM_COL32_A_MASK) != (accent & ~IM_COL32_A_MASK) || (alpha != 215 && alpha != 70))
          continue;
        if (anywhere) return true;
        const float a = cross(corner(0).pos, corner(1).pos, p), b = cross(corner(1).pos, corner(2).pos, p),
                    c = cross(corner(2).pos, corner(0).pos, p);
        if ((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0)) return true;
      }
  }
  return false;
}

TEST_F(UnderWay, ItsWayDoesNotCoverWhoeverBearsItWhileItPlays) {
  add("W1", {{1, 1}, {4.2, 1}, {4.2, 7}});
  choose(0);
  EXPECT_TRUE(ribbonOver({}, true));
  ASSERT_TRUE(gui.click("###play-trajectory"));
  gui.frames(60);
  bool drawn = false;
  for (int i = 0; i < 12; ++i) {
    gui.frames(15);
    ASSERT_TRUE(editor.path_moment.plays);
    ASSERT_FALSE(shown().empty());
    const auto& carried = shown().at(0);
    const auto* window = ImGui::FindWindowByName("###viewport");
    drawn = drawn || ribbonOver({}, true);
    for (const double above_m : {0.4, 0.8, 1.2}) {
      Eigen::Vector3d place = carried.pose.translation;
      place.z() += above_m - carried.height_m;
      const auto pixel = project(editor.view.camera, place, editor.view.size);
      ASSERT_TRUE(pixel);
      EXPECT_FALSE(
          ribbonOver({window->Pos.x + static_cast<float>(pixel->x()), window->Pos.y + static_cast<float>(pixel->y())}))
          << above_m << " m over the floor";
    }
  }
  EXPECT_TRUE(drawn) << "it is seen around them";
}

TEST_F(UnderWay, ADragTakesTheViewWhileItPlaysOnAndEscEndsBoth) {
  add("W1", {{1, 1}, {4.2, 1}, {4.2, 5}});
  choose(0);
  const Camera before = editor.view.camera;
  ASSERT_TRUE(gui.click("###play-trajectory"));
  gui.frames(40);
  ASSERT_TRUE(editor.bearer_view.active());
  gui.key(kKeyEscape);
  gui.frames(2);
  EXPECT_FALSE(editor.path_moment.plays);
  EXPECT_EQ(editor.view.camera, before);
  EXPECT_EQ(editor.survey.trajectory, 0) << "it is still chosen";

  ASSERT_TRUE(gui.click("###play-trajectory"));
  gui.frames(40);
  const auto* window = ImGui::FindWindowByName("###viewport");
  gui.moveTo({window->Pos.x + window->Size.x / 2, window->Pos.y + window->Size.y / 2});
  gui.frame();
  ImGui::GetIO().MouseDown[0] = true;
  gui.frame();
  for (int i = 0; i < 5; ++i) {
    ImGui::GetIO().MousePos.x += 12;
    gui.frame();
  }
  ImGui::GetIO().MouseDown[0] = false;
  gui.frames(2);
  EXPECT_FALSE(editor.bearer_view.active());
  EXPECT_TRUE(editor.path_moment.plays);
  const Camera taken = editor.view.camera;
  gui.frames(10);
  EXPECT_EQ(editor.view.camera, taken);
  goBackInViews(editor);
  gui.frames(2);
  EXPECT_EQ(editor.view.camera, before);
}

TEST_F(UnderWay, TheViewStaysWhereFollowIsSwitchedOff) {
  add("W1", {{1, 1}, {4.2, 1}, {4.2, 5}});
  choose(0);
  const Camera before = editor.view.camera;
  ASSERT_TRUE(gui.click("###follow-bearer"));
  gui.frames(2);
  ASSERT_TRUE(gui.click("###play-trajectory"));
  gui.frames(40);
  EXPECT_TRUE(editor.path_moment.plays);
  EXPECT_EQ(editor.view.camera, before);
  ASSERT_TRUE(gui.click("###follow-bearer"));
  gui.frames(40);
  EXPECT_TRUE(editor.bearer_view.active()) << "while it plays, too";
}

TEST_F(UnderWay, ALookAtOneShowsAllOfItFromAboveAndCutsWhatHidesIt) {
  add("W1", {{1, 1}, {4.2, 1}, {4.2, 5}});
  choose(0);
  look(editor.view.camera, StandardView::front);
  const auto before = editor.view.camera;
  gui.frames(2);
  ASSERT_TRUE(gui.click("###look-trajectory"));
  gui.frames(2);
  const auto& camera = editor.view.camera;
  EXPECT_GT(camera.elevation_rad, 0.7) << "not edge-on";
  ASSERT_TRUE(editor.visibility.cut_height_m);
  EXPECT_NEAR(*editor.visibility.cut_height_m, kCutAboveFloor_m, 0.1);
  for (const auto& sample : editor.trajectory_ways.of(0)->samples) {
    const auto pixel = project(camera, sample.position_m, editor.view.size);
    ASSERT_TRUE(pixel);
    EXPECT_TRUE((pixel->array() > 0).all() && (pixel->array() < editor.view.size.array()).all());
  }
  goBackInViews(editor);
  EXPECT_EQ(camera, before);
  EXPECT_FALSE(editor.visibility.cut_height_m);
  editor.visibility.cut_height_m = 1.0;
  ASSERT_TRUE(gui.click("###look-trajectory"));
  EXPECT_EQ(editor.visibility.cut_height_m, 1.0) << "nothing hides it";
}

TEST_F(UnderWay, WhatIsCutAwayOrLookedOutOfIsNotDrawnNorTwoInOnePlace) {
  add("W1", {{1, 1}, {4.2, 1}});
  add("W2", {{1, 1}, {4.2, 5}}, "trolley");
  ASSERT_EQ(shown().size(), 1U) << "they begin at one place";
  choose(1);
  ASSERT_EQ(shown().size(), 1U);
  EXPECT_EQ(shown()[0].carrier, "trolley") << "the chosen one is drawn";
  EXPECT_TRUE(shown()[0].limbs.empty());
  editor.path_moment = {"W2", 3, false};
  EXPECT_EQ(shown().size(), 2U) << "now they are apart";
  editor.visibility.cut_height_m = -0.5;
  EXPECT_TRUE(shown().empty());
  editor.visibility.cut_height_m.reset();
  editor.view.camera.target = trueAt(0).translation;
  editor.view.camera.distance_m = 0.01;
  editor.view.camera.orthographic = false;
  EXPECT_EQ(shown().size(), 1U) << "one looks out of the first";
}

}  // namespace
}  // namespace standpoint
