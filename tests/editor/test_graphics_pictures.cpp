// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <vtk_glew.h>

#include "demo_document.h"
#include "editor/viewport/finish.h"
#include "editor/viewport/ground_shadow.h"
#include "editor/viewport/offscreen.h"

namespace standpoint {
namespace {

constexpr int kWidth = 320, kHeight = 240;

struct Drawn {
  std::vector<unsigned char> rgba;
  double brightness(int x0, int y0, int x1, int y1) const {  // of a part, from the lower left
    double sum = 0;
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) {
        const auto* c = &rgba[static_cast<std::size_t>(y * kWidth + x) * 4];
        sum += (c[0] + c[1] + c[2]) / 3.0;
      }
    return sum / ((x1 - x0) * (y1 - y0));
  }
};

// A room of 6 × 4 × 3 m, open to the south; its ground lies around it.
std::shared_ptr<const Environment> room() {
  Environment e;
  e.surfaces = {{"plaster", {0.8F, 0.8F, 0.8F, 1}}};
  Mesh mesh;
  const auto wall = [&](Eigen::Vector3f a, Eigen::Vector3f b, Eigen::Vector3f c) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {a, b, b + c - a, c});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
    mesh.surface_of_triangle.insert(mesh.surface_of_triangle.end(), 2, 0);
  };
  wall({0, 0, 0}, {6, 0, 0}, {0, 4, 0});
  wall({0, 4, 0}, {6, 4, 0}, {0, 4, 3});
  wall({0, 0, 0}, {0, 4, 0}, {0, 0, 3});
  wall({6, 0, 0}, {6, 4, 0}, {6, 0, 3});
  wall({0, 0, 3}, {6, 0, 3}, {0, 4, 3});
  e.meshes = {std::make_shared<Mesh>(mesh)};
  e.products.resize(1);
  e.instances = {{0, 0, Eigen::Affine3d::Identity()}};
  return std::make_shared<const Environment>(e);
}

class Levels : public ::testing::Test {
 protected:
  void SetUp() override {
    auto made = Offscreen::create(kWidth, kHeight, 1);
    if (!made) GTEST_SKIP() << describe(made.error());
    offscreen = std::move(*made);
    state.environment = room();
    state.edges = state.grid = false;
    state.camera.target = {3, 0, 1.5};
    state.camera.distance_m = 4;
    state.camera.azimuth_rad = state.camera.elevation_rad = 0;
    state.camera.view_angle_rad = 0.9;
  }
  SceneView& view() { return offscreen->scene(); }
  Drawn draw(bool fine) {
    std::uint64_t texture = view().texture(state, kWidth, kHeight, fine);
    while (view().refining()) texture = view().texture(state, kWidth, kHeight, fine);
    GLint width = 0, height = 0;
    glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(texture));
    glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &width);
    glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_HEIGHT, &height);
    std::vector<unsigned char> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    glBindTexture(GL_TEXTURE_2D, 0);
    return shrunk(pixels, width, height);
  }
  // As it is shown: a fine picture has more pixels each way.
  static Drawn shrunk(const std::vector<unsigned char>& pixels, int width, int height) {
    Drawn drawn;
    const int factor = width / kWidth;
    EXPECT_EQ(width, factor * kWidth);
    EXPECT_EQ(height, factor * kHeight);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        for (int c = 0; c < 4; ++c) {
          int sum = 0;
          for (int i = 0; i < factor * factor; ++i)
            sum +=
                pixels[static_cast<std::size_t>(((y * factor + i / factor) * width + x * factor + i % factor) * 4 + c)];
          drawn.rgba.push_back(static_cast<unsigned char>(sum / (factor * factor)));
        }
    return drawn;
  }
  std::unique_ptr<Offscreen> offscreen;
  ViewState state;
};

