// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/units.h"
#include "demo_verbs.h"
#include "editor/model/station_steps.h"
#include "editor/shell/actions.h"
#include "editor/shell/banners.h"
#include "editor/shell/overlay.h"
#include "editor/shell/place_ghost.h"
#include "editor/widgets/keyboard.h"
#include "item_probe.h"
#include "survey/stations/levelling.h"

namespace standpoint {
namespace {

// The demo house from above, its ground floor cut open: S1 at (3.2, 2), S2 beyond a partition at x = 5.
class Placing : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
    gui.settle();
    editor.picker.wait();
    editor.workspace = Workspace::survey;
    editor.visibility.cut_height_m = 1.5;
    look(editor.view.camera, StandardView::top);
    editor.view.camera.orthographic = true;
    editor.view.frame_wanted = true;
    gui.frames(4);
    ASSERT_TRUE(editor.placement.ready());
  }
  const Job& job() const { return *editor.session.document().job; }
  ImVec2 screenOf(const Eigen::Vector3d& point) const {
    const auto pixel = project(editor.view.camera, point, editor.view.size);
    const auto* window = ImGui::FindWindowByName("###viewport");
    return {window->Pos.x + static_cast<float>(pixel->x()), window->Pos.y + static_cast<float>(pixel->y())};
  }
  void hold(bool down) {
    ImGui::GetIO().MouseDown[0] = down;
    gui.frames(2);
  }
  void drag(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    gui.moveTo(screenOf(from));
    hold(true);
    gui.moveTo(screenOf((from + to) / 2));
    gui.moveTo(screenOf(to));
    gui.frames(2);
  }
  PlaceVerdict verdict() {
    const auto held = heldStation(editor);
    return held ? verdictUnderPointer(editor, *held) : PlaceVerdict{Verdict::unknown, "", ""};
  }
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor};
};

TEST_F(Placing, ShiftTHoldsANewStationUnderThePointerWithItsVerdict) {
  gui.key('T', false, true);
  ASSERT_EQ(editor.view.tool, Tool::placeStation);
  gui.moveTo(screenOf({1.5, 6, 0}));
  EXPECT_EQ(verdict().verdict, Verdict::good) << verdict().brief;
  gui.moveTo(screenOf({0.45, 2, 0}));
  EXPECT_EQ(verdict().verdict, Verdict::bad);
  EXPECT_THAT(verdict().brief, testing::MatchesRegex("1[456] cm from wall")) << "by the pixel";
}

TEST_F(Placing, AStationThatHasJustBeenAddedIsNotJudgedAgainUntilThePointerLeavesIt) {
  invoke(editor, "add-station");
  gui.moveTo(screenOf({1.5, 6, 0}));
  gui.press();
  gui.settle();
  ASSERT_EQ(job().stations.size(), 3U);
  EXPECT_FALSE(heldStation(editor)) << "it would say: 0 cm from S3";
  gui.moveTo(screenOf({2.5, 6, 0}));
  EXPECT_TRUE(heldStation(editor));
}

TEST_F(Placing, AStationIsAddedByTypedNumbersWithoutAClickInTheView) {
  invoke(editor, "add-station-at");
  gui.frames(4);
  const Eigen::Vector3d shift = editor.shift_m();
  gui.type(fmt::format("{}-0.35", 1.85 + shift.x()));  // the first field has the keyboard
  gui.key(kKeyTab);
  gui.frames(3);
  gui.type(fmt::format("{}", 6 + shift.y()));
  gui.key(kKeyEnter);
  gui.frames(4);
  ASSERT_TRUE(editor.view.typed_station) << "the view shows it there";
  EXPECT_NEAR((editor.view.typed_station->centre - Eigen::Vector3d(1.5, 6, 1.6)).norm(), 0, 1e-6)
      << "on the floor there";
  EXPECT_TRUE(gui.says("Good place"));
  ASSERT_TRUE(gui.click("###add-typed"));
  gui.settle();
  gui.frames(2);
  ASSERT_EQ(job().stations.size(), 3U);
  EXPECT_NEAR((job().stations[2].true_pose.translation - Eigen::Vector3d(1.5, 6, 1.6)).norm(), 0, 1e-6);
  EXPECT_EQ(editor.survey.station, 2);
  EXPECT_EQ(editor.view.tool, Tool::select);
}

