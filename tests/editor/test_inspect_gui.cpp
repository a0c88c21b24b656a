// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <gtest/gtest.h>

#include "demo_verbs.h"
#include "editor/shell/actions.h"
#include "editor/widgets/keyboard.h"
#include "item_probe.h"

namespace standpoint {
namespace {

// The demo house from above, its ground floor cut open.
class Inspect : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
    gui.settle();
    editor.picker.wait();
    editor.workspace = Workspace::inspect;
    editor.visibility.cut_height_m = 1.5;
    look(editor.view.camera, StandardView::top);
    editor.view.camera.orthographic = true;
    editor.view.frame_wanted = true;
    gui.frames(4);
  }
  ImVec2 screenOf(const Eigen::Vector3d& point) const {
    const auto pixel = project(editor.view.camera, point, editor.view.size);
    const auto* window = ImGui::FindWindowByName("###viewport");
    return {window->Pos.x + static_cast<float>(pixel->x()), window->Pos.y + static_cast<float>(pixel->y())};
  }
  void clickAt(const Eigen::Vector3d& place) {
    gui.moveTo(screenOf(place));
    gui.frames(2);
    gui.press();
    gui.settle();
  }
  std::size_t kept() const {
    const auto& measurements = editor.session.document().measurements;
    return measurements ? measurements->size() : 0;
  }
  double first() const { return figuresOf(editor.session.document().measurements->back())[0].value; }
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor};
};

TEST_F(Inspect, TwoClicksKeepADistanceInTheProjectAndUndoTakesItBack) {
  gui.key('M');
  ASSERT_EQ(editor.view.tool, Tool::measure);
  clickAt({1.5, 5, 0});
  EXPECT_EQ(kept(), 0u);
  clickAt({3.5, 6, 0});
  ASSERT_EQ(kept(), 1u);
  EXPECT_NEAR(first(), std::hypot(2.0, 1.0), 0.05) << "by the pixel";
  EXPECT_EQ(editor.view.tool, Tool::measure) << "for the next one";
  gui.key('Z', true);
  gui.settle();
  EXPECT_EQ(kept(), 0u);
}

TEST_F(Inspect, EnterEndsAPolygonAndBackspaceTakesTheLastCornerBack) {
  gui.key('M', true, true);
  clickAt({1.5, 5, 0});
  clickAt({3.5, 5, 0});
  clickAt({3.5, 6, 0});
  clickAt({2.0, 5.5, 0});
  gui.key(259);
  EXPECT_EQ(editor.view.measuring.points.size(), 3u);
  clickAt({1.5, 6, 0});
  gui.key(kKeyEnter);
  gui.settle();
  ASSERT_EQ(kept(), 1u);
  EXPECT_NEAR(first(), 2, 0.1);
}

TEST_F(Inspect, EscBeginsAMeasurementAnewBeforeItLeavesTheTool) {
  gui.key('M');
  clickAt({1.5, 5, 0});
  gui.key(kKeyEscape);
  gui.frames(2);
  EXPECT_EQ(editor.view.tool, Tool::measure);
  EXPECT_TRUE(editor.view.measuring.points.empty());
  gui.key(kKeyEscape);
  gui.frames(2);
  EXPECT_EQ(editor.view.tool, Tool::select);
}

TEST_F(Inspect, DelRemovesTheChosenMeasurement) {
  gui.key('M');
  clickAt({1.5, 5, 0});
  clickAt({3.5, 6, 0});
  ASSERT_EQ(kept(), 1u);
  editor.survey.measurement = 0;
  gui.key(kKeyDelete);
  gui.settle();
  EXPECT_EQ(kept(), 0u);
}

TEST_F(Inspect, AClipBoxHidesFromClicksWhatItCutsAway) {
  ASSERT_TRUE(editor.picker.pick(
      rayThrough(editor.view.camera, *project(editor.view.camera, {3.5, 6, 0}, editor.view.size), editor.view.size),
      editor.viewState()));
  Bounds corner;
  corner.extend(Eigen::Vector3d(0, 0, -1));
  corner.extend(Eigen::Vector3d(2, 2, 3));
  editor.view.clip.box = clipAround(corner, 0);
  EXPECT_FALSE(editor.picker.pick(
      rayThrough(editor.view.camera, *project(editor.view.camera, {3.5, 6, 0}, editor.view.size), editor.view.size),
      editor.viewState()));
}

TEST_F(Inspect, AFaceOfTheClipBoxIsPulledAndEscPutsItBack) {
  Bounds room;
  room.extend(Eigen::Vector3d(1, 4, 0));
  room.extend(Eigen::Vector3d(4, 7, 2));
  editor.view.clip.box = clipAround(room, 0);
  gui.frames(2);
  gui.moveTo(screenOf({4, 5.5, 1}));
  ImGui::GetIO().MouseDown[0] = true;
  gui.frames(2);
  gui.moveTo(screenOf({3, 5.5, 1}));
  gui.frames(2);
  EXPECT_NEAR(editor.view.clip.box->half.x(), 1, 0.05);
  EXPECT_NEAR(editor.view.clip.box->centre.x(), 2, 0.05);
  gui.key(kKeyEscape);
  gui.frames(2);
  EXPECT_NEAR(editor.view.clip.box->half.x(), 1.5, 1e-9);
  ImGui::GetIO().MouseDown[0] = false;
  gui.frames(2);
}

TEST_F(Inspect, ASectionIsLookedAtAlongItsThinSide) {
  editor.clipSection({2, 5, 1}, Eigen::Vector3d::UnitX());
  editor.lookAlongClip();
  EXPECT_TRUE(editor.view.camera.orthographic);
  EXPECT_NEAR(std::abs(editor.view.camera.forward().x()), 1, 1e-9);
}

TEST_F(Inspect, AWallIsPickedOnlyWhereThereIsACloudAndElseSaysWhy) {
  const auto* action = findAction("pick-wall");
  const auto why = whyNot(*action, editor);
  if (inspectedClouds(editor.session.document()).empty()) EXPECT_FALSE(why.empty());
}

}  // namespace
}  // namespace standpoint
