// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/units.h"
#include "demo_verbs.h"
#include "editor/model/scan_form.h"
#include "editor/model/shown_holes.h"
#include "editor/model/trajectory_steps.h"
#include "editor/panels/scan_panel.h"
#include "editor/shell/actions.h"
#include "editor/widgets/keyboard.h"
#include "item_probe.h"
#include "tests/temporary_folder.h"

namespace standpoint {
namespace {

// The demo house from above, its ground floor cut open, the Survey workspace.
class Trajectories : public ::testing::Test {
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
  }
  const Job& job() const { return *editor.session.document().job; }
  const CarriedTrajectory& only() const { return job().trajectories.at(0); }
  ImVec2 screenOf(const Eigen::Vector3d& point) const {
    const auto pixel = project(editor.view.camera, point, editor.view.size);
    const auto* window = ImGui::FindWindowByName("###viewport");
    return {window->Pos.x + static_cast<float>(pixel->x()), window->Pos.y + static_cast<float>(pixel->y())};
  }
  void clickAt(const Eigen::Vector3d& place) {
    gui.moveTo(screenOf(place));
    gui.frames(2);
    gui.press();
    gui.frames(2);
  }
  // A walk through the free part of the lower floor.
  void lay() {
    ASSERT_TRUE(gui.click("###add-trajectory"));
    gui.frames(2);
    for (const Eigen::Vector3d& place : {Eigen::Vector3d(1, 1, 0), {4.2, 1, 0}, {4.2, 5, 0}}) clickAt(place);
    gui.key(kKeyEnter);
    settle();
  }
  void settle() {
    gui.settle();
    editor.trajectory_ways.wait();
    gui.frames(3);
  }
  void typeInto(const char* field, const std::string& text) {
    ASSERT_TRUE(gui.click(field)) << field;
    gui.frames(2);
    gui.type(text);
    gui.key(kKeyEnter);
    settle();
  }
  std::string why(const char* action) const { return whyNot(*findAction(action), editor); }
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor, {1400, 1300}};
};

TEST_F(Trajectories, AreLaidByClicksAndChosenWhenTheyAreThere) {
  lay();
  ASSERT_EQ(job().trajectories.size(), 1U);
  EXPECT_EQ(only().name, "W1");
  EXPECT_EQ(only().carrier, "hand");
  ASSERT_EQ(only().waypoints.size(), 3U);
  EXPECT_NEAR(only().waypoints[1].floor_m.x(), 4.2, 0.05) << "by the pixel";
  EXPECT_NEAR(only().waypoints[1].floor_m.z(), 0, 1e-6);
  EXPECT_EQ(editor.view.tool, Tool::select);
  EXPECT_EQ(editor.survey.trajectory, 0);
  const auto* way = editor.trajectory_ways.of(0);
  ASSERT_NE(way, nullptr);
  EXPECT_EQ(way->problem, "");
  EXPECT_NEAR(way->length_m, 7.2, 0.4);
  EXPECT_GT(way->seconds, 7);
  EXPECT_TRUE(way->obstacles.empty());
  EXPECT_NE(gui.find("###trajectory"), nullptr) << "its row";
  editor.session.undo();
  gui.frames(3);
  EXPECT_TRUE(job().trajectories.empty());
}

TEST_F(Trajectories, TheirNamesHaveTheRoomOfANarrowListAndTheirFiguresWhatIsLeft) {
  lay();
  ASSERT_TRUE(editor.session.start("trajectory", {{"rename", "W1"}, {"name", "Upper corridor"}}));
  settle();
  editor.survey = {};
  editor.workspace = Workspace::instrument;
  editor.wanted_tab[0] = "survey";
  auto& left = editor.settings.areas[static_cast<std::size_t>(Workspace::instrument)].left;
  left = 230;
  gui.frames(3);
  EXPECT_TRUE(gui.says("Upper corridor"));
  EXPECT_FALSE(gui.says("Duration"));
  const auto length = fmt::format("{:.1f} m", editor.trajectory_ways.of(0)->length_m);
  EXPECT_FALSE(gui.says(length));
  gui.moveTo(gui.find("###trajectory")->rect.GetCenter());
  gui.frames(40);  // it rests
  EXPECT_TRUE(gui.says("Carrier: "));
  EXPECT_TRUE(gui.says(length)) << "in the tooltip";
  left = 420;
  gui.moveTo({700, 700});
  gui.frames(3);
  EXPECT_TRUE(gui.says("Upper corridor"));
  EXPECT_TRUE(gui.says("Duration"));
  EXPECT_TRUE(gui.says(length));
}