TEST_F(Placing, NumbersOfANewStationFollowThePointerUntilTheyAreTyped) {
  invoke(editor, "add-station");
  gui.moveTo(screenOf({1.5, 6, 0}));
  gui.frames(2);
  const Eigen::Vector3d pointed = editor.view.hover->position;
  ASSERT_TRUE(gui.click("###new-station-Y"));
  gui.type(fmt::format("{}", 5 + editor.shift_m().y()));
  gui.key(kKeyEnter);
  gui.frames(3);
  ASSERT_TRUE(editor.view.typed_station);
  EXPECT_NEAR(editor.view.typed_station->centre.x(), pointed.x(), 0.2) << "where the pointer left the view";
  EXPECT_NEAR(editor.view.typed_station->centre.y(), 5, 1e-6);
}

TEST_F(Placing, NumbersOfANewStationKeepTheLastPlaceWhereOneCanStand) {
  invoke(editor, "add-station");
  gui.moveTo(screenOf({1.5, 6, 0}));
  gui.frames(2);
  gui.moveTo(screenOf({0.45, 2, 0}));  // on the way to the panel, 15 cm from a wall
  gui.frames(2);
  ASSERT_TRUE(gui.click("###new-station-Y"));
  gui.type(fmt::format("{}", 5 + editor.shift_m().y()));
  gui.key(kKeyEnter);
  gui.frames(3);
  ASSERT_TRUE(editor.view.typed_station);
  EXPECT_NEAR(editor.view.typed_station->centre.x(), 1.5, 0.2);
}

TEST_F(Placing, ATypedPlaceThatIsRefusedSaysSoAndAddsNothing) {
  invoke(editor, "add-station-at");
  gui.frames(4);
  gui.type(fmt::format("{}", 0.45 + editor.shift_m().x()));
  gui.key(kKeyTab);
  gui.frames(3);
  gui.type(fmt::format("{}", 2 + editor.shift_m().y()));
  gui.key(kKeyEnter);
  gui.frames(4);
  EXPECT_TRUE(gui.says("cm from wall"));
  ASSERT_NE(gui.find("###add-typed"), nullptr);
  EXPECT_TRUE(gui.find("###add-typed")->disabled);
}

TEST_F(Placing, APlaceThatIsTypedIntoAWallKeepsItsHeight) {
  invoke(editor, "add-station-at");
  gui.frames(4);
  gui.type(fmt::format("{}", 0.1 + editor.shift_m().x()));
  gui.key(kKeyTab);
  gui.frames(3);
  gui.type(fmt::format("{}", 2 + editor.shift_m().y()));
  gui.key(kKeyEnter);
  gui.frames(4);
  ASSERT_TRUE(editor.view.typed_station);
  EXPECT_NEAR((editor.view.typed_station->centre - Eigen::Vector3d(0.1, 2, 1.6)).norm(), 0, 1e-6)
      << "not on the roof above it";
  EXPECT_TRUE(gui.find("###add-typed")->disabled);
}

TEST_F(Placing, NoStationIsAddedWhereTheTripodOfAnotherStands) {
  invoke(editor, "add-station-at");
  gui.frames(4);
  const Eigen::Vector3d taken = job().stations[0].true_pose.translation + editor.shift_m();
  gui.type(fmt::format("{}", taken.x() + 0.1));
  gui.key(kKeyTab);
  gui.frames(3);
  gui.type(fmt::format("{}", taken.y()));
  gui.key(kKeyEnter);
  gui.frames(4);
  EXPECT_TRUE(gui.says("Bad: S1 stands there"));
  EXPECT_TRUE(gui.find("###add-typed")->disabled);
}

