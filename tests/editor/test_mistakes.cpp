// SPDX-License-Identifier: GPL-3.0-or-later
// What proves a mistake, shown beside the sample solution.
#include <cstdlib>
#include <thread>

#include <gtest/gtest.h>

#include "demo_verbs.h"
#include "editor/clouds/cropped_cloud.h"
#include "editor/instrument/desk.h"
#include "editor/shell/escape.h"
#include "item_probe.h"
#include "tests/editor/graded.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

TEST(ProofLook, OfASurfaceIsFromBeforeItAndEdgeOnAlongIt) {
  ProofLook look{{1, 2, 1.5}, Eigen::Vector3d(0, -1, 0), {1.5, -2, 1.7}, 0.3, false};
  const auto before = cameraOf(look, Camera(), 0.8);
  EXPECT_LT(before.forward().dot(*look.normal), -0.9);
  EXPECT_FALSE(before.orthographic);
  look.edge_on = true;
  const auto along = cameraOf(look, Camera(), 0.8);
  EXPECT_NEAR(along.forward().dot(*look.normal), 0, 1e-9);
  EXPECT_NEAR(along.forward().z(), 0, 1e-9);
  EXPECT_TRUE(along.orthographic);
  look.normal = Eigen::Vector3d::UnitZ();  // a floor
  EXPECT_NEAR(cameraOf(look, Camera(), 0.8).forward().z(), 0, 1e-9);
}

TEST(ProofLook, HasTheWholePlaceInThePicture) {
  const Eigen::Vector2d size(400, 700);
  for (const bool edge_on : {false, true})
    for (const Eigen::Vector3d& normal : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 0, 1)}) {
      const ProofLook look{{3, 1, 0.5}, normal, {5, 1.5, 1.7}, 0.4, edge_on};
      const auto camera = cameraOf(look, Camera(), size.x() / size.y());
      for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0}) {
          const auto at = project(camera, look.centre + sign * 0.4 * Eigen::Vector3d::Unit(axis), size);
          ASSERT_TRUE(at);
          EXPECT_GT(at->x(), 0);
          EXPECT_LT(at->x(), size.x());
          EXPECT_GT(at->y(), 0);
          EXPECT_LT(at->y(), size.y());
        }
      const auto middle = project(camera, look.centre, size);
      EXPECT_NEAR(middle->x(), size.x() / 2, 1);
      EXPECT_NEAR(middle->y(), size.y() / 2, 1);
    }
}

TEST(CropShape, KeepsABallOrASliceOfIt) {
  CropShape shape{{0, 0, 0}, 1, std::nullopt, 0};
  EXPECT_TRUE(shape.keeps({0.9, 0, 0}));
  EXPECT_FALSE(shape.keeps({0.9, 0.9, 0}));
  shape.slice = Eigen::Vector3d::UnitX();
  shape.half_slice_m = 0.1;
  EXPECT_FALSE(shape.keeps({0.9, 0, 0}));
  EXPECT_TRUE(shape.keeps({0.05, 0.9, 0}));
}

