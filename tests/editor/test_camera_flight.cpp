// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "demo_document.h"
#include "demo_verbs.h"
#include "editor/camera/camera_flight.h"
#include "editor/model/station_steps.h"
#include "editor/shell/actions.h"
#include "item_probe.h"

namespace standpoint {
namespace {

Camera cameraAt(double x_m, double azimuth_rad, double distance_m = 10) {
  Camera camera;
  camera.target = {x_m, 0, 0};
  camera.azimuth_rad = azimuth_rad;
  camera.distance_m = distance_m;
  return camera;
}

TEST(CameraFlight, LeavesFromWhereTheCameraWasAndEndsExactlyWhereItWasSent) {
  CameraFlight flight(0.2);
  Camera camera = cameraAt(0, 0);
  flight.step(camera, 0.016);
  const Camera goal = cameraAt(30, 2, 4);
  camera = goal;
  flight.step(camera, 0.01);
  EXPECT_TRUE(flight.flies());
  EXPECT_LT(camera.target.x(), 1) << "slowly at first, and never at the goal before";
  double last_m = camera.target.x();
  for (int i = 0; i < 18; ++i) {
    flight.step(camera, 0.01);
    EXPECT_GT(camera.target.x(), last_m);
    last_m = camera.target.x();
  }
  flight.step(camera, 0.05);
  EXPECT_EQ(camera, goal);
  EXPECT_FALSE(flight.flies());
}

TEST(CameraFlight, TurnsTheShorterWayRound) {
  const Camera half = between(cameraAt(0, 3.0), cameraAt(0, -3.0), 0.5);
  EXPECT_NEAR(std::cos(half.azimuth_rad), -1, 1e-12) << "through south-west, not round by north";
  EXPECT_NEAR(between(cameraAt(0, 0, 1), cameraAt(0, 0, 100), 0.5).distance_m, 10, 1e-9);
}

TEST(CameraFlight, LeavesStepsAndHandsAlone) {
  CameraFlight flight(0.2);
  Camera camera = cameraAt(0, 0);
  flight.step(camera, 0.016);
  const Camera near = cameraAt(0.5, 0.05);
  camera = near;
  flight.step(camera, 0.016);
  EXPECT_EQ(camera, near) << "a step";
  camera = cameraAt(50, 1);
  flight.step(camera, 0.05);
  ASSERT_TRUE(flight.flies());
  const Camera steered = cameraAt(7, 0.3);
  camera = steered;
  flight.settle(camera);
  flight.step(camera, 0.05);
  EXPECT_EQ(camera, steered) << "a hand has the last word";
  EXPECT_FALSE(flight.flies());
}

TEST(CameraFlight, TakesNoTimeUnlessItIsGivenSome) {
  CameraFlight flight;
  Camera camera = cameraAt(0, 0);
  flight.step(camera, 0.016);
  camera = cameraAt(50, 1);
  flight.step(camera, 0.016);
  EXPECT_EQ(camera, cameraAt(50, 1));
}

TEST(CameraFlight, IsHowACommandMovesTheViewAndADragEndsIt) {
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor};
  editor.session.start("demo", nlohmann::json::object());
  gui.settle();
  gui.frames(4);
  editor.flight = CameraFlight(0.25);
  gui.frames(2);
  ASSERT_TRUE(invoke(editor, "view-top"));
  const Camera goal = editor.view.camera;
  gui.frame();
  EXPECT_TRUE(editor.flight.flies());
  EXPECT_FALSE(looksStraightDown(editor.view.camera));
  gui.frames(40);
  EXPECT_EQ(editor.view.camera, goal);
  ASSERT_TRUE(invoke(editor, "view-front"));
  gui.frames(3);
  ASSERT_TRUE(editor.flight.flies());
  gui.moveTo({640, 400});
  auto& io = ImGui::GetIO();
  io.MouseDown[1] = true;
  gui.frames(2);
  for (int i = 0; i < 4; ++i) gui.moveTo({640.0F + 15 * i, 400});
  EXPECT_FALSE(editor.flight.flies());
  io.MouseDown[1] = false;
  const Camera left = editor.view.camera;
  gui.frames(20);
  EXPECT_EQ(editor.view.camera, left);
}

TEST(CameraFlight, ArrivesAtAStationAndLeavesItAgain) {
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor};
  editor.session.start("demo", nlohmann::json::object());
  gui.settle();
  gui.frames(4);
  editor.flight = CameraFlight(0.25);
  gui.frames(2);
  editor.survey.station = 1;
  const Camera before = editor.view.camera;
  ASSERT_TRUE(invoke(editor, "look-from-station"));
  gui.frame();
  EXPECT_TRUE(editor.flight.flies());
  gui.frames(40);
  EXPECT_TRUE(looksFromStation(editor));
  const double angle_rad = editor.view.camera.view_angle_rad;
  EXPECT_GT(angle_rad, before.view_angle_rad);
  ASSERT_TRUE(invoke(editor, "view-corner"));
  const Camera goal = editor.view.camera;
  gui.frames(40);
  EXPECT_LT((editor.view.camera.target - goal.target).norm(), 1e-9);
  EXPECT_EQ(editor.view.camera.view_angle_rad, before.view_angle_rad);
}

}  // namespace
}  // namespace standpoint