TEST_F(Placing, ANumberThatCannotBeReadTakesTheVerdictOfThePlaceBeforeAway) {
  invoke(editor, "add-station-at");
  gui.frames(4);
  gui.type(fmt::format("{}", 1.5 + editor.shift_m().x()));
  gui.key(kKeyTab);
  gui.frames(3);
  gui.type(fmt::format("{}", 6 + editor.shift_m().y()));
  gui.key(kKeyEnter);
  gui.frames(4);
  ASSERT_TRUE(gui.says("Good place"));
  ASSERT_TRUE(gui.click("###new-station-X"));
  gui.type("three");
  gui.key(kKeyEnter);
  gui.frames(4);
  EXPECT_FALSE(gui.says("Good place")) << "neither in the panel nor in the view";
  EXPECT_TRUE(gui.find("###add-typed")->disabled);
  ASSERT_TRUE(gui.click("###new-station-X"));
  gui.type(fmt::format("{}", 1.5 + editor.shift_m().x()));
  gui.key(kKeyEnter);
  gui.frames(4);
  EXPECT_TRUE(gui.says("Good place"));
  EXPECT_FALSE(gui.find("###add-typed")->disabled);
}

TEST_F(Placing, TheInspectorSaysOfAPlaceThatIsRefusedWhatIsWrongThereAndNotHowTheOldOneWas) {
  editor.choose({.station = 0});
  gui.frames(4);
  ASSERT_TRUE(gui.says("Good place"));
  const auto before = job().stations[0].true_pose.translation;
  ASSERT_TRUE(gui.click("###inspected-X"));
  gui.type(fmt::format("{}", 0.2 + editor.shift_m().x()));  // in the wall
  gui.key(kKeyEnter);
  gui.settle();
  gui.frames(3);
  EXPECT_EQ(job().stations[0].true_pose.translation, before);
  EXPECT_FALSE(gui.says("Good place"));
  ASSERT_TRUE(gui.click("###revert-inspected"));
  gui.frames(3);
  EXPECT_TRUE(gui.says("Good place"));
}

TEST_F(Placing, WordsOverTheViewGoUpWhereThePointerComesNearThem) {
  const ImVec2 origin(300, 60), size(600, 500), text(240, 16);
  const auto heightFor = [&](ImVec2 pointer) {
    ImGui::GetIO().MousePos = pointer;
    return bannersPlace(editor, origin, size, text).y;
  };
  const float low = heightFor({400, 200});
  EXPECT_EQ(low, origin.y + size.y - 16 - editor.px(26));
  EXPECT_EQ(heightFor({320, low}), low) << "beside them";
  EXPECT_EQ(heightFor({600, 700}), low) << "in the panel below";
  EXPECT_LT(heightFor({600, low + 5}), origin.y + 200);
  EXPECT_LT(heightFor({700, low - editor.px(50)}), origin.y + 200);
  EXPECT_GT(heightFor({600, low + 5}), origin.y + editor.overlay_size.y()) << "not over the view's controls";
}

TEST_F(Placing, ACutThatIsChosenInsideTheBuildingIsSeenFromOutside) {
  editor.visibility.cut_height_m.reset();
  editor.view.camera = {.target = {3, 4, 1.6}, .distance_m = 1, .azimuth_rad = 0, .elevation_rad = 0};
  gui.frames(2);
  ASSERT_TRUE(gui.click("###cut"));
  gui.frames(2);
  ASSERT_TRUE(gui.click("###storey0"));
  gui.frames(2);
  ASSERT_TRUE(editor.visibility.cut_height_m);
  EXPECT_GT(editor.view.camera.eye().z(), 3);
  const auto outside = editor.view.camera;
  ASSERT_TRUE(gui.click("###cut"));
  gui.frames(2);
  ASSERT_TRUE(gui.click("###storey0"));
  gui.frames(2);
  EXPECT_EQ(editor.view.camera.eye(), outside.eye()) << "who looks from outside stays there";
}

