// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/data_folder.h"
#include "demo_document.h"
#include "demo_verbs.h"
#include "editor/model/fieldwork.h"
#include "editor/panels/outliner_panel.h"
#include "editor/shell/actions.h"
#include "editor/widgets/keyboard.h"
#include "item_probe.h"

namespace standpoint {
namespace {

constexpr double kEyes_m = 1.60;

class Walking : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
    gui.settle();
    gui.frames(2);
  }
  void collide() {
    ASSERT_TRUE(editor.session.start("collide", nlohmann::json::object()));
    gui.settle();
    gui.frames(2);
    ASSERT_TRUE(editor.session.document().collision);
  }
  void walk() {
    gui.key('W');
    editor.walk_ground.wait();
    gui.frames(3);
    ASSERT_TRUE(editor.walk.active());
    gui.frames(30);  // it stands still again
  }
  ImVec2 pixelOf(const Eigen::Vector3d& p) {
    const auto* scene = gui.find("###scene");
    const auto pixel = project(editor.view.camera, p, editor.view.size);
    return {scene->rect.Min.x + static_cast<float>(pixel->x()), scene->rect.Min.y + static_cast<float>(pixel->y())};
  }
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor};
};

TEST_F(Walking, BeginsOnTheFloorAtEyeHeightAndEndsWithEscape) {
  collide();
  walk();
  ASSERT_EQ(editor.view.tool, Tool::walk);
  EXPECT_NEAR(editor.view.camera.eye().z() - editor.walk.feet().z(), kEyes_m, 1e-3);
  EXPECT_NEAR(editor.view.camera.elevation_rad, 0, 1e-9);
  const auto eye = editor.view.camera.eye();
  gui.key(kKeyEscape);
  gui.frames(2);
  EXPECT_EQ(editor.view.tool, Tool::select);
  EXPECT_FALSE(editor.walk.active());
  EXPECT_NEAR((editor.view.camera.eye() - eye).norm(), 0, 1e-6) << "it stays where one walked to";
}

TEST_F(Walking, ADragTurnsTheHeadUnlessThePreferencesMakeItMoveTheScene) {
  walk();
  const auto turnOfDrag = [&] {  // to the left, as a turn to the left
    const auto before = editor.view.camera.forward();
    gui.moveTo(pixelOf(editor.view.camera.target));
    gui.frame();
    ImGui::GetIO().MouseDown[0] = true;
    gui.frame();
    for (int i = 0; i < 5; ++i) {
      ImGui::GetIO().MousePos.x -= 12;
      gui.frame();
    }
    ImGui::GetIO().MouseDown[0] = false;
    gui.frames(2);
    return before.cross(editor.view.camera.forward()).z();
  };
  EXPECT_GT(turnOfDrag(), 0.01) << "as in games";
  editor.dialogs.preferences = true;
  gui.frames(3);
  ASSERT_TRUE(gui.click("###drag-scene"));
  editor.dialogs.preferences = false;
  gui.frames(3);
  EXPECT_FALSE(editor.settings.drag_turns_head);
  EXPECT_LT(turnOfDrag(), -0.01) << "what is seen follows the pointer";
}

TEST_F(Walking, TakesTheCutAwayAndThePreviousViewBringsItBack) {
  editor.visibility.cut_height_m = 1.2;
  walk();
  EXPECT_FALSE(editor.visibility.cut_height_m);
  goBackInViews(editor);
  EXPECT_EQ(editor.visibility.cut_height_m, 1.2);
}

TEST_F(Walking, NeedsNoPreparationAndIsNoChangeOfTheDocument) {
  const auto revision = editor.session.revision();
  const bool modified = editor.session.modified();
  walk();
  EXPECT_FALSE(editor.session.document().collision);
  EXPECT_EQ(editor.session.revision(), revision);
  EXPECT_EQ(editor.session.modified(), modified);
  EXPECT_NEAR(editor.walk.feet().z(), 0, 0.01) << "inside the front door, not on the roof";
  EXPECT_TRUE(editor.walk.feet().y() > 0.3 && editor.walk.feet().y() < 2) << editor.walk.feet().transpose();
}

TEST_F(Walking, IsGivenUpWithEscapeWhileItIsPrepared) {
  keyboard::change('W', true);
  gui.frame();
  keyboard::change('W', false);
  if (!editor.walk_ground.preparing()) GTEST_SKIP() << "the machine was faster than a frame";
  gui.key(kKeyEscape);
  editor.walk_ground.wait();
  gui.frames(3);
  EXPECT_FALSE(editor.walk.active());
  EXPECT_TRUE(editor.session.errors().empty());
  walk();  // and can be begun again
}

