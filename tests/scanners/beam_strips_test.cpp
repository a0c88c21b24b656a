// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/beam_strips.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "tests/scanners/scenes.h"

namespace standpoint {
namespace {

using namespace testing;

// Along +x from the origin.
const Beam kBeam{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(), -Eigen::Vector3d::UnitY(),
                 Eigen::Vector3d::UnitZ()};
constexpr double kRange = 10;
constexpr std::array<std::uint32_t, 4> kMiddle = {0x7FFFFFFF, 0x7FFFFFFF, 0x7FFFFFFF, 0};  // strays nowhere

// Strips of sheets that stand across the beam, each from one place to another along y; their vertical edges are those
// that the beam can hold.
std::vector<SubRay> stripsBetween(const std::vector<double>& places, double lean = 0, double low = -1) {
  SceneBuilder scene;
  const Instrument instrument = testing::instrument("leica-rtc360");
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double shift = lean * static_cast<double>(i);
    scene.quad({kRange, places[i] - shift / 2, low}, {0, -5, 0}, {0, shift, 2});
  }
  const auto rays = scene.build();
  const auto& embree = dynamic_cast<const EmbreeScene&>(*rays);
  BeamEdges edges;
  for (std::uint32_t placement = 0; placement < places.size(); ++placement) {
    const auto& all = embree.edges(embree.placed(placement).mesh);
    for (std::uint32_t i = 0; i < all.size(); ++i) {
      const std::uint64_t edge = std::uint64_t{placement} << 32U | i;
      const auto [from, to] = embree.edgeEnds(edge);
      if (std::abs((from.y() + to.y()) / 2 - places[placement]) < 1e-6 && std::abs(to.z() - from.z()) > 1)
        edges.edge[edges.count++] = edge;
    }
  }
  std::vector<SubRay> result(kMostStrips);
  result.resize(static_cast<std::size_t>(drawStrips(embree, instrument, kBeam, edges, kMiddle, result.data())));
  return result;
}

// Of a Gaussian beam's power, beyond x/w and in the mean of it, by the trapezoidal rule.
struct Part {
  double share = 0, mean = 0;
};
Part between(double from, double to) {
  Part part;
  constexpr int kSteps = 20000;
  for (int i = 0; i < kSteps; ++i) {
    const double x = from + (to - from) * (i + 0.5) / kSteps;
    const double density = std::sqrt(2 / std::numbers::pi) * std::exp(-2 * x * x) * (to - from) / kSteps;
    part.share += density, part.mean += x * density;
  }
  part.mean /= part.share;
  return part;
}

TEST(BeamStrips, HaveTheirShareOfAGaussianBeamAndItsMeanPlace) {
  const Instrument instrument = testing::instrument("leica-rtc360");
  const double radius = beamRadius(instrument, kRange);
  for (const std::vector<double>& offs :
       {std::vector<double>{0.3}, {-1.2}, {0.0}, {-0.5, 0.5}, {0.1, 0.2, 1.4}, {-1.4, -0.7, 0, 0.6}}) {
    std::vector<double> places;
    for (const double off : offs) places.push_back(off * radius);
    auto strips = stripsBetween(places);
    ASSERT_EQ(strips.size(), offs.size() + 1);
    // As the place where the ray passes at that range: the pattern turns on the way.
    const auto aside = [&](const SubRay& ray) {
      const RayLine line = lineOf(kBeam, ray.across, ray.upward, instrument);
      const Eigen::Vector3d place = line.origin + kRange * line.direction;
      EXPECT_NEAR(place.z(), 0, 1e-6);
      return place.y() / radius;
    };
    std::sort(strips.begin(), strips.end(), [&](const SubRay& a, const SubRay& b) { return aside(a) < aside(b); });
    for (std::size_t i = 0; i < strips.size(); ++i) {
      const Part part = between(i == 0 ? -5 : offs[i - 1], i == offs.size() ? 5 : offs[i]);
      EXPECT_NEAR(strips[i].weight, part.share, 2e-6) << i;
      EXPECT_NEAR(aside(strips[i]), part.mean, 2e-4) << i;
    }
  }
}

TEST(BeamStrips, TakeEdgesOfOneLineForOneAndFarOnesForNone) {
  const double radius = beamRadius(testing::instrument("leica-rtc360"), kRange);
  EXPECT_EQ(stripsBetween({0.3 * radius, 0.301 * radius}).size(), 2U);
  EXPECT_EQ(stripsBetween({1.6 * radius}).size(), 1U);
  EXPECT_EQ(stripsBetween({0.3 * radius, -1.6 * radius}).size(), 2U);
}

TEST(BeamStrips, AreNoneWhereEdgesEndOrLeanOrRunIntoTheDepth) {
  const double radius = beamRadius(testing::instrument("leica-rtc360"), kRange);
  EXPECT_EQ(stripsBetween({0.3 * radius}, 0, -0.5 * radius).size(), 0U);
  EXPECT_EQ(stripsBetween({0.3 * radius, -0.2 * radius}, 0.1).size(), 0U);
  SceneBuilder scene;
  scene.quad({5, 0.001, -1}, {5, 0, 0}, {0, 0, 1.001});
  const auto rays = scene.build();
  const auto& embree = dynamic_cast<const EmbreeScene&>(*rays);
  SubRay drawn[kMostStrips];
  for (std::uint32_t i = 0; i < 4; ++i) {
    const auto [from, to] = embree.edgeEnds(i);
    BeamEdges edges;
    edges.edge[edges.count++] = i;
    if (std::abs(from.x() - to.x()) > 1)
      EXPECT_EQ(drawStrips(embree, testing::instrument("leica-rtc360"), kBeam, edges, kMiddle, drawn), 0);
  }
}

}  // namespace
}  // namespace standpoint