TEST_F(Placing, RoomsThatAClipBoxTakesAwayTakeTheirNamesWithThem) {
  ASSERT_TRUE(gui.says("Living room"));
  editor.view.clip.box = clipAround({{6, 0, 0}, {8, 2, 2}}, 0);
  gui.frames(2);
  EXPECT_FALSE(gui.says("Living room"));
}

TEST_F(Placing, AClickOnARefusedPlaceAddsNothingAndOpensNothing) {
  invoke(editor, "add-station");
  gui.moveTo(screenOf({0.45, 2, 0}));
  gui.press();
  gui.settle();
  EXPECT_EQ(job().stations.size(), 2U);
  EXPECT_TRUE(editor.session.errors().empty());
  EXPECT_EQ(ImGui::GetCurrentContext()->OpenPopupStack.Size, 0);
  ASSERT_TRUE(editor.view.refused_place);
  EXPECT_THAT(editor.view.refused_place->brief, testing::EndsWith("cm from wall"));
  EXPECT_EQ(editor.view.tool, Tool::placeStation) << "to try another place";
}

TEST_F(Placing, EscTakesARefusalAwayAndTheFirstEndOfARowBeforeItsTool) {
  editor.view.tool = Tool::placeRow;
  editor.view.row_from = Eigen::Vector3d(1, 1, 0);
  editor.view.refused_place = RefusedPlace{};
  gui.key(kKeyEscape);
  gui.frames(2);
  EXPECT_FALSE(editor.view.row_from || editor.view.refused_place);
  EXPECT_EQ(editor.view.tool, Tool::placeRow);
  gui.key(kKeyEscape);
  gui.frames(2);
  EXPECT_EQ(editor.view.tool, Tool::select);
}

TEST_F(Placing, FiguresFollowThePointerAndBelongToTheNewestPlaceInTheEnd) {
  invoke(editor, "add-station");
  gui.moveTo(screenOf({1.5, 6, 0}));
  gui.frames(2);
  editor.place_figures.wait();
  gui.frames(2);
  ASSERT_NE(editor.place_figures.forecast(), nullptr);
  EXPECT_FALSE(editor.place_figures.old());
  const auto first = *editor.place_figures.forecast();
  ASSERT_TRUE(first.near_seen && first.spacing_m && first.incidence_rad);
  EXPECT_EQ(first.overlaps.size(), 2U);
  EXPECT_EQ(first.overlaps[0].station, "S1");
  for (const double x : {2.0, 3.0, 4.0, 4.5}) {
    gui.moveTo(screenOf({x, 1.2, 0}));
    gui.frame();
  }
  EXPECT_NE(editor.place_figures.forecast(), nullptr) << "the last known stay, marked as old";
  editor.place_figures.wait();
  gui.frames(2);
  EXPECT_FALSE(editor.place_figures.old());
  EXPECT_NE(editor.place_figures.forecast()->model_seen, first.model_seen);
}

TEST_F(Placing, ThereAreNoFiguresOfARefusedPlace) {
  invoke(editor, "add-station");
  gui.moveTo(screenOf({1.5, 6, 0}));
  gui.frames(2);
  editor.place_figures.wait();
  gui.moveTo(screenOf({0.45, 2, 0}));
  gui.frames(2);
  EXPECT_EQ(editor.place_figures.forecast(), nullptr);
}

TEST_F(Placing, ADraggedStationMovesWhereItIsLetGo) {
  drag(job().stations[0].true_pose.translation, {1.5, 6, 0});
  ASSERT_TRUE(heldStation(editor));
  EXPECT_EQ(heldStation(editor)->name, "S1");
  hold(false);
  gui.settle();
  EXPECT_NEAR(job().stations[0].true_pose.translation.x(), 1.5, 0.05);
  EXPECT_TRUE(editor.session.errors().empty());
  editor.session.undo();
  EXPECT_NEAR(job().stations[0].true_pose.translation.x(), 3.2, 1e-9);
}