TEST_F(Walking, FollowsTheKeysThatAreHeld) {
  walk();
  const auto camera = editor.view.camera;
  const Eigen::Vector3d before = editor.walk.feet();
  keyboard::change('D', true);
  gui.frames(10);
  keyboard::change('D', false);
  gui.frames(20);
  const Eigen::Vector3d way = editor.walk.feet() - before;
  EXPECT_GT(way.norm(), 0.1);
  EXPECT_GT(way.normalized().dot(camera.right()), 0.95);
  EXPECT_NEAR(editor.view.camera.eye().z() - editor.walk.feet().z(), kEyes_m, 1e-3);
}

TEST_F(Walking, GoesAsFastAcrossAsAheadAndChangesItsSpeedWithTheWheel) {
  walk();
  const auto lengthOf = [&](std::initializer_list<int> keys) {
    const Eigen::Vector3d before = editor.walk.feet();
    for (const int key : keys) keyboard::change(key, true);
    gui.frames(20);
    for (const int key : keys) keyboard::change(key, false);
    gui.frames(20);
    return (editor.walk.feet() - before).norm();
  };
  const double ahead = lengthOf({'W'});
  EXPECT_NEAR(ahead, 20 / 60.0 * 1.8, 0.1);
  EXPECT_NEAR(lengthOf({'W', 'A'}), ahead, 0.02);
  gui.moveTo(gui.find("###scene")->rect.GetCenter());
  ImGui::GetIO().MouseWheel = -2;
  gui.frame();
  ImGui::GetIO().MouseWheel = 0;
  EXPECT_NEAR(editor.walk.speed_mps(false), 1.8 / 1.5625, 1e-9);
  EXPECT_LT(lengthOf({'S'}), 0.75 * ahead);
}

TEST_F(Walking, EndsWhenTheShapesAreComputedAgain) {
  walk();
  ASSERT_TRUE(editor.session.start("collide", {{"doors", "closed"}}));
  gui.settle();
  gui.frames(3);
  EXPECT_FALSE(editor.walk.active());
  EXPECT_EQ(editor.view.tool, Tool::select);
}

TEST_F(Walking, IsOfferedOnlyWhereThereIsAModel) {
  Editor empty(verbsWithDemo(), [] {});
  EXPECT_NE(whyNot(*findAction("walk"), empty), "");
  EXPECT_EQ(whyNot(*findAction("walk"), editor), "");
}

TEST_F(Walking, IsTakenToWhereOneAimsWhileTIsHeld) {
  walk();
  editor.view.camera.azimuth_rad = 0;
  gui.frame();
  const Eigen::Vector3d from = editor.walk.feet(), aim = from + Eigen::Vector3d(1.4, 3.3, 0);
  gui.moveTo(pixelOf(aim));
  keyboard::change('T', true);
  gui.frames(3);
  ASSERT_TRUE(editor.view.teleport.active());
  EXPECT_EQ(editor.walk.feet(), from) << "not before it is released";
  keyboard::change('T', false);
  gui.frames(3);
  EXPECT_NEAR((editor.walk.feet() - aim).norm(), 0, 0.05) << editor.walk.feet().transpose();
  keyboard::change(kKeyAlt, true);
  gui.key(kKeyLeft);
  keyboard::change(kKeyAlt, false);
  gui.frames(3);
  EXPECT_NEAR((editor.walk.feet() - from).norm(), 0, 0.01) << "Alt+Left goes back";
}

TEST_F(Walking, ATapOfTGoesToThePointerAndAClickAfterItGoesOn) {
  walk();
  editor.view.camera.azimuth_rad = 0;
  gui.frame();
  EXPECT_TRUE(gui.says("T to teleport to the pointer")) << "what a tap does stands in the hint";
  const Eigen::Vector3d from = editor.walk.feet(), first = from + Eigen::Vector3d(1.4, 3.3, 0);
  gui.moveTo(pixelOf(first));
  gui.key('T');
  gui.frames(3);
  EXPECT_NEAR((editor.walk.feet() - first).norm(), 0, 0.05) << editor.walk.feet().transpose();
  EXPECT_TRUE(gui.says("click to go farther"));
  editor.view.camera.azimuth_rad = std::numbers::pi;  // towards where it came from
  gui.frame();
  gui.moveTo(pixelOf(from));
  gui.press();
  gui.frames(3);
  EXPECT_NEAR((editor.walk.feet() - from).norm(), 0, 0.05) << editor.walk.feet().transpose();
  EXPECT_TRUE(editor.selection.empty());
  gui.frames(300);  // 5 s later a click is one as ever
  EXPECT_FALSE(gui.says("click to go farther"));
  editor.view.camera.azimuth_rad = 0;
  gui.frame();
  gui.moveTo(pixelOf(first));
  gui.press();
  gui.frames(3);
  EXPECT_NEAR((editor.walk.feet() - from).norm(), 0, 0.05) << editor.walk.feet().transpose();
}