// A red wall in the plane y = 0, and the blue side of a slab in it, in other triangles.
std::shared_ptr<const Environment> wallWithSlab() {
  Environment e;
  e.surfaces = {{"wall", {0.9F, 0.1F, 0.1F, 1}}, {"slab", {0.1F, 0.1F, 0.9F, 1}}};
  e.products.resize(2);
  e.products[0].ifc_class = "IfcSlab";
  e.products[1].ifc_class = "IfcWallStandardCase";
  Mesh slab, wall;
  wall.positions = {{-2.037F, 0, -0.51F}, {8.03F, 0, -0.513F}, {8.041F, 0, 3.507F}, {-2.029F, 0, 3.511F}};
  wall.triangles = {{0, 1, 2}, {0, 2, 3}};
  constexpr int kParts = 13;
  for (int i = 0; i <= kParts; ++i)
    for (const float z : {0.913F, 1.287F}) slab.positions.emplace_back(0.011F + 0.4587F * static_cast<float>(i), 0, z);
  for (std::uint32_t i = 0; i < kParts; ++i) {
    slab.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
    slab.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
  }
  wall.surface_of_triangle.assign(wall.triangles.size(), 0);
  slab.surface_of_triangle.assign(slab.triangles.size(), 1);
  e.meshes = {std::make_shared<Mesh>(slab), std::make_shared<Mesh>(wall)};
  e.instances = {{0, 0, Eigen::Affine3d::Identity()}, {1, 1, Eigen::Affine3d::Identity()}};
  return std::make_shared<const Environment>(e);
}

TEST_F(Levels, ShowTheWallAloneWhereASlabHasASideInItsPlane) {
  state.environment = wallWithSlab();
  int seen = 0;
  for (const double distance_m : {1.2, 3.0, 12.0, 40.0})
    for (const double azimuth : {-1.4, -0.9, -0.31, 0.02, 0.57, 1.2})
      for (const double elevation : {-0.2, 0.13, 0.6}) {
        state.camera.distance_m = distance_m;
        state.camera.azimuth_rad = azimuth;
        state.camera.elevation_rad = elevation;
        const auto drawn = draw(false);
        int blue = 0;
        for (std::size_t p = 0; p < drawn.rgba.size(); p += 4) {
          blue += drawn.rgba[p + 2] > drawn.rgba[p] + 40 ? 1 : 0;
          seen += drawn.rgba[p] > drawn.rgba[p + 2] + 40 ? 1 : 0;
        }
        EXPECT_EQ(blue, 0) << distance_m << " m, azimuth " << azimuth << ", elevation " << elevation;
      }
  EXPECT_GT(seen, 100000);
}

