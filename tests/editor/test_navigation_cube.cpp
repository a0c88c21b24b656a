// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "demo_verbs.h"
#include "editor/camera/navigation_cube.h"
#include "editor/shell/actions.h"
#include "editor/widgets/keyboard.h"
#include "item_probe.h"

namespace standpoint {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3i;

TEST(NavigationCube, HasAPartToEveryDirectionAndLooksFromThere) {
  int parts = 0;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        const Vector3i part(x, y, z);
        if (part.isZero()) continue;
        Camera camera;
        lookFromCubePart(camera, part);
        EXPECT_NEAR(camera.forward().dot(part.cast<double>().normalized()), -1, 1e-9) << part.transpose();
        EXPECT_EQ(camera.orthographic, part.cwiseAbs().sum() == 1);
        // From there it is in the middle of the picture.
        EXPECT_EQ(cubePartAt(camera, {0.01, 0.02}), part);
        ++parts;
      }
  EXPECT_EQ(parts, 26);
}

TEST(NavigationCube, ShowsThreeFacesFromACornerAndNothingBesideItself) {
  Camera camera;
  look(camera, StandardView::corner);
  EXPECT_EQ(cubeFaces(camera).size(), 3U);
  EXPECT_FALSE(cubePartAt(camera, {1.8, 0}));
  look(camera, StandardView::front);
  ASSERT_EQ(cubeFaces(camera).size(), 1U);
  EXPECT_STREQ(cubeFaces(camera)[0].name, "Front");
  EXPECT_EQ(cubePartAt(camera, {0.9, 0}), Vector3i(1, -1, 0));
  EXPECT_EQ(cubePartAt(camera, {0, -0.9}), Vector3i(0, -1, 1));
  EXPECT_EQ(cubePartAt(camera, {-0.9, 0.9}), Vector3i(-1, -1, -1));
  EXPECT_EQ(cubePartOutline(camera, {1, -1, 0}).size(), 1U);
}

class View : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
    gui.settle();
    gui.frames(2);
    gui.moveTo(gui.find("###scene")->rect.GetCenter());
  }
  void wheel(float up, float aside) {
    ImGui::GetIO().MouseWheel = up;
    ImGui::GetIO().MouseWheelH = aside;
    gui.frame();
    ImGui::GetIO().MouseWheel = ImGui::GetIO().MouseWheelH = 0;
    gui.frame();
  }
  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor};
};

TEST_F(View, TurnsToThePartOfTheCubeThatIsClicked) {
  const auto* cube = gui.find("###navigation-cube");
  ASSERT_NE(cube, nullptr);
  look(editor.view.camera, StandardView::front);
  gui.frame();
  const ImVec2 middle = cube->rect.GetCenter();
  gui.moveTo({middle.x, middle.y - 20});
  gui.press();
  gui.frames(2);
  EXPECT_NEAR(editor.view.camera.forward().dot(Vector3d(0, 1, -1).normalized()), 1, 1e-6) << "from the edge at the top";
  EXPECT_TRUE(editor.selection.empty()) << "the click was the cube's";
}

TEST_F(View, LeavesTheCubeFreeOfControlsHoweverNarrowItIs) {
  for (const auto mode : {ColourMode::model, ColourMode::reflectance, ColourMode::expected_intensity})
    for (float width = 900; width < 1500; width += 60) {
      ImGui::GetIO().DisplaySize.x = width;
      editor.view.colour = mode;
      gui.frames(4);
      const ImRect cube({editor.cube_corner.x(), editor.beside_cube + ImGui::GetFrameHeight() / 2},
                        {width, editor.cube_corner.y()});
      for (const auto& item : itemProbe().items)
        if (item.window == "###viewport" && item.label.find("###scene") == std::string::npos &&
            item.label != "###navigation-cube" && item.rect.GetWidth() > 4) {
          EXPECT_TRUE(item.rect.Min.x >= editor.overlay_end || !item.rect.Overlaps(cube))
              << item.label << " at " << width << " in mode " << static_cast<int>(mode);
        }
    }
}

TEST_F(View, TurnsWithTwoFingersToTheSideAndPansWithShift) {
  const auto before = editor.view.camera;
  wheel(0, 1);
  EXPECT_GT(std::abs(editor.view.camera.azimuth_rad - before.azimuth_rad), 0.05);
  EXPECT_NEAR(editor.view.camera.distance_m, before.distance_m, 1e-9);
  const auto turned = editor.view.camera;
  keyboard::change(kKeyShift, true);
  wheel(2, 0);
  keyboard::change(kKeyShift, false);
  EXPECT_EQ(editor.view.camera.azimuth_rad, turned.azimuth_rad);
  EXPECT_EQ(editor.view.camera.distance_m, turned.distance_m);
  EXPECT_GT((editor.view.camera.target - turned.target).norm(), 0.05);
}

TEST_F(View, ComesNoCloserByMoreThanFiveTicksAFrame) {
  const auto before = editor.view.camera;
  wheel(40, 0);
  const double jumped = editor.view.camera.distance_m;
  editor.view.camera = before;
  gui.frame();
  wheel(5, 0);
  EXPECT_NEAR(editor.view.camera.distance_m, jumped, 1e-9);
}

TEST_F(View, PansWithAltForWhoeverHasNoMiddleButton) {
  const auto before = editor.view.camera;
  const ImVec2 middle = gui.find("###scene")->rect.GetCenter();
  keyboard::change(kKeyAlt, true);
  ImGui::GetIO().MouseDown[0] = true;
  gui.frames(2);
  gui.moveTo({middle.x + 20, middle.y});
  gui.moveTo({middle.x + 60, middle.y + 10});
  ImGui::GetIO().MouseDown[0] = false;
  gui.frames(2);
  keyboard::change(kKeyAlt, false);
  gui.frame();
  EXPECT_EQ(editor.view.camera.azimuth_rad, before.azimuth_rad);
  EXPECT_GT((editor.view.camera.target - before.target).norm(), 0.1);
}

TEST_F(View, FliesThroughWallsAndWalksOnFromThere) {
  ASSERT_TRUE(invoke(editor, "fly"));
  gui.frames(2);
  ASSERT_EQ(editor.view.tool, Tool::fly);
  const auto before = editor.view.camera;
  keyboard::change('W', true);
  keyboard::change('E', true);
  gui.frames(30);
  keyboard::change('W', false);
  keyboard::change('E', false);
  gui.frames(20);
  const Vector3d way = editor.view.camera.eye() - before.eye();
  EXPECT_GT(way.norm(), 1);
  EXPECT_LT(way.norm(), 3 * 0.55);
  EXPECT_GT(way.z(), before.forward().z() * way.norm()) << "E goes up";
  EXPECT_EQ(editor.view.tool, Tool::fly) << "E picks no material then";
  gui.key('U');
  editor.walk_ground.wait();
  gui.frames(3);
  EXPECT_TRUE(editor.walk.active());
  gui.key(kKeyEscape);
  gui.frames(2);
  EXPECT_EQ(editor.view.tool, Tool::select);
}

}  // namespace
}  // namespace standpoint