TEST_F(Walking, ATapOfTWhereNobodyCanStandLeavesTheRingForAClick) {
  walk();
  const Eigen::Vector3d from = editor.walk.feet();
  editor.view.hover.reset();
  gui.moveTo({-10, -10});
  gui.key('T');
  gui.frames(3);
  EXPECT_EQ(editor.walk.feet(), from);
  EXPECT_TRUE(editor.view.teleport.by_click);
  gui.key(kKeyEscape);
  gui.frames(2);
  EXPECT_FALSE(editor.view.teleport.active());
}

TEST_F(Walking, IsBegunByTeleportFromOutsideAndNotWithEscape) {
  const Eigen::Vector3d lawn(5, -4, -0.3);
  editor.view.camera = {lawn, 12, 0, 0.6};
  gui.frames(2);
  gui.moveTo(pixelOf(lawn));
  keyboard::change('T', true);
  gui.frames(2);
  editor.walk_ground.wait();
  gui.frames(2);
  keyboard::change(kKeyEscape, true);
  gui.frame();
  keyboard::change(kKeyEscape, false);
  gui.frame();
  keyboard::change('T', false);
  gui.frames(2);
  EXPECT_FALSE(editor.walk.active()) << "Esc gave it up";
  ASSERT_TRUE(invoke(editor, "teleport"));
  gui.press();
  gui.frames(2);
  ASSERT_TRUE(editor.walk.active());
  EXPECT_NEAR((editor.walk.feet() - lawn).norm(), 0, 0.05) << editor.walk.feet().transpose();
  EXPECT_EQ(editor.view.tool, Tool::walk);
}

TEST_F(Walking, JumpsToARoomAndToAStationByName) {
  const auto choose = [&](const char* query) {
    ASSERT_TRUE(invoke(editor, "palette"));
    gui.frames(3);
    gui.type(query);
    gui.key(kKeyEnter);
    editor.walk_ground.wait();
    gui.frames(3);
  };
  choose("@liv");
  ASSERT_TRUE(editor.walk.active());
  EXPECT_EQ(walkPlaceName(editor), "Living room · Ground floor");
  choose("#S2");
  EXPECT_NEAR((editor.walk.feet() - Eigen::Vector3d(7.5, 5, 0)).norm(), 0, 0.05) << editor.walk.feet().transpose();
  EXPECT_EQ(walkPlaceName(editor), "Ground floor");
  choose("living room");  // as anybody asks who does not know the signs
  EXPECT_EQ(walkPlaceName(editor), "Living room · Ground floor");
}

TEST_F(Walking, GoesToARoomOrStoreyOfTheOutlinerWhichIsSelectedNoLonger) {
  const auto room = productNamed(*editor.environment(), "Living room");
  const auto outline = [&](const char* filter) {
    editor.panels.of<OutlinerState>().filter = filter;
    stopWalking(editor);
    editor.selection.clear();
    gui.frames(3);
  };
  const auto row = [&](const std::string& label) {
    const auto rows = editor.outliner.tree.rows(*editor.environment(), editor.panels.of<OutlinerState>().filter);
    std::size_t place = 0;
    while (place < rows.size() && editor.outliner.tree.node(rows[place].node).label != label) ++place;
    for (const auto& item : itemProbe().items)
      if (item.label == "###row" && place-- == 0) return item.rect.GetCenter();
    return ImVec2(-1, -1);
  };
  const auto arrive = [&] {
    editor.walk_ground.wait();
    gui.frames(3);
    return editor.walk.active() ? walkPlaceName(editor) : "";
  };
  outline("living");
  gui.moveTo(row("Living room"));
  gui.press(1);
  gui.frames(2);
  EXPECT_EQ(editor.selection.products(), std::vector{room});
  ASSERT_TRUE(gui.click("###row-go-there"));
  EXPECT_EQ(arrive(), "Living room · Ground floor");
  EXPECT_TRUE(editor.selection.empty()) << "it would be all blue around";
  outline("living");
  gui.moveTo(row("Living room"));
  gui.press();
  gui.press();  // a double click
  EXPECT_EQ(arrive(), "Living room · Ground floor");
  EXPECT_TRUE(editor.selection.empty());
  outline("");
  gui.moveTo(row("Upper floor"));
  gui.press(1);
  gui.frames(2);
  EXPECT_FALSE(editor.selection.empty());
  ASSERT_TRUE(gui.click("###row-go-there"));
  EXPECT_EQ(arrive(), "Upper floor");
  EXPECT_TRUE(editor.selection.empty());
  outline("");
  gui.moveTo(row("House"));
  gui.press(1);
  gui.frames(2);
  EXPECT_EQ(gui.find("###row-go-there"), nullptr) << "a building is no place";
}