// A sheet of points across the room, 2 m behind its open side, as an underlay.
ShownUnderlay sheet(double x0, double x1, double y) {
  auto cloud = std::make_shared<Cloud>();
  for (double x = x0; x < x1; x += 0.01)
    for (double z = 0.02; z < 3; z += 0.01) {
      CloudPoint p;
      p.position_m = {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
      cloud->points.push_back(p);
      cloud->colours.push_back({0, 255, 0, 255});
    }
  return {cloud, Eigen::Matrix4d::Identity()};
}

bool green(const Drawn& d, int x, int y) {
  const auto* c = &d.rgba[static_cast<std::size_t>(y * kWidth + x) * 4];
  return c[1] > 200 && c[0] < 60 && c[2] < 60;
}

// The eye is 6 m before the sheet, 1 m of which is 41 pixels then.
TEST_F(Levels, PointsAreWhereTheModelsPlacesAre) {
  for (const bool fine : {false, true}) {
    state.underlays = {sheet(2, 4, 2)};
    const Drawn drawn = draw(fine);
    EXPECT_TRUE(green(drawn, 160, 120));
    EXPECT_TRUE(green(drawn, 120, 120)) << "0.9 m to the left";
    EXPECT_TRUE(green(drawn, 200, 120));
    EXPECT_FALSE(green(drawn, 110, 120)) << "1.2 m to the left";
    EXPECT_FALSE(green(drawn, 210, 120));
    state.cut_height_m = 1.5;
    const Drawn cut = draw(fine);
    EXPECT_FALSE(green(cut, 160, 130)) << "above the cut";
    EXPECT_TRUE(green(cut, 160, 110));
    state.cut_height_m.reset();
  }
}

TEST_F(Levels, PointsBehindAWallAreHiddenByIt) {
  state.underlays = {sheet(1, 5, 4.5)};
  EXPECT_FALSE(green(draw(false), 160, 120));
  state.environment.reset();
  EXPECT_TRUE(green(draw(false), 160, 120)) << "and seen without it";
}

TEST_F(Levels, AScanIsRefinedUntilAllOfItIsThere) {
  auto cloud = std::make_shared<Cloud>(*sheet(0, 6, 2).cloud);
  state.cloud = cloud;
  const Drawn drawn = draw(true);
  EXPECT_FALSE(view().refining());
  EXPECT_TRUE(green(drawn, 160, 120));
  state.camera.orthographic = true;
  EXPECT_TRUE(green(draw(true), 160, 120)) << "in parallel, too";
}

TEST_F(Levels, ARoomHasDarkerCornersAtTheHighestLevelAndOnlyThere) {
  state.camera.target = {3, 1, 1.5};
  state.camera.distance_m = 0.5;
  state.graphics.level = GraphicsLevel::medium;
  const Drawn plain = draw(true);
  state.graphics.level = GraphicsLevel::high;
  const Drawn shaded = draw(true);
  // The back wall, 3.5 m away, is 427 pixels for 6 m: its middle, and where it meets the ceiling.
  const double middle = shaded.brightness(150, 110, 170, 130) / plain.brightness(150, 110, 170, 130);
  int darkest = 0;
  double least = 1;
  for (int y = 60; y < 238; ++y)
    if (const double share = shaded.brightness(150, y, 170, y + 1) / plain.brightness(150, y, 170, y + 1);
        share < least) {
      least = share;
      darkest = y;
    }
  EXPECT_GT(middle, 0.93) << "a wall stays what it is";
  EXPECT_LT(least, 0.80) << "at row " << darkest;
}

TEST_F(Levels, TheHorizonIsBetweenSkyAndGround) {
  state.camera.target = {3, -40, 1.5};
  state.camera.azimuth_rad = M_PI;  // away from the room
  for (const auto theme : {Theme::dark, Theme::light}) {
    state.graphics = {GraphicsLevel::medium, theme};
    const Drawn sky = draw(true);
    EXPECT_GT(sky.brightness(0, 126, kWidth, 140), sky.brightness(0, 90, kWidth, 114) + 10);
    EXPECT_LT(sky.brightness(0, 228, kWidth, 240), sky.brightness(0, 126, kWidth, 140)) << "lighter at the horizon";
    state.graphics.level = GraphicsLevel::low;
    const Drawn plain = draw(true);
    EXPECT_NE(plain.rgba, sky.rgba);
  }
}

TEST_F(Levels, TheLightThemeHasALightBackground) {
  state.camera.azimuth_rad = M_PI;
  state.camera.target = {3, -40, 1.5};
  const double dark = draw(true).brightness(0, 0, kWidth, kHeight);
  state.graphics.theme = Theme::light;
  EXPECT_GT(draw(true).brightness(0, 0, kWidth, kHeight), dark + 100);
}

// The same view again is the same picture, at each level, at rest and in motion, whatever was drawn before.
TEST_F(Levels, AreTheSameBytesWhenTheyAreDrawnAgain) {
  for (const auto level : {GraphicsLevel::low, GraphicsLevel::medium, GraphicsLevel::high})
    for (const bool fine : {false, true}) {
      state.graphics.level = level;
      const Drawn first = draw(fine);
      state.camera.azimuth_rad += 0.3;
      draw(fine);
      state.camera.azimuth_rad -= 0.3;
      EXPECT_EQ(draw(fine).rgba, first.rgba) << graphicsName(level) << fine;
      state.camera.azimuth_rad = 0;
    }
}

TEST_F(Levels, SmoothTheEdgesInMotionFromMediumOn) {
  state.camera.target = {3, -3, 1.5};
  state.camera.distance_m = 8;
  state.camera.elevation_rad = 0.2;
  state.camera.azimuth_rad = 0.4;
  const auto greys = [](const Drawn& d) {  // pixels that differ from both neighbours: steps are softened by such
    int count = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 1; x + 1 < kWidth; ++x) {
        const auto at = [&](int i) { return int{d.rgba[static_cast<std::size_t>(y * kWidth + i) * 4]}; };
        count += std::abs(at(x) - at(x - 1)) > 4 && std::abs(at(x) - at(x + 1)) > 4 ? 1 : 0;
      }
    return count;
  };
  state.graphics.level = GraphicsLevel::low;
  const int stepped = greys(draw(false));
  state.graphics.level = GraphicsLevel::medium;
  EXPECT_GT(greys(draw(false)), stepped + 100);
}