TEST_F(Placing, ARightClickOnAStationOffersWhatCanBeDoneWithIt) {
  gui.moveTo(screenOf(job().stations[0].true_pose.translation));
  gui.press(1);
  gui.frames(2);
  EXPECT_TRUE(ImGui::IsPopupOpen("###station-menu", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel));
  EXPECT_EQ(editor.survey.station, 0);
  EXPECT_TRUE(editor.selection.empty()) << "not the floor under it";
  EXPECT_NE(gui.find("###look-from-station"), nullptr);
}

TEST_F(Placing, TheNextTargetIsOfTheKindThatIsChosen) {
  const auto before = job().targets.size();
  const auto* kinds = editor.target_list.kinds();
  ASSERT_NE(kinds, nullptr);
  const auto flat = std::find_if(kinds->articles.begin(), kinds->articles.end(),
                                 [](const auto& a) { return a.shape == TargetKind::checkerboard; });
  ASSERT_NE(flat, kinds->articles.end());
  gui.frames(2);
  EXPECT_EQ(gui.find("###target-article"), nullptr);
  ASSERT_TRUE(invoke(editor, "add-target"));
  gui.frames(2);
  ASSERT_TRUE(gui.click("###target-article"));
  gui.frames(2);
  ASSERT_TRUE(gui.click(flat->label));
  gui.frames(2);
  gui.moveTo(screenOf({2, 6, 0}));
  gui.press();
  gui.settle();
  ASSERT_EQ(job().targets.size(), before + 1);
  EXPECT_EQ(job().targets.back().kind, TargetKind::checkerboard);
  EXPECT_DOUBLE_EQ(job().targets.back().size_m, flat->size_m);
}

TEST_F(Placing, LetGoOnARefusedPlaceItStaysAndTheInspectorSaysWhy) {
  const auto before = job().stations[0].true_pose.translation;
  drag(before, {0.45, 2, 0});
  EXPECT_EQ(verdict().verdict, Verdict::bad);
  hold(false);
  gui.settle();
  EXPECT_EQ(job().stations[0].true_pose.translation, before);
  EXPECT_TRUE(editor.session.errors().empty());
  EXPECT_EQ(ImGui::GetCurrentContext()->OpenPopupStack.Size, 0);
  ASSERT_TRUE(editor.view.refused_place);
  EXPECT_EQ(editor.view.refused_place->station, "S1");
  EXPECT_NE(editor.view.refused_place->reason.find("clearance"), std::string::npos);
  gui.moveTo(screenOf({8, 7, 0}));
  gui.press();
  EXPECT_FALSE(editor.view.refused_place) << "the next click takes the message away";
}

TEST_F(Placing, AClickOnAStationIsNoDrag) {
  const auto before = job().stations[0].true_pose.translation;
  gui.moveTo(screenOf(before));
  hold(true);
  EXPECT_FALSE(heldStation(editor));
  hold(false);
  gui.settle();
  EXPECT_EQ(job().stations[0].true_pose.translation, before);
  EXPECT_EQ(editor.survey.station, 0);
}

TEST_F(Placing, WhatTheVerbRefusesIsSaidInTheViewAndNotInADialog) {
  ASSERT_TRUE(editor.session.start("station", {{"add", "S9"}, {"at", {500000.1, 5800002, 51.6}}}, "Add station S9"));
  gui.settle();
  gui.frames(3);
  EXPECT_TRUE(editor.session.errors().empty());
  EXPECT_EQ(ImGui::GetCurrentContext()->OpenPopupStack.Size, 0);
  ASSERT_TRUE(editor.view.refused_place);
  EXPECT_NE(editor.view.refused_place->reason.find("cannot place station S9"), std::string::npos);
}