TEST_F(Walking, GoesToTheRoomThatTheInspectorShowsAndLeavesOtherProductsSelected) {
  const auto room = productNamed(*editor.environment(), "Living room"),
             wall = productNamed(*editor.environment(), "Wall east OG");
  editor.wanted_tab[1] = "inspector";
  editor.select(wall, true);
  gui.frames(3);
  EXPECT_EQ(gui.find("###go-to-room"), nullptr);
  jumpToRoom(editor, room);
  editor.walk_ground.wait();
  gui.frames(3);
  EXPECT_EQ(editor.selection.products(), std::vector{wall}) << "it is looked for from there";
  editor.select(room, true);
  gui.frames(3);
  ASSERT_TRUE(gui.click("###go-to-room"));
  editor.walk_ground.wait();
  gui.frames(3);
  EXPECT_EQ(walkPlaceName(editor), "Living room · Ground floor");
  EXPECT_TRUE(editor.selection.empty());
}

TEST_F(Walking, UndoTakesBackAJumpBeforeAnyChangeOfTheDocument) {
  walk();
  const Eigen::Vector3d before = editor.walk.feet();
  const auto revision = editor.session.revision();
  jumpToStation(editor, 1);
  gui.frames(3);
  ASSERT_GT((editor.walk.feet() - before).norm(), 0.5);
  gui.key('Z', true);
  gui.frames(3);
  EXPECT_NEAR((editor.walk.feet() - before).norm(), 0, 0.05);
  EXPECT_EQ(editor.session.revision(), revision) << "and nothing else";
  EXPECT_FALSE(canUndoJump(editor)) << "once";
  jumpToStation(editor, 1);
  gui.frames(3);
  ASSERT_TRUE(editor.session.start("bookmark", {{"add", "here"}}));
  gui.settle();
  ASSERT_NE(editor.session.revision(), revision);
  EXPECT_FALSE(canUndoJump(editor)) << "the newer change is undone first";
}

TEST_F(Walking, UndoGivesUpAJumpThatWaitsForItsGroundAndNoChangeOfTheDocument) {
  ASSERT_TRUE(editor.session.start("bookmark", {{"add", "here"}}));
  gui.settle();
  const auto revision = editor.session.revision();
  ASSERT_EQ(editor.session.whyNotUndo(), "");
  jumpToStation(editor, 1);
  if (editor.walk.active()) GTEST_SKIP() << "the machine was faster than a frame";
  gui.key('Z', true);
  EXPECT_EQ(editor.session.revision(), revision) << "the bookmark stays";
  editor.walk_ground.wait();
  gui.frames(3);
  EXPECT_FALSE(editor.walk.active()) << "the jump does not";
  ASSERT_TRUE(invoke(editor, "teleport"));
  gui.frames(1);
  gui.key('Z', true);
  EXPECT_FALSE(editor.view.teleport.active());
  EXPECT_EQ(editor.session.revision(), revision) << "nor while one aims";
  editor.walk_ground.wait();
  gui.frames(3);
  jumpToStation(editor, 1);  // and it can be made again
  editor.walk_ground.wait();
  gui.frames(3);
  EXPECT_TRUE(editor.walk.active());
}

TEST_F(Walking, JumpsThoughTheShapesAreComputedWhileItsGroundIsPrepared) {
  jumpToStation(editor, 1);
  collide();
  editor.walk_ground.wait();
  gui.frames(3);
  editor.walk_ground.wait();
  gui.frames(3);
  EXPECT_TRUE(editor.walk.active());
}