TEST_F(Levels, SpareTheLinesInMotionAtTheLowestWhereAProcessorDraws) {
  if (!view().means().by_processor) GTEST_SKIP() << "a graphics card draws here";
  state.graphics.level = GraphicsLevel::low;
  const auto drawnInMotion = [&](bool lines) {
    state.edges = state.grid = lines;
    state.camera.azimuth_rad = 0.3;
    draw(false);
    state.camera.azimuth_rad = 0;
    return draw(false).rgba;
  };
  const auto drawnAtRest = [&](bool lines) {
    drawnInMotion(lines);
    return draw(true).rgba;
  };
  EXPECT_EQ(drawnInMotion(true), drawnInMotion(false));
  EXPECT_NE(drawnAtRest(true), drawnAtRest(false));
  state.graphics.level = GraphicsLevel::medium;
  EXPECT_NE(drawnInMotion(true), drawnInMotion(false));
}

TEST_F(Levels, DropWhatIsRefinedAtOnceWhenTheCameraMoves) {
  state.graphics.level = GraphicsLevel::high;
  draw(false);
  view().texture(state, kWidth, kHeight, true);
  EXPECT_TRUE(view().refining());
  state.camera.azimuth_rad += 0.1;
  view().texture(state, kWidth, kHeight, false);
  EXPECT_FALSE(view().refining());
}

TEST_F(Levels, MapsKeepTheirColours) {
  state.graphics.level = GraphicsLevel::high;
  state.colour = ColourMode::confidence;
  draw(false);
  for (int part = 0; part < 2; ++part) view().texture(state, kWidth, kHeight, true);  // makes its framebuffers
  view().texture(state, kWidth, kHeight, true);
  EXPECT_FALSE(view().refining());
}

// `count` floors of 2 × 160 × 160 triangles beside each other, each an instance of its own, or all in one mesh.
std::shared_ptr<const Environment> floors(int count, bool one_mesh) {
  constexpr int kSide = 160;
  Environment e;
  e.surfaces = {{"plaster", {0.8F, 0.7F, 0.6F, 1}}};
  Mesh mesh;
  const auto close = [&] {
    const auto index = static_cast<std::uint32_t>(e.meshes.size());
    e.meshes.push_back(std::make_shared<Mesh>(std::exchange(mesh, Mesh())));
    e.products.emplace_back();
    e.instances.push_back({index, index, Eigen::Affine3d::Identity()});
  };
  for (int n = 0; n < count; ++n) {
    for (int i = 0; i < kSide * kSide; ++i) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      const float side = 1.0F / kSide, x = static_cast<float>(2 * n) + side * static_cast<float>(i % kSide),
                  y = side * static_cast<float>(i / kSide);
      const float z = i % 2 == 0 ? 0.0F : 0.1F;  // faces that meet at an angle have an edge
      mesh.positions.insert(mesh.positions.end(),
                            {{x, y, 0}, {x + side, y, z}, {x + side, y + side, 0}, {x, y + side, z}});
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
      mesh.surface_of_triangle.insert(mesh.surface_of_triangle.end(), 2, 0);
    }
    if (!one_mesh) close();
  }
  if (one_mesh) close();
  return std::make_shared<const Environment>(e);
}

class LargeModel : public Levels {
 protected:
  void SetUp() override {
    Levels::SetUp();
    if (!offscreen) return;
    state.edges = true;
    state.camera.target = {3.5, 0.5, 0};
    state.camera.distance_m = 6;
    state.camera.elevation_rad = 0.8;
  }
  int picturesUntilWhole() {
    int count = 1;
    for (view().texture(state, kWidth, kHeight, false); view().refining(); ++count)
      view().texture(state, kWidth, kHeight, false);
    return count;
  }
};