TEST_F(Trajectories, TheLastWaypointIsTakenBackAndEscGivesAllOfThemUp) {
  EXPECT_EQ(why("take-back-waypoint"), "No trajectory is being added");
  invoke(editor, "add-trajectory");
  gui.frames(2);
  EXPECT_EQ(why("take-back-waypoint"), "There are no waypoints yet");
  clickAt({1, 1, 0});
  EXPECT_EQ(why("end-trajectory"), "A trajectory has at least two waypoints");
  gui.key(kKeyEnter);
  EXPECT_EQ(editor.view.tool, Tool::layTrajectory);
  clickAt({4, 1, 0});
  clickAt({4, 2, 0});
  ASSERT_EQ(editor.view.draft.waypoints.size(), 3U);
  gui.key(kKeyBackspace);
  gui.frames(2);
  EXPECT_EQ(editor.view.draft.waypoints.size(), 2U);
  EXPECT_EQ(why("end-trajectory"), "");
  gui.key(kKeyEscape);
  gui.frames(2);
  EXPECT_EQ(editor.view.tool, Tool::select);
  EXPECT_TRUE(job().trajectories.empty());
  invoke(editor, "add-trajectory");
  EXPECT_TRUE(editor.view.draft.waypoints.empty()) << "the next one begins anew";
}

TEST_F(Trajectories, APlaceWithoutRoomIsRefusedWithItsReason) {
  invoke(editor, "add-trajectory");
  editor.view.draft.height_m = 2.6;
  clickAt({1, 1, 0});
  EXPECT_TRUE(editor.view.draft.waypoints.empty());
  ASSERT_TRUE(editor.view.refused_place);
  EXPECT_THAT(editor.view.refused_place->brief, testing::HasSubstr("m needed"));
  EXPECT_EQ(editor.view.tool, Tool::layTrajectory) << "to try another place";
}

TEST_F(Trajectories, SayWhereAndWhenTheyGoThroughAWall) {
  invoke(editor, "add-trajectory");
  gui.frames(2);
  clickAt({1, 2, 0});
  clickAt({7, 2, 0});
  editor.trajectory_ways.wait();
  gui.frames(2);
  const auto* draft = editor.trajectory_ways.draft();
  ASSERT_NE(draft, nullptr) << "shown before it is finished";
  EXPECT_FALSE(draft->obstacles.empty());
  gui.key(kKeyEnter);
  settle();
  const auto* way = editor.trajectory_ways.of(0);
  ASSERT_NE(way, nullptr);
  ASSERT_EQ(way->obstacles.size(), 2U) << "both faces of the partition";
  EXPECT_THAT(way->obstacle_products[0], testing::HasSubstr("Partition"));
  EXPECT_NEAR(way->obstacles[0].place_m.x(), 5, 1e-3);
  EXPECT_NEAR(way->obstacles[0].after_s, 5, 1.5);
  itemProbe().listens = true;
  gui.frames(2);
  EXPECT_TRUE(std::any_of(itemProbe().texts.begin(), itemProbe().texts.end(), [](const auto& text) {
    return text.find("Partition") != std::string::npos && text.find(" s") != std::string::npos;
  })) << "over the view";
  itemProbe().listens = false;
}