TEST_F(Walking, TheStatusBarNamesTheClosedDoorUnderThePointer) {
  walk();
  ASSERT_TRUE(editor.walk.doors());
  Bounds box;
  for (const auto& instance : editor.walk.doors()->instances)
    box.extend(bounds(*editor.walk.doors()->meshes[instance.mesh], instance.world_from_mesh));
  auto& camera = editor.view.camera;
  const Eigen::Vector3d eye = camera.eye();
  Eigen::Vector3d middle = (box.min + box.max) / 2;
  middle.z() = eye.z();
  const Eigen::Vector3d way = middle - eye;
  camera.azimuth_rad = std::atan2(-way.x(), way.y());
  camera.elevation_rad = 0;
  camera.target = eye + camera.forward() * camera.distance_m;
  gui.frames(2);
  editor.notice.text.clear();  // of how the walk began
  gui.moveTo(pixelOf(middle));
  gui.frames(2);
  ASSERT_TRUE(editor.view.door_hover);
  const auto& door = editor.environment()->products[editor.view.door_hover->product];
  EXPECT_EQ(door.ifc_class, "IfcDoor");
  EXPECT_TRUE(gui.says(productLabel(door)));
  EXPECT_NEAR(editor.view.door_hover->range_m, way.norm(), 0.1);
  EXPECT_NEAR((editor.view.door_hover->position - middle).head<2>().norm(), 0, 0.1);
}

TEST_F(Walking, OpensTheDoorAheadAndClosesItBehindWithoutChangingTheDocument) {
  walk();
  const auto revision = editor.session.revision();
  ASSERT_TRUE(editor.walk.doors()) << "the front door";
  const auto closed = editor.walk.doors();
  const auto leafIs = [&] {
    Bounds box;
    for (const auto& instance : editor.walk.doors()->instances)
      box.extend(bounds(*editor.walk.doors()->meshes[instance.mesh], instance.world_from_mesh));
    return box.max.y() - box.min.y();
  };
  EXPECT_NEAR(leafIs(), 0.06, 0.01);
  editor.view.camera.azimuth_rad = std::numbers::pi;  // out of the house
  keyboard::change('W', true);
  gui.frames(90);
  keyboard::change('W', false);
  EXPECT_LT(editor.walk.feet().y(), -0.2) << "nothing was in the way";
  EXPECT_NEAR(leafIs(), 1, 0.06) << "a quarter of a turn";
  EXPECT_EQ(editor.viewState().doors, editor.walk.doors());
  keyboard::change('W', true);
  gui.frames(90);
  keyboard::change('W', false);
  gui.frames(60 * 3);
  EXPECT_NEAR(leafIs(), 0.06, 0.01) << "closed again";
  EXPECT_EQ(editor.session.revision(), revision);
}

TEST_F(Walking, IsStoppedByADoorThatWasShutByKeyUntilItIsOpened) {
  walk();
  const auto press = [&](int key, int frames) {
    keyboard::change(key, true);
    gui.frames(frames);
    keyboard::change(key, false);
    gui.frames(30);
  };
  editor.view.camera.azimuth_rad = std::numbers::pi;
  press('W', 8);
  EXPECT_TRUE(editor.walk.doorInReach(editor.view.camera));
  gui.key('E');  // it has opened by itself: shut it
  gui.frames(40);
  const double before = editor.walk.feet().y();
  press('W', 120);
  EXPECT_GT(editor.walk.feet().y(), 0.16 + 0.2) << "in front of the leaf";
  EXPECT_LT(editor.walk.feet().y(), before);
  gui.key('E');
  press('W', 90);
  EXPECT_LT(editor.walk.feet().y(), 0);
}

TEST_F(Walking, LetsNobodyThroughATripodAndLetsOutWhoeverStandsInOne) {
  jumpToStation(editor, 0);
  editor.walk_ground.wait();
  gui.frames(30);
  ASSERT_TRUE(editor.walk.active());
  const Eigen::Vector3d foot(3.2, 2, 0);
  const auto away = [&] { return (editor.walk.feet() - foot).head<2>().norm(); };
  const auto nearestOnTheWay = [&](int key, int frames) {
    double nearest = away();
    keyboard::change(key, true);
    for (int i = 0; i < frames; ++i) {
      gui.frame();
      nearest = std::min(nearest, away());
    }
    keyboard::change(key, false);
    gui.frames(30);
    return nearest;
  };
  ASSERT_LT(away(), 0.05) << "in the tripod";
  editor.view.camera.azimuth_rad = std::numbers::pi / 2;  // to the west
  nearestOnTheWay('W', 60);
  ASSERT_GT(away(), 0.8) << "and out of it";
  EXPECT_GT(nearestOnTheWay('S', 120), 0.44) << "backwards into it";
  editor.held.instrument = "leica-rtc360";
  editor.held.station = "S1";
  editor.held.carried = true;
  nearestOnTheWay('W', 60);
  EXPECT_LT(nearestOnTheWay('S', 120), 0.2) << "somebody carries it: nothing stands there";
}