TEST_F(LargeModel, IsThereAfterSomePicturesAsIfItWereOneMesh) {
  const int of_all_pixels = view().means().by_processor ? 1 : 0;
  state.environment = floors(4, false);
  EXPECT_EQ(picturesUntilWhole(), 5 + of_all_pixels) << "one of 51200 triangles each, whose edges come with the next";
  const Drawn pieces = draw(false);
  state.environment = floors(4, true);
  EXPECT_EQ(picturesUntilWhole(), 2 + of_all_pixels);
  EXPECT_EQ(pieces.rgba, draw(false).rgba);
}

TEST_F(LargeModel, LooksAsItDoesWhenItsFirstPictureWasNotPrepared) {
  state.environment = floors(1, false);
  const Drawn unprepared = draw(true);
  EXPECT_FALSE(view().prepare(ViewState(), kWidth, kHeight)) << "it has drawn a model";
  offscreen.reset();
  auto another = Offscreen::create(kWidth, kHeight, 1);
  ASSERT_TRUE(another);
  offscreen = std::move(*another);
  int parts = 0;
  while (view().prepare(ViewState(), kWidth, kHeight)) ASSERT_LT(++parts, 10);
  EXPECT_EQ(parts, 4) << "buffers, what surfaces need, and buffers of fine pictures in two halves";
  EXPECT_EQ(unprepared.rgba, draw(true).rgba);
}

TEST_F(LargeModel, WhatIsHiddenIsGoneInTheNextPicture) {
  const auto hiding = [](std::uint32_t product) {
    HiddenProducts hidden(4, 0);
    hidden[product] = 1;
    return std::make_shared<const HiddenProducts>(hidden);
  };
  state.environment = floors(4, false);
  const Drawn all = draw(false);
  state.hidden = hiding(1);
  EXPECT_EQ(picturesUntilWhole(), 1) << "the others stay as they are";
  const Drawn without = draw(false);
  EXPECT_NE(without.rgba, all.rgba);
  state.hidden.reset();
  EXPECT_EQ(draw(false).rgba, all.rgba);

  state.hidden = hiding(1);
  state.environment = floors(4, false);  // all of it anew
  EXPECT_EQ(draw(false).rgba, without.rgba);
}

TEST_F(LargeModel, ComesBackAsItWasWhenAnotherPaintIsTakenOff) {
  state.environment = floors(3, false);
  const Drawn plain = draw(false);
  state.colour = ColourMode::confidence;
  EXPECT_EQ(picturesUntilWhole(), 1) << "its triangles stay";
  EXPECT_NE(draw(false).rgba, plain.rgba);
  state.colour = ColourMode::model;
  state.edges = false;
  EXPECT_NE(draw(false).rgba, plain.rgba);
  state.edges = true;
  EXPECT_EQ(draw(false).rgba, plain.rgba);
}

TEST_F(Levels, AnEmptySceneHasNoSky) {
  state.environment.reset();
  const Drawn low = draw(true);
  state.graphics.level = GraphicsLevel::high;
  EXPECT_EQ(draw(true).rgba, low.rgba);
}

TEST_F(Levels, CountPicturesInWhichOnlyTheCameraMoved) {
  const auto before = view().movedPictures();
  draw(false);
  state.camera.azimuth_rad += 0.1;
  draw(false);
  EXPECT_EQ(view().movedPictures(), before + 1);
  state.graphics.level = GraphicsLevel::medium;
  draw(false);
  EXPECT_EQ(view().movedPictures(), before + 1) << "another level";
  EXPECT_GT(view().cost_s(state, kWidth, kHeight), 0);
  draw(false);
  EXPECT_EQ(view().movedPictures(), before + 1) << "drawn for its time";
}

TEST_F(Levels, DrawFewerPixelsWhileTheCameraMovesOrAModelComesAndAllOfThemAtRest) {
  const auto size = [&](bool fine) {
    GLint width = 0, height = 0;
    const auto texture = static_cast<GLuint>(view().texture(state, kWidth, kHeight, fine));
    glBindTexture(GL_TEXTURE_2D, texture);
    glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &width);
    glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_HEIGHT, &height);
    glBindTexture(GL_TEXTURE_2D, 0);
    return std::pair(width, height);
  };
  ASSERT_EQ(size(false), std::pair(kWidth / 2, kHeight / 2)) << "the model has just come";
  ASSERT_TRUE(view().refining());
  EXPECT_EQ(size(false), std::pair(kWidth, kHeight));
  for (const auto level : {GraphicsLevel::low, GraphicsLevel::medium, GraphicsLevel::high}) {
    state.graphics.level = level;
    state.graphics.motion_size = 0.5;
    draw(false);
    EXPECT_EQ(size(false), std::pair(kWidth, kHeight)) << "it has not moved yet";
    state.camera.azimuth_rad += 0.1;
    EXPECT_EQ(size(false), std::pair(kWidth / 2, kHeight / 2));
    const Drawn at_rest = draw(true);
    ViewState never_moved = state;
    state.graphics.motion_size = 1;
    EXPECT_EQ(draw(true).rgba, at_rest.rgba) << graphicsName(level);
    state = never_moved;
  }
}