TEST_F(Placing, CtrlDPutsACopyBesideAStationWhereItCanStand) {
  EXPECT_FALSE(invoke(editor, "duplicate-station"));
  EXPECT_EQ(whyNot(*findAction("duplicate-station"), editor), "Select a station in the Survey panel or the view first");
  editor.survey.station = 0;
  gui.frames(2);
  gui.key('D', true);
  gui.settle();
  ASSERT_EQ(job().stations.size(), 3U);
  const auto& copy = job().stations[2];
  EXPECT_EQ(copy.name, "S3");
  EXPECT_NEAR((copy.true_pose.translation - job().stations[0].true_pose.translation).norm(), 1, 0.01);
  EXPECT_NEAR(copy.true_pose.translation.z(), job().stations[0].true_pose.translation.z(), 1e-6);
  EXPECT_TRUE(copy.scans.empty());
  EXPECT_EQ(editor.survey.station, 2) << "the copy is chosen";
  EXPECT_EQ(editor.session.history().undoDescription(), "Added station S3");
  gui.key('Z', true);
  gui.frames(2);
  EXPECT_EQ(job().stations.size(), 2U);
}

TEST_F(Placing, TwoClicksAddARowOfStationsInOneStep) {
  ASSERT_TRUE(invoke(editor, "add-row"));
  gui.frames(3);
  ASSERT_NE(gui.find("###row-count"), nullptr);
  gui.moveTo(screenOf({1.2, 1.2, 0}));
  gui.press();
  EXPECT_EQ(job().stations.size(), 2U) << "one end is no row";
  gui.moveTo(screenOf({1.2, 6.8, 0}));
  EXPECT_EQ(rowUnderPointer(editor).size(), 3U);
  editor.view.row = {.count = {}, .spacing_m = 1.5};
  EXPECT_EQ(rowUnderPointer(editor).size(), 4U);
  editor.view.row = {.count = 3, .spacing_m = {}};
  gui.press();
  gui.settle();
  ASSERT_TRUE(editor.session.errors().empty()) << describe(editor.session.errors().front().error);
  ASSERT_EQ(job().stations.size(), 5U);
  EXPECT_EQ(job().stations[4].name, "S5");
  EXPECT_NEAR(job().stations[3].true_pose.translation.y(), 4, 0.05) << "in the middle";
  gui.key('Z', true);
  gui.frames(2);
  EXPECT_EQ(job().stations.size(), 2U);
}

TEST_F(Placing, LooksFromWhereTheInstrumentIsAndAltLeftGoesBack) {
  editor.survey.station = 0;
  gui.frames(2);
  const auto before = editor.view.camera;
  gui.key('V');
  gui.frames(2);
  const auto& camera = editor.view.camera;
  EXPECT_LT((camera.eye() - job().stations[0].true_pose.translation).norm(), 1e-9);
  const double yaw = yawOf(job().stations[0].true_pose.rotation);
  EXPECT_LT((camera.forward() - Eigen::Vector3d(std::cos(yaw), std::sin(yaw), 0)).norm(), 1e-9) << "along its X axis";
  EXPECT_FALSE(camera.orthographic);
  EXPECT_FALSE(editor.visibility.cut_height_m) << "an instrument sees all";
  const auto azimuth = camera.azimuth_rad;
  drag({4.5, 2.2, 1.5}, {4.5, 1.8, 1.5});
  hold(false);
  EXPECT_NE(camera.azimuth_rad, azimuth) << "a drag looks around";
  EXPECT_LT((camera.eye() - job().stations[0].true_pose.translation).norm(), 1e-6) << "and stays there";
  editor.survey.station = 1;
  gui.key('V');
  gui.frames(2);
  EXPECT_LT((camera.eye() - job().stations[1].true_pose.translation).norm(), 1e-6) << "from one to the next";
  ASSERT_TRUE(invoke(editor, "view-before"));
  ASSERT_TRUE(invoke(editor, "view-before"));
  gui.frames(2);
  EXPECT_EQ(editor.view.camera.target, before.target);
  EXPECT_EQ(editor.view.camera.view_angle_rad, before.view_angle_rad);
  EXPECT_EQ(editor.visibility.cut_height_m, 1.5);
}

// Above the house's corner, so that what stands over a station does not lie on it.
class StationHandles : public Placing {
 protected:
  void SetUp() override {
    Placing::SetUp();
    editor.view.camera.orthographic = false;
    editor.view.camera.target = {3.2, 2, 1};
    editor.view.camera.distance_m = 7;
    editor.view.camera.elevation_rad = 0.7;
    editor.view.camera.azimuth_rad = 0.2;
    editor.survey.station = 0;
    gui.frames(3);
    centre = job().stations[0].true_pose.translation;
  }
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
};