TEST_F(Trajectories, ADoorOnTheirWayIsAHintInTheEditorsWordsAndIsOpenedForScans) {
  invoke(editor, "add-trajectory");
  gui.frames(2);
  clickAt({2.5, 1.5, 0});
  clickAt({2.5, -2, -0.3});
  gui.key(kKeyEnter);
  settle();
  const auto* way = editor.trajectory_ways.of(0);
  ASSERT_NE(way, nullptr);
  ASSERT_EQ(way->obstacles.size(), 1U) << "once, though its leaf has two faces";
  EXPECT_EQ(way->closedDoors(), 1U);
  const auto said = [&] {
    itemProbe().texts.clear();
    itemProbe().listens = true;
    gui.frames(2);
    itemProbe().listens = false;
    return itemProbe().texts;
  };
  auto texts = said();
  EXPECT_THAT(texts, testing::Contains("Closed doors  1"));
  EXPECT_THAT(texts, testing::Contains(testing::HasSubstr("Door 'Front door' after")));
  EXPECT_THAT(texts, testing::Not(testing::Contains(testing::HasSubstr("IfcDoor"))));
  EXPECT_THAT(texts, testing::Not(testing::Contains(testing::HasSubstr("Goes through"))));
  ASSERT_TRUE(gui.click("###open-doors"));
  settle();
  ASSERT_EQ(job().movers.size(), 1U);
  EXPECT_EQ(job().movers.front().kind, MoverKind::door);
  EXPECT_LT(job().movers.front().begins_s, 0) << "open when a scan begins";
  ASSERT_NE(editor.trajectory_ways.of(0), nullptr);
  EXPECT_TRUE(editor.trajectory_ways.of(0)->obstacles.empty());
  texts = said();
  EXPECT_THAT(texts, testing::Not(testing::Contains("Closed doors  1")));
  editor.session.undo();
  settle();
  EXPECT_EQ(editor.trajectory_ways.of(0)->closedDoors(), 1U);
}

TEST_F(Trajectories, AWaypointIsDraggedInOneStepOfTheHistory) {
  lay();
  const auto before = only().waypoints;
  gui.moveTo(screenOf(before[1].floor_m));
  gui.frames(2);
  ImGui::GetIO().MouseDown[0] = true;
  gui.frames(2);
  EXPECT_EQ(editor.survey.waypoint, 1);
  gui.moveTo(screenOf({4, 1.4, 0}));
  gui.frames(2);
  gui.moveTo(screenOf({3.6, 1.8, 0}));
  gui.frames(2);
  EXPECT_TRUE(draggedTrajectory(editor)) << "the ribbon follows";
  ImGui::GetIO().MouseDown[0] = false;
  gui.frames(2);
  settle();
  ASSERT_EQ(only().waypoints.size(), 3U);
  EXPECT_NEAR(only().waypoints[1].floor_m.x(), 3.6, 0.05);
  EXPECT_NEAR(only().waypoints[1].floor_m.y(), 1.8, 0.05);
  EXPECT_EQ(only().waypoints[0].floor_m, before[0].floor_m) << "the others stay to the last digit";
  editor.session.undo();
  gui.frames(3);
  EXPECT_EQ(only().waypoints[1].floor_m, before[1].floor_m);
}

TEST_F(Trajectories, AreEditedInTheInspector) {
  lay();
  typeInto("###inspected-name", "ground floor");
  EXPECT_EQ(only().name, "ground floor");
  typeInto("###carried-speed", "0.5");
  EXPECT_EQ(only().speed_mps, 0.5);
  const double slow = editor.trajectory_ways.of(0)->seconds;
  EXPECT_GT(slow, 13);
  ASSERT_TRUE(gui.click("###carrier"));
  gui.frames(2);
  ASSERT_TRUE(gui.click("###carrier-backpack"));
  settle();
  EXPECT_EQ(only().carrier, "backpack");
  ASSERT_TRUE(gui.click("###waypoint1"));
  gui.frames(3);
  EXPECT_EQ(editor.survey.waypoint, 1);
  typeInto("###waypoint-stop", "3");
  EXPECT_EQ(only().waypoints[1].stop_s, 3);
  ASSERT_TRUE(gui.click("###look-ahead"));
  settle();
  ASSERT_TRUE(only().waypoints[1].look_rad);
  typeInto("###waypoint-look", "90");
  EXPECT_NEAR(*only().waypoints[1].look_rad, 90 * kRadPerDeg, 1e-12);
  ASSERT_TRUE(gui.click("###insert-waypoint"));
  settle();
  ASSERT_EQ(only().waypoints.size(), 4U);
  EXPECT_NEAR(only().waypoints[2].floor_m.y(), 3, 0.1);
  ASSERT_TRUE(gui.click("###remove-waypoint"));
  settle();
  EXPECT_EQ(only().waypoints.size(), 3U);
  ASSERT_TRUE(editor.session.errors().empty()) << describe(editor.session.errors().front().error);
  ASSERT_TRUE(gui.click("###remove-trajectory"));
  settle();
  EXPECT_TRUE(job().trajectories.empty());
}