TEST_F(Levels, CountPicturesInWhichOnlyAnInstrumentWorks) {
  const auto moved = view().movedPictures(), worked = view().workedPictures();
  Station station;
  station.instrument_height_m = 1.6;
  station.true_pose.translation = {3, 2, 1.6};
  state.working = WorkingInstrument{standing(station, "leica-rtc360"), {}};
  draw(false);
  EXPECT_EQ(view().workedPictures(), worked) << "it has come";
  for (int i = 0; i < 3; ++i) {
    state.working->motion.head_rad += 0.1;
    draw(false);
  }
  EXPECT_EQ(view().workedPictures(), worked + 3);
  draw(false);
  EXPECT_EQ(view().workedPictures(), worked + 3) << "nothing has moved";
  EXPECT_EQ(view().movedPictures(), moved);
  state.camera.azimuth_rad += 0.1;
  draw(false);
  EXPECT_EQ(view().workedPictures(), worked + 3);
  EXPECT_EQ(view().movedPictures(), moved + 1);
}

TEST_F(Levels, AShaderThatTheDriverRefusesIsAReasonAndNoCrash) {
  view().texture(state, kWidth, kHeight, false);
  const FullScreenProgram broken("#version 150\nthis is no shader");
  EXPECT_FALSE(broken.problem().empty());
  const FullScreenProgram newer("#version 990\nvoid main() {}");
  EXPECT_FALSE(newer.problem().empty());
}

TEST(GroundShadow, FallsBesideWhatStandsAndEndsInNothing) {
  ViewState state;
  state.environment = room();
  const auto shadow = castShadow(state);
  ASSERT_EQ(shadow.darkness.size(), static_cast<std::size_t>(GroundShadow::kSide) * GroundShadow::kSide);
  const auto at = [&](double x, double y) {
    const auto column = static_cast<std::size_t>((x - shadow.x) / shadow.width_m * GroundShadow::kSide),
               row = static_cast<std::size_t>((y - shadow.y) / shadow.height_m * GroundShadow::kSide);
    return int{shadow.darkness[row * GroundShadow::kSide + column]};
  };
  EXPECT_GT(at(3, 2), 200) << "below the room";
  EXPECT_GT(at(7, 2), 90) << "in the shadow of its ceiling, 1.56 m to the east";
  EXPECT_LT(at(-1, 2), at(7, 2) / 2) << "towards the sun";
  for (std::size_t i = 0; i < GroundShadow::kSide; ++i) {
    EXPECT_LE(shadow.darkness[i], 1);
    EXPECT_LE(shadow.darkness[i * GroundShadow::kSide], 1);
  }
}

TEST(GroundShadow, OfNothingOrOfWhatIsHiddenIsNone) {
  EXPECT_TRUE(castShadow({}).darkness.empty());
  ViewState state;
  state.environment = room();
  state.hidden = std::make_shared<const HiddenProducts>(1, std::uint8_t{1});
  EXPECT_TRUE(castShadow(state).darkness.empty());
  state.hidden.reset();
  state.cut_height_m = -1;
  EXPECT_TRUE(castShadow(state).darkness.empty()) << "cut away";
}

TEST(GroundShadow, OfTerrainIsNone) {
  auto e = *room();
  e.products[0].ifc_class = "IfcSite";
  ViewState state;
  state.environment = std::make_shared<const Environment>(e);
  EXPECT_TRUE(castShadow(state).darkness.empty());
}

}  // namespace
}  // namespace standpoint
