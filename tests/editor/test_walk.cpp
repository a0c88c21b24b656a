// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "demo_verbs.h"
#include "editor/shell/actions.h"
#include "editor/widgets/keyboard.h"
#include "item_probe.h"

namespace standpoint {
namespace {

class Walking : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
    gui.settle();
    editor.session.wait();
    ASSERT_TRUE(editor.session.start("collide", nlohmann::json::object()));
    gui.settle();
    editor.session.wait();
    gui.frames(2);
    ASSERT_TRUE(editor.session.document().collision);
  }
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor};
};

TEST_F(Walking, BeginsOnTheFloorAtEyeHeightAndEndsWithEscape) {
  gui.key('W');
  gui.frames(2);
  ASSERT_EQ(editor.view.tool, Tool::walk);
  ASSERT_TRUE(editor.walk.active());
  EXPECT_NEAR(editor.view.camera.eye().z() - editor.walk.feet().z(), 0.92 * 1.8, 1e-6);
  EXPECT_NEAR(editor.view.camera.elevation_rad, 0, 1e-9);
  gui.key(kKeyEscape);
  gui.frames(2);
  EXPECT_EQ(editor.view.tool, Tool::select);
  EXPECT_FALSE(editor.walk.active());
}

TEST_F(Walking, FollowsTheKeysThatAreHeld) {
  ASSERT_TRUE(invoke(editor, "walk"));
  gui.frames(2);
  const auto camera = editor.view.camera;
  const Eigen::Vector3d before = editor.walk.feet();
  keyboard::change('D', true);
  gui.frames(10);
  keyboard::change('D', false);
  gui.frames(2);
  const Eigen::Vector3d way = editor.walk.feet() - before;
  EXPECT_GT(way.norm(), 0.01);
  EXPECT_GT(way.dot(camera.right()), 0);
  EXPECT_NEAR((editor.view.camera.eye() - editor.walk.feet() - Eigen::Vector3d(0, 0, 0.92 * 1.8)).norm(), 0, 1e-6);
}

TEST_F(Walking, EndsWhenTheShapesAreComputedAgain) {
  ASSERT_TRUE(invoke(editor, "walk"));
  gui.frames(2);
  ASSERT_TRUE(editor.session.start("collide", {{"doors", "closed"}}));
  gui.settle();
  editor.session.wait();
  gui.frames(3);
  EXPECT_FALSE(editor.walk.active());
  EXPECT_EQ(editor.view.tool, Tool::select);
}

TEST_F(Walking, IsOfferedOnlyWhereThereAreShapes) {
  Editor empty(verbsWithDemo(), [] {});
  EXPECT_NE(whyNot(*findAction("walk"), empty), "");
  EXPECT_EQ(whyNot(*findAction("walk"), editor), "");
}

}  // namespace
}  // namespace standpoint
