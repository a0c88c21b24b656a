// SPDX-License-Identifier: GPL-3.0-or-later
// An image on a surface scales its material's reflectance: ρ L(uv) / mean of L, L the linear luminance.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/scanners/scenes.h"

namespace standpoint {
namespace {

using namespace testing;

// A bitmap of 24 bits, grey: `grey(x, y)` from the upper left corner.
template <class Grey>
std::shared_ptr<const Image> bitmap(std::uint32_t width, std::uint32_t height, Grey grey) {
  const std::uint32_t row = (3 * width + 3) / 4 * 4, size = 54 + row * height;
  std::vector<std::byte> bytes(size);
  const auto put = [&](std::size_t at, std::uint32_t value, int count) {
    for (int k = 0; k < count; ++k) bytes[at + static_cast<std::size_t>(k)] = static_cast<std::byte>(value >> (8 * k));
  };
  put(0, 'B' | 'M' << 8, 2), put(2, size, 4), put(10, 54, 4), put(14, 40, 4), put(18, width, 4), put(22, height, 4);
  put(26, 1, 2), put(28, 24, 2);
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        bytes[54 + std::size_t{row} * (height - 1 - y) + 3 * std::size_t{x} + c] = static_cast<std::byte>(grey(x, y));
  return std::make_shared<const Image>(Image{"poster", "image/bmp", std::move(bytes)});
}

double linear(double srgb) { return std::pow((srgb / 255 + 0.055) / 1.055, 2.4); }

// A poster of 2 m at 10 m, white on the left of the middle (+y) and grey on its right.
struct Poster {
  SceneBuilder scene;
  Poster(bool unlit = false) {
    scene.quad({10, 1, -1}, {0, -2, 0}, {0, 0, 2});
    auto& environment = const_cast<Environment&>(*scene.environment());
    environment.images.push_back(bitmap(64, 64, [](std::uint32_t x, std::uint32_t) { return x < 32 ? 255 : 128; }));
    environment.surfaces[0].image = 0;
    environment.surfaces[0].unlit = unlit;
    auto& mesh = const_cast<Mesh&>(*environment.meshes[0]);
    mesh.texture_coordinates = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  }
  PointBlock scanned(Effects effects) const {
    ScanOptions options;
    options.effects = effects;
    options.channels.truth = true;
    const auto rtc = testing::instrument("leica-rtc360");
    return testing::scanned(*scene.build(), allOf(*scene.environment(), 0.4), rtc, window(rtc, -4, 4, -4, 4, 80, 80),
                            options)
        .points;
  }
};

// Power over that of a white Lambert surface there, at the place of the point.
double reflectance(const PointBlock& points, std::size_t i) {
  const Eigen::Vector3d p(points.x_m[i], points.y_m[i], points.z_m[i]);
  return std::pow(10, static_cast<double>(points.truth.received_db[i]) / 10) * p.squaredNorm() / (p.x() / p.norm());
}

TEST(Textures, ScaleTheReflectanceAndKeepItsMean) {
  const auto points = Poster().scanned(Effects::none().with(Effect::textures));
  ASSERT_EQ(points.size(), 6400U);
  const double white = 1, grey = linear(128), mean = (white + grey) / 2;
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum += reflectance(points, i) / static_cast<double>(points.size());
    if (std::abs(points.y_m[i]) > 0.05) {  // beside the pixels that are mixed
      ASSERT_NEAR(reflectance(points, i), 0.4 * (points.y_m[i] > 0 ? white : grey) / mean, 2e-3) << points.y_m[i];
    }
  }
  EXPECT_NEAR(sum, 0.4, 0.004);  // the first column is on the edge of the window: half of one more on the white side
}

TEST(Textures, AreLeftOutByNameAndWhereTheImageHasTheLightInIt) {
  for (const auto& points :
       {Poster().scanned(Effects::none()), Poster(true).scanned(Effects::none().with(Effect::textures))}) {
    ASSERT_EQ(points.size(), 6400U);
    for (std::size_t i = 0; i < points.size(); ++i) ASSERT_NEAR(reflectance(points, i), 0.4, 1e-4);
  }
}

// Nothing that is printed returns more than all light.
TEST(Textures, NeverReturnMoreThanAWhiteSurface) {
  const Poster poster;
  ScanOptions options;
  options.effects = Effects::none().with(Effect::textures);
  options.channels.truth = true;
  const auto rtc = testing::instrument("leica-rtc360");
  const auto points = testing::scanned(*poster.scene.build(), allOf(*poster.scene.environment(), 0.9), rtc,
                                       window(rtc, -4, 4, -4, 4, 40, 40), options)
                          .points;
  for (std::size_t i = 0; i < points.size(); ++i) ASSERT_LT(reflectance(points, i), 1.001);
}

}  // namespace
}  // namespace standpoint
