// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <gtest/gtest.h>
#include <stb/stb_image.h>

#include "demo_document.h"
#include "editor/film/panorama.h"
#include "editor/film/shot.h"
#include "editor/viewport/offscreen.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

void addCube(Environment& e, const Vector3d& centre, double size, const Colour& colour) {
  e.surfaces.push_back({"paint", colour});
  const Vector3d half = Vector3d::Constant(size / 2);
  addBox(e, "cube", "IfcBuildingElementProxy", centre - half, centre + half,
         static_cast<std::uint32_t>(e.surfaces.size() - 1));
}

struct Seen {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;
  // The middle of all pixels that look like it.
  Vector2d middleOf(const std::function<bool(int, int, int)>& wanted) const {
    Vector2d sum = Vector2d::Zero();
    int count = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const auto* c = &rgb[static_cast<std::size_t>(y * width + x) * 3];
        if (!wanted(c[0], c[1], c[2])) continue;
        sum += Vector2d(x + 0.5, y + 0.5);
        ++count;
      }
    return count == 0 ? Vector2d(-1, -1) : Vector2d(sum / count);
  }
};

Seen read(const std::filesystem::path& file) {
  Seen seen;
  int channels = 0;
  if (auto* data = stbi_load(file.c_str(), &seen.width, &seen.height, &channels, 3)) {
    seen.rgb.assign(data, data + static_cast<std::size_t>(seen.width) * seen.height * 3);
    stbi_image_free(data);
  }
  return seen;
}

class ShotPictures : public testing::Test {
 protected:
  void SetUp() override {
    auto made = Offscreen::create(64, 64, 1);
    if (!made) GTEST_SKIP() << describe(made.error());
    offscreen = std::move(*made);
  }
  Seen shoot(const ShotRequest& request) {
    auto begun = Shoot::begin(request);
    EXPECT_TRUE(begun) << describe(begun.error());
    for (bool whole = false; begun && !whole;) {
      const auto stepped = (*begun)->step(offscreen->scene());
      EXPECT_TRUE(stepped) << describe(stepped.error());
      whole = !stepped || *stepped;
    }
    return read(request.file);
  }
  TemporaryFolder folder;
  std::unique_ptr<Offscreen> offscreen;
};

bool red(int r, int g, int b) { return r > 60 && r > 2 * g && r > 2 * b; }
bool green(int r, int g, int b) { return g > 60 && g > 2 * r && g > 2 * b; }
bool blue(int r, int g, int b) { return b > 60 && b > 2 * r && b > 2 * g; }

// Three small cubes around an eye: one ahead and to the right, one behind, across the picture's border, one steeply up.
TEST_F(ShotPictures, PanoramaHasWhatIsSeenAtThePixelOfItsDirection) {
  auto e = std::make_shared<Environment>();
  const Vector3d eye(10, 20, 2);
  const Vector3d right = Vector3d(3, 4, -0.5), behind = Vector3d(-1, -5, 1), up = Vector3d(1, 1, 5);
  addCube(*e, eye + right, 0.4, {1, 0, 0, 1});
  addCube(*e, eye + behind, 0.4, {0, 1, 0, 1});
  addCube(*e, eye + up, 0.4, {0, 0, 1, 1});
  ShotRequest request;
  request.kind = ShotKind::panorama;
  request.file = folder.path() / "around.png";
  request.width = 1024;
  request.height = 512;
  request.view.environment = e;
  request.view.edges = false;
  request.view.graphics.level = GraphicsLevel::low;
  auto& camera = request.view.camera;
  camera.azimuth_rad = 0;
  camera.elevation_rad = 0.3;  // where somebody happens to look up, the horizon stays in the middle
  camera.distance_m = 7;
  camera.target = eye + camera.forward() * camera.distance_m;
  const auto seen = shoot(request);
  ASSERT_EQ(seen.width, 1024);
  const auto wanted = [](const Vector3d& direction) { return pixelOfDirection(direction, 0, 1024, 512); };
  EXPECT_LT((seen.middleOf(red) - wanted(right)).norm(), 2);
  EXPECT_LT((seen.middleOf(green) - wanted(behind)).norm(), 2);
  EXPECT_LT((seen.middleOf(blue) - wanted(up)).norm(), 8) << "near the zenith a pixel is narrow";
}

TEST_F(ShotPictures, PictureHasWhatIsSeenWhereTheCameraProjectsIt) {
  auto e = std::make_shared<Environment>();
  addCube(*e, {1, 2, 0}, 0.3, {1, 0, 0, 1});
  ShotRequest request;
  request.file = folder.path() / "view.png";
  request.width = 640;
  request.height = 360;
  request.view.environment = e;
  request.view.edges = request.view.grid = false;
  request.view.graphics.level = GraphicsLevel::low;
  const auto seen = shoot(request);
  const auto wanted = project(request.view.camera, {1, 2, 0}, {640, 360});
  ASSERT_TRUE(wanted);
  EXPECT_LT((seen.middleOf(red) - *wanted).norm(), 2);
}

TEST_F(ShotPictures, EachKindOfTheHouseIsMade) {
  const auto house = demoHouse();
  for (const auto& row : shotKinds()) {
    SCOPED_TRACE(row.id);
    ShotRequest request;
    request.kind = row.kind;
    request.file = folder.path() / (std::string(row.id) + row.extension);
    request.width = 256;
    request.height = 128;
    request.rate = 10;
    request.seconds = 0.5;
    request.view.environment = house.environment();
    request.around.extend({0, 0, 0});
    request.around.extend({8, 6, 6});
    for (int i = 0; i < 20; ++i) request.way.emplace_back(1 + 0.2 * i, 2, 0);
    shoot(request);
    EXPECT_GT(std::filesystem::file_size(request.file), 1000U);
  }
}

}  // namespace
}  // namespace standpoint