TEST_F(Trajectories, ANameThatIsTakenIsRefusedBesideItsField) {
  lay();
  lay();
  ASSERT_EQ(job().trajectories.size(), 2U);
  EXPECT_EQ(job().trajectories[1].name, "W2");
  typeInto("###inspected-name", "W1");
  EXPECT_EQ(job().trajectories[1].name, "W2");
  EXPECT_TRUE(editor.session.errors().empty()) << "no dialog";
  EXPECT_NE(gui.find("###revert-inspected"), nullptr);
}

TEST_F(Trajectories, EachWayIsWorkedOutOnce) {
  lay();
  const auto* first = editor.trajectory_ways.of(0);
  ASSERT_NE(first, nullptr);
  lay();
  EXPECT_EQ(editor.trajectory_ways.of(0), first) << "another trajectory is nothing to it";
  ASSERT_TRUE(editor.session.start("station", {{"add", "S9"}, {"on", "500001.5,5800006"}}));
  settle();
  EXPECT_EQ(editor.trajectory_ways.of(0), first) << "nor is a station";
}

TEST_F(Trajectories, NothingMovesUnderThePointerWhenItsWayIsKnown) {
  lay();
  const auto places = [&] {
    std::vector<float> y;
    for (const char* item : {"###ribbon-colour", "###path-moment", "###play-trajectory", "###coverage-along"}) {
      const auto* drawn = gui.find(item);
      EXPECT_NE(drawn, nullptr) << item;
      y.push_back(drawn == nullptr ? -1 : drawn->rect.Min.y);
    }
    return y;
  };
  ASSERT_NE(editor.trajectory_ways.of(0), nullptr);
  const auto known = places();
  // A step after which the way is another one and is worked out anew.
  ASSERT_TRUE(editor.session.start("trajectory", {{"change", "W1"}, {"speed", 0.7}}));
  editor.session.wait();
  ASSERT_EQ(only().speed_mps, 0.7);
  std::size_t unknown = 0;
  for (gui.frame(); editor.trajectory_ways.of(0) == nullptr; gui.frame()) {
    ++unknown;
    EXPECT_EQ(places(), known);
    EXPECT_TRUE(gui.find("###path-moment")->disabled);
    EXPECT_TRUE(gui.find("###play-trajectory")->disabled);
  }
  EXPECT_GT(unknown, 0U);
  gui.frames(2);
  EXPECT_EQ(places(), known);
}

TEST_F(Trajectories, GoToAFileAndComeBackFromIt) {
  const TemporaryFolder folder;
  lay();
  ASSERT_TRUE(gui.click("###export-trajectory"));
  gui.frames(3);
  ASSERT_TRUE(editor.dialogs.file.open);
  const auto file = folder.path() / "walk.csv";
  editor.dialogs.file.done(file);
  settle();
  ASSERT_TRUE(std::filesystem::exists(file));
  editor.dialogs.file.open = false;
  gui.frames(3);
  ASSERT_TRUE(gui.click("###import-trajectory"));
  gui.frames(3);
  ASSERT_TRUE(editor.dialogs.file.open);
  editor.dialogs.file.done(file);
  editor.dialogs.file.open = false;
  settle();
  ASSERT_EQ(job().trajectories.size(), 2U);
  EXPECT_EQ(job().trajectories[1].name, "walk");
  EXPECT_EQ(editor.survey.trajectory, 1);
  const auto* way = editor.trajectory_ways.of(1);
  ASSERT_NE(way, nullptr);
  EXPECT_NEAR(way->seconds, editor.trajectory_ways.of(0)->seconds, 0.01);
  EXPECT_EQ(gui.find("###carrier"), nullptr) << "a file has no carrier";
  std::filesystem::remove(file);
  Document document = editor.session.document();
  Job other = *document.job;
  other.trajectories[1].file = (folder.path() / "gone.csv").string();
  document.job = std::make_shared<const Job>(other);
  ASSERT_TRUE(editor.session.adopt({document, {}, {}, "with a missing file"}));
  settle();
  EXPECT_NE(editor.trajectory_ways.of(1)->problem, "");
  EXPECT_TRUE(gui.find("###scan-along")->disabled);
}

class ScanAlong : public Trajectories {
 protected:
  void openScanPanel() {
    editor.wanted_tab[1] = "scan";
    gui.frames(3);
  }
};