TEST_F(Walking, ATripodThatIsPutUpWhereOneStandsHoldsNobody) {
  walk();
  const Eigen::Vector3d feet = editor.walk.feet();
  const Eigen::Vector3d p = feet + editor.shift_m();
  ASSERT_TRUE(editor.session.start(StationOptions{.add = "S9", .on = FloorPlace{p.x(), p.y(), p.z()}}, "Add"));
  gui.settle();
  gui.frames(3);
  ASSERT_EQ(tripodsOf(editor).size(), 3U);
  keyboard::change('W', true);
  gui.frames(60);
  keyboard::change('W', false);
  EXPECT_GT((editor.walk.feet() - feet).head<2>().norm(), 0.8);
}

TEST_F(Walking, SaysWhereTheStairLeadsThatIsInSightAndHowElseOneGetsUpstairs) {
  jumpToStation(editor, 1);
  editor.walk_ground.wait();
  gui.frames(30);
  ASSERT_TRUE(editor.walk.active());
  const auto said = [&](double azimuth_rad) {
    editor.view.camera.azimuth_rad = azimuth_rad;
    gui.frames(3);
    itemProbe().texts.clear();
    itemProbe().listens = true;
    gui.frames(2);
    itemProbe().listens = false;
    return itemProbe().texts;
  };
  EXPECT_THAT(said(0), testing::Contains(testing::HasSubstr("Stair up to Upper floor  (Q)")));
  EXPECT_THAT(said(0), testing::Contains(testing::HasSubstr("Q, or a click on its label, to walk up the stair")));
  EXPECT_THAT(said(0), testing::Contains(testing::HasSubstr("Ctrl+G to go to a room or upstairs")));
  EXPECT_THAT(said(std::numbers::pi), testing::Not(testing::Contains(testing::HasSubstr("Stair up to"))));
  editor.view.room_names = false;
  EXPECT_THAT(said(0), testing::Not(testing::Contains(testing::HasSubstr("Stair up to"))));
}

// The slab over the demo's stair is whole.
TEST_F(Walking, SaysWhereTheHeadroomEndsOfAStairThatNobodyCanTake) {
  jumpToStation(editor, 1);
  editor.walk_ground.wait();
  gui.frames(30);
  editor.view.camera.azimuth_rad = 0;
  gui.frames(2);
  const Eigen::Vector3d feet = editor.walk.feet();
  gui.key('Q');
  gui.frames(30);
  EXPECT_EQ(editor.walk.feet(), feet);
  EXPECT_FALSE(editor.walk.goesByItself());
  EXPECT_THAT(editor.notice.text, testing::HasSubstr("No way to Upper floor by this stair: headroom 1.10 m at "));
}

TEST_F(Walking, SaysThatNoStairIsInSight) {
  EXPECT_NE(whyNot(*findAction("take-stair"), editor), "");
  jumpToStation(editor, 1);
  editor.walk_ground.wait();
  gui.frames(30);
  editor.view.camera.azimuth_rad = std::numbers::pi;
  gui.frames(2);
  gui.key('Q');
  EXPECT_EQ(editor.notice.text, "Walk to where a stair is in sight first");
}

TEST_F(Walking, SaysWhyNobodyCanStandWhereTheTeleportAimsAndHowOneComesBack) {
  walk();
  editor.view.camera.azimuth_rad = 0;
  gui.frame();
  const Eigen::Vector3d from = editor.walk.feet();
  ASSERT_TRUE(invoke(editor, "teleport"));
  EXPECT_TRUE(gui.says("Alt+Left then comes back"));
  gui.moveTo(pixelOf(from + Eigen::Vector3d(0, 3, 1.6)));  // on a wall
  gui.frames(2);
  EXPECT_TRUE(gui.says("too steep: 90°, at most 45°"));
  gui.moveTo(pixelOf(from + Eigen::Vector3d(1.4, 3.3, 0)));
  gui.frames(2);
  EXPECT_FALSE(gui.says("too steep"));
  gui.press();
  gui.frames(3);
  ASSERT_GT((editor.walk.feet() - from).norm(), 1);
  EXPECT_TRUE(gui.says("Alt+Left for the previous view"));
}