// A desk whose exercise is drawn without its device.
class MistakeGui : public testing::Test {
 protected:
  MistakeGui() {
    setenv("HOME", folder_.path().c_str(), 1);
    showExercises(desk, editor);
  }
  // Levelled by nobody; with the exercise's solution, or without as an assigned one.
  void doWithoutLevelling(bool has_solution) {
    const auto known = findExercise("E05");
    ASSERT_TRUE(known);
    auto exercise = known->exercise;
    const auto actions = exercise.mistakes.front().actions;
    if (!has_solution) exercise.solution.clear();
    desk.device = findDevice("faro-focus");
    followProject(desk, editor);
    startExercise(desk, editor, exercise);
    ASSERT_NE(desk.rehearsal, nullptr) << desk.refused;
    editor.session.wait();
    Progress quiet;
    for (const auto& action : actions) {
      (void)desk.rehearsal->act(action, quiet);
      if (action.name == "start_scan")
        (void)desk.rehearsal->act({RehearsalAction::Kind::press, "continue", "", 0, {}}, quiet);
    }
    finishAndGrade(desk, editor);
    gui.settle();
    gui.frames(3);
  }
  template <class Condition>
  bool waitFor(Condition condition) {
    for (int i = 0; i < 12000 && !condition(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      gui.frame();
    }
    return condition();
  }

  TemporaryFolder folder_;
  Editor editor{verbsWithDemo(), [] {}};
  InstrumentDesk desk;
  GuiDriver gui{editor};
};

TEST_F(MistakeGui, AButtonOfTheBrokenRuleLeadsToItsPointsWithTheSampleSolutionBeside) {
  doWithoutLevelling(true);
  const auto before = editor.view.camera;
  ASSERT_TRUE(gui.click("###showlevelled"));
  gui.frames(2);
  ASSERT_TRUE(editor.proof);
  const auto& place = *desk.marks->rules.front().shown;
  const auto at = project(editor.view.camera, place.centre_m, editor.view.size);
  ASSERT_TRUE(at);
  EXPECT_GT(at->x(), 0);
  EXPECT_LT(at->x(), editor.view.size.x());
  EXPECT_GT(at->y(), 0);
  EXPECT_LT(at->y(), editor.view.size.y());
  EXPECT_EQ(editor.proof->ring_centre, place.centre_m) << "the ring is on the true surface";
  const Eigen::Vector3d delivered = place.centre_m + place.offset_m * *place.normal;
  const auto off = project(editor.view.camera, delivered, editor.view.size);
  ASSERT_TRUE(off);
  EXPECT_GT(off->y(), 0);
  EXPECT_LT(off->y(), editor.view.size.y());
  EXPECT_GT((*off - *at).norm(), 20) << "pixels";
  EXPECT_NE(gui.find("###back"), nullptr);
  ASSERT_TRUE(waitFor([&] { return editor.proof->yours && editor.proof->good; })) << editor.proof->good_text;
  EXPECT_GT(editor.proof->yours->points.size(), 100U);
  EXPECT_GT(editor.proof->good->points.size(), 100U);
  EXPECT_EQ(editor.proof->yours->colouring, editor.proof->good->colouring);
  EXPECT_NE(editor.proof->yours_text.find("Your scan\nOff the true surface: "), std::string::npos)
      << editor.proof->yours_text;
  EXPECT_NE(editor.proof->good_text.find("Sample solution\nOff the true surface: "), std::string::npos);
  EXPECT_EQ(escapeLayer(editor), EscapeLayer::proof);
  gui.key(256);  // Esc
  gui.frames(2);
  EXPECT_FALSE(editor.proof);
  EXPECT_EQ(editor.view.camera, before);
  // The second time the solution is there at once.
  ASSERT_TRUE(gui.click("###showplumb"));
  gui.frames(1);
  EXPECT_EQ(desk.mistakes.solving(), nullptr);
  ASSERT_TRUE(waitFor([&] { return editor.proof->good != nullptr; }));
  ASSERT_TRUE(gui.click("###back"));
  gui.frames(2);
  EXPECT_FALSE(editor.proof);
  EXPECT_EQ(editor.view.camera, before);
}

TEST_F(MistakeGui, AnAssignedExerciseShowsTheStudentsPointsAloneAndSaysWhy) {
  doWithoutLevelling(false);
  ASSERT_TRUE(gui.click("###showlevelled"));
  ASSERT_TRUE(waitFor([&] { return editor.proof && editor.proof->yours; }));
  EXPECT_EQ(editor.proof->good, nullptr);
  EXPECT_NE(editor.proof->good_text.find("assigned exercise"), std::string::npos);
  EXPECT_EQ(desk.mistakes.solving(), nullptr);
  ASSERT_TRUE(gui.click("###leave"));
  gui.settle();
  EXPECT_FALSE(editor.proof) << "it goes with the exercise";
}

TEST_F(MistakeGui, TheSampleSolutionCanBeGivenUp) {
  doWithoutLevelling(true);
  ASSERT_TRUE(gui.click("###showlevelled"));
  gui.frames(2);
  ASSERT_NE(desk.mistakes.solving(), nullptr);
  ASSERT_TRUE(gui.click("###cancel-solution"));
  gui.frames(2);
  EXPECT_EQ(desk.mistakes.solving(), nullptr);
  EXPECT_NE(editor.proof->good_text.find("cancelled"), std::string::npos);
}

}  // namespace
}  // namespace standpoint