TEST_F(ScanAlong, InstrumentsThatAreCarriedSayThatTheyNeedATrajectory) {
  openScanPanel();
  ASSERT_TRUE(gui.click("###instrument"));
  gui.frames(2);
  ASSERT_TRUE(gui.click("###velodyne-vlp-16"));
  gui.frames(3);
  EXPECT_TRUE(editor.carried_scan.wanted);
  EXPECT_EQ(editor.carried_scan.choice.instrument, "velodyne-vlp-16");
  EXPECT_EQ(editor.scan_choice.instrument, "leica-rtc360") << "what stands on a tripod stays";
  EXPECT_EQ(gui.find("###stations"), nullptr);
  ASSERT_NE(gui.find("###run-scan"), nullptr);
  EXPECT_TRUE(gui.find("###run-scan")->disabled) << "there is no trajectory yet";
  ASSERT_TRUE(gui.click("###instrument"));
  gui.frames(2);
  ASSERT_TRUE(gui.click("###leica-rtc360"));
  gui.frames(3);
  EXPECT_FALSE(editor.carried_scan.wanted);
  EXPECT_NE(gui.find("###stations"), nullptr);
  EXPECT_FALSE(gui.find("###run-scan")->disabled);
}

TEST_F(ScanAlong, ATrajectoryIsScannedFromItsInspectorAndKeepsItsScan) {
  const TemporaryFolder folder;
  lay();
  ASSERT_TRUE(gui.click("###scan-along"));
  gui.frames(4);
  EXPECT_TRUE(editor.carried_scan.wanted);
  chooseInstrument(editor.carried_scan.choice, *editor.instrument("velodyne-vlp-16"));
  editor.panels.of<ScanState>().folder = folder.path().string();
  gui.frames(3);
  ASSERT_NE(gui.find("###along"), nullptr);
  ASSERT_FALSE(gui.find("###run-scan")->disabled);
  ASSERT_TRUE(gui.click("###run-scan"));
  gui.settle();
  ASSERT_TRUE(editor.session.errors().empty()) << describe(editor.session.errors().front().error);
  ASSERT_EQ(only().scans.size(), 1U);
  EXPECT_EQ(only().scans[0].file, (folder.path() / "W1.e57").string());
  ASSERT_TRUE(editor.cloud()) << "its points are shown";
  EXPECT_EQ(editor.cloud()->points_in_file, only().scans[0].points);
}

TEST_F(ScanAlong, TheInspectorGivesWayToTheScanPanelBesideIt) {
  lay();
  editor.wanted_tab[0] = "outliner";
  editor.wanted_tab[1] = "inspector";
  gui.frames(4);
  ASSERT_EQ(gui.find("###run-scan"), nullptr);
  ASSERT_TRUE(gui.click("###scan-along"));
  gui.frames(4);
  EXPECT_NE(gui.find("###run-scan"), nullptr);
}

TEST_F(ScanAlong, OfSeveralTrajectoriesOneIsChosen) {
  lay();
  lay();
  editor.survey = {};
  editor.carried_scan.wanted = true;
  openScanPanel();
  EXPECT_TRUE(gui.find("###run-scan")->disabled) << "which one is not clear";
  ASSERT_TRUE(gui.click("###along"));
  gui.frames(2);
  ASSERT_TRUE(gui.click("###along1"));
  gui.frames(3);
  EXPECT_EQ(editor.survey.trajectory, 1);
  EXPECT_FALSE(gui.find("###run-scan")->disabled);
}

TEST_F(Trajectories, ShowWhatTheyLeaveBlindAndWhy) {
  lay();
  ASSERT_TRUE(gui.click("###coverage-along"));
  settle();
  const auto holes = shownHoles(editor);
  ASSERT_NE(holes.patches, nullptr);
  EXPECT_EQ(holes.of, ShownHoles::Of::trajectories);
  ASSERT_FALSE(holes.patches->empty());
  for (const auto& patch : *holes.patches) EXPECT_TRUE(patch.reason.has_value());
  EXPECT_FALSE(holes.patches->front().shape.squares.empty()) << "the largest can be drawn";
  ASSERT_TRUE(invoke(editor, "holes-plan"));
  gui.frames(2);
  itemProbe().listens = true;
  gui.frame();
  itemProbe().listens = false;
  EXPECT_THAT(itemProbe().texts, testing::Contains("Occluded along this path"));
  EXPECT_THAT(itemProbe().texts, testing::Not(testing::Contains("Not covered as planned")));
}

}  // namespace
}  // namespace standpoint