TEST_F(StationHandles, TheOneOnTheFloorTurnsTheStation) {
  const Eigen::Vector3d floor = centre - Eigen::Vector3d(0, 0, 1.6);
  drag(floor + Eigen::Vector3d(0.75, 0, 0), floor + Eigen::Vector3d(0, 0.75, 0));
  EXPECT_EQ(editor.view.handle, StationHandle::heading);
  EXPECT_FALSE(heldStation(editor)) << "it is not moved";
  hold(false);
  gui.settle();
  EXPECT_NEAR(yawOf(job().stations[0].true_pose.rotation) / kRadPerDeg, 90, 1.01);
  EXPECT_LT((job().stations[0].true_pose.translation - centre).norm(), 1e-6);
  gui.key('Z', true);
  gui.frames(2);
  EXPECT_NEAR(yawOf(job().stations[0].true_pose.rotation), 0, 1e-9);
}

TEST_F(StationHandles, TheOneAboveTheInstrumentRaisesIt) {
  drag(centre + Eigen::Vector3d(0, 0, 0.42), centre + Eigen::Vector3d(0, 0, 0.57));
  EXPECT_EQ(editor.view.handle, StationHandle::height);
  hold(false);
  gui.settle();
  EXPECT_NEAR(job().stations[0].instrument_height_m, 1.75, 0.011);
  EXPECT_NEAR(job().stations[0].true_pose.translation.z(), 1.75, 0.011);
}

TEST_F(StationHandles, TheTopOneTiltsIt) {
  drag(centre + Eigen::Vector3d(0, 0, 0.8), centre + Eigen::Vector3d(0.08, 0, 0.8));
  EXPECT_EQ(editor.view.handle, StationHandle::tilt);
  hold(false);
  gui.settle();
  const auto tilt = tiltOf(job().stations[0].true_pose.rotation);
  EXPECT_NEAR(tilt.angle_rad / kRadPerDeg, std::atan(0.1) / kRadPerDeg, 0.5);
  EXPECT_LT((job().stations[0].true_pose.translation - centre).norm(), 1e-6);
}

TEST_F(StationHandles, CannotBeTakenThroughARoof) {
  editor.visibility.cut_height_m.reset();
  gui.frames(2);
  drag(centre + Eigen::Vector3d(0, 0, 0.42), centre + Eigen::Vector3d(0, 0, 0.57));
  EXPECT_EQ(editor.view.handle, StationHandle::none);
  hold(false);
}

TEST_F(StationHandles, EscLetsGoOfThem) {
  drag(centre + Eigen::Vector3d(0, 0, 0.42), centre + Eigen::Vector3d(0, 0, 0.57));
  gui.key(kKeyEscape);
  hold(false);
  gui.settle();
  EXPECT_EQ(job().stations[0].instrument_height_m, 1.6);
}

TEST_F(Placing, AScanThatIsOlderThanATargetSaysSo) {
  Job with_record = job();
  with_record.stations[1].scans[0].as_scanned = AsScanned{with_record.stations[1].true_pose, with_record.targets};
  Outcome outcome;
  outcome.document = editor.session.document();
  outcome.document.job = std::make_shared<const Job>(with_record);
  ASSERT_TRUE(editor.session.adopt(std::move(outcome)));
  editor.choose({.station = 1});
  gui.frames(4);
  EXPECT_EQ(gui.find("###older-S2"), nullptr);
  EXPECT_EQ(gui.find("###scan-again"), nullptr);
  ASSERT_TRUE(editor.session.start("target", {{"move", "T1"}, {"at", {500001.5, 5800001, 51.2}}}));
  gui.settle();
  gui.frames(4);
  EXPECT_NE(gui.find("###older-S2"), nullptr) << "in the list";
  EXPECT_NE(gui.find("###scan-again"), nullptr) << "and in the inspector";
}

}  // namespace
}  // namespace standpoint