TEST_F(Walking, LooksFromAnotherHeightAndAngleOnceTheyAreSet) {
  walk();
  editor.walk.setUprightEyes(1.2);
  gui.frames(30);
  EXPECT_NEAR(editor.view.camera.eye().z() - editor.walk.feet().z(), 1.2, 1e-3);
  editor.walk.setUprightEyes(3);
  gui.frames(60);
  EXPECT_NEAR(editor.view.camera.eye().z() - editor.walk.feet().z(), 2.0, 1e-3);
  editor.walk.setViewAngle(75, editor.view.camera);
  EXPECT_NEAR(editor.view.camera.view_angle_rad, 75 * std::numbers::pi / 180, 1e-9);
  EXPECT_NE(gui.find("###eye-height"), nullptr);
  EXPECT_NE(gui.find("###view-angle"), nullptr);
}

TEST_F(Walking, JumpsToAStoreyAndAProductAndABookmark) {
  const auto choose = [&](const char* query) {
    ASSERT_TRUE(invoke(editor, "palette"));
    gui.frames(3);
    gui.type(query);
    gui.key(kKeyEnter);
    editor.walk_ground.wait();
    gui.frames(3);
  };
  choose("@upper");
  ASSERT_TRUE(editor.walk.active());
  EXPECT_EQ(walkPlaceName(editor), "Upper floor");
  ASSERT_TRUE(invoke(editor, "add-bookmark"));
  gui.settle();
  gui.frames(2);
  ASSERT_TRUE(editor.session.document().bookmarks);
  const Eigen::Vector3d upstairs = editor.walk.feet();
  choose("/stair");
  EXPECT_FALSE(editor.walk.active());
  ASSERT_FALSE(editor.selection.empty());
  EXPECT_EQ(editor.environment()->products[editor.selection.primary()].name, "Stair");
  choose("*view 1");
  ASSERT_TRUE(editor.walk.active());
  EXPECT_NEAR((editor.walk.feet() - upstairs).norm(), 0, 0.05);
}

TEST_F(Walking, JumpsToARoomByTheMenuWithoutASign) {
  ASSERT_TRUE(invoke(editor, "go-to"));
  gui.frames(4);
  EXPECT_TRUE(gui.says("Living room"));
  gui.type("liv");
  EXPECT_EQ(editor.dialogs.palette.query, "@liv") << "what is typed goes on behind the sign";
  gui.key(kKeyEnter);
  editor.walk_ground.wait();
  gui.frames(3);
  EXPECT_EQ(walkPlaceName(editor), "Living room · Ground floor");
}

TEST_F(Walking, GoesToABookmarkInTheListAndRenamesItByF2) {
  ASSERT_TRUE(invoke(editor, "add-bookmark"));
  gui.settle();
  editor.wanted_tab[0] = "bookmarks";
  gui.frames(3);
  const auto kept = editor.view.camera;
  look(editor.view.camera, StandardView::top);
  gui.frames(2);
  ASSERT_TRUE(gui.click("###bookmark"));
  gui.frames(2);
  EXPECT_NEAR((editor.view.camera.eye() - kept.eye()).norm(), 0, 1e-6);
  EXPECT_NEAR(editor.view.camera.azimuth_rad, kept.azimuth_rad, 1e-9);
  EXPECT_NEAR(editor.view.camera.elevation_rad, kept.elevation_rad, 1e-9);
  gui.key(kKeyF2);
  gui.frames(3);
  ASSERT_NE(gui.find("###bookmark-name"), nullptr);
  gui.type("Garden");
  gui.key(kKeyEnter);
  gui.settle();
  gui.frames(3);
  EXPECT_EQ(editor.session.document().bookmarks->front().name, "Garden");
  EXPECT_EQ(editor.session.history().undoDescription(), "Renamed bookmark View 1 to Garden");
}

// By its keys, straight ahead, as far as it gets.
void walkTowards(Editor& editor, GuiDriver& gui, const Eigen::Vector2d& place) {
  keyboard::change('W', true);
  for (int i = 0; i < 600; ++i) {
    const Eigen::Vector2d way = place - editor.walk.feet().head<2>();
    if (way.norm() < 0.1) break;
    editor.view.camera.azimuth_rad = std::atan2(-way.x(), way.y());
    gui.frame();
  }
  keyboard::change('W', false);
  gui.frames(20);
}

// Its front door is at x = 7 to 8 in the south, its stair goes up northwards from y = 1.6 at x = 8.65 to 9.65.
class WalkingInTheSampleHouse : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(editor.session.start("import", {{"files", {(samplesFolder() / "house.ifc").string()}}}));
    gui.settle();
    gui.frames(3);
    ASSERT_TRUE(invoke(editor, "walk"));
    editor.walk_ground.wait();
    gui.frames(3);
    ASSERT_TRUE(editor.walk.active());
  }
  // In the hall, so that the stair is ahead.
  void standBeforeTheStair() {
    walkTowards(editor, gui, {7.5, 1.2});
    editor.view.camera.azimuth_rad = std::atan2(-1.65, 2);
    gui.frames(3);
  }
  // Until it is there, in seconds.
  double ride() {
    double seconds = 0;
    while (editor.walk.goesByItself() && seconds < 30) {
      gui.frame();
      seconds += ImGui::GetIO().DeltaTime;
    }
    gui.frames(30);
    return seconds;
  }
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor};
};

TEST_F(WalkingInTheSampleHouse, QGoesUpTheStairAheadAndDownAgainAndThePreviousViewComesBack) {
  standBeforeTheStair();
  const Eigen::Vector3d from = editor.walk.feet();
  gui.key('Q');
  ASSERT_TRUE(editor.walk.goesByItself());
  EXPECT_TRUE(gui.says("W A S D to stop here"));
  EXPECT_LT(ride(), 6);
  EXPECT_NEAR(editor.walk.feet().z(), 2.8, 0.05) << editor.walk.feet().transpose();
  EXPECT_GT(editor.walk.feet().y(), from.y() + 3) << "beyond the last step";
  editor.view.camera.azimuth_rad += std::numbers::pi;  // back towards the stair
  gui.frames(3);
  EXPECT_TRUE(gui.says("Stair down to Ground floor"));
  gui.key('Q');
  EXPECT_LT(ride(), 6);
  EXPECT_NEAR(editor.walk.feet().z(), 0, 0.05) << editor.walk.feet().transpose();
  for (int i = 0; i < 2; ++i) invoke(editor, "view-before");
  gui.frames(3);
  EXPECT_NEAR((editor.walk.feet() - from).norm(), 0, 0.05) << editor.walk.feet().transpose();
}

TEST_F(WalkingInTheSampleHouse, AClickOnTheNameOfAStairGoesUpAndAKeyStopsThere) {
  standBeforeTheStair();
  const auto labels = [&] {
    std::vector<ImVec2> found;  // where the pointer meets it
    const auto* scene = gui.find("###scene");
    for (float y = scene->rect.Min.y + 60; y < scene->rect.Max.y - 90 && found.empty(); y += 6)
      for (float x = scene->rect.Min.x + 10; x < scene->rect.Max.x && found.empty(); x += 20) {
        gui.moveTo({x, y});
        gui.frame();
        if (editor.pointed_label) found.push_back({x, y});
      }
    return found;
  }();
  ASSERT_EQ(labels.size(), 1U);
  gui.press();
  gui.frames(2);
  ASSERT_TRUE(editor.walk.goesByItself());
  while (editor.walk.goesByItself() && editor.walk.feet().z() < 1) gui.frame();
  gui.key('S');
  gui.frames(60);
  EXPECT_FALSE(editor.walk.goesByItself());
  EXPECT_GT(editor.walk.feet().z(), 0.4);
  EXPECT_LT(editor.walk.feet().z(), 2) << "it stays where it was stopped";
}

TEST_F(WalkingInTheSampleHouse, BeginsBeforeTheFrontDoorAndLeadsUpstairs) {
  EXPECT_NEAR(editor.walk.feet().x(), 7.5, 0.3) << editor.walk.feet().transpose();
  EXPECT_LT(editor.walk.feet().y(), -1) << "outside";
  EXPECT_NEAR(editor.view.camera.azimuth_rad, 0, 0.05) << "towards the house";
  walkTowards(editor, gui, {7.5, 1.2});
  walkTowards(editor, gui, {9.2, 1.2});
  walkTowards(editor, gui, {9.2, 6.3});
  EXPECT_NEAR((editor.walk.feet() - Eigen::Vector3d(9.2, 6.3, 2.8)).norm(), 0, 0.2) << editor.walk.feet().transpose();
  EXPECT_EQ(walkPlaceName(editor), "101 Gallery · Upper floor");
  walkTowards(editor, gui, {9.2, 1.2});
  EXPECT_NEAR((editor.walk.feet() - Eigen::Vector3d(9.2, 1.2, 0)).norm(), 0, 0.2) << editor.walk.feet().transpose();
}

}  // namespace
}  // namespace standpoint
