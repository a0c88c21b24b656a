// SPDX-License-Identifier: GPL-3.0-or-later
// physics.md §4.14: in a concave corner a phase-shift instrument sees light that came by way of the other wall,
//   x_b / x = ρ ∫ cos α cos β cos γ / (π d²) dQ / cos θ,  the range too long by Δ = r / (1 + r) ē,
// r = x_b / x and ē the mean of (d + R_Q - R_P) / 2, over the field of view.
#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "core/units.h"
#include "tests/scanners/scenes.h"

namespace standpoint {
namespace {

using namespace testing;

constexpr double kFar_m = 10;

// Two walls at right angles, whose corner is straight ahead; their far ends are nearer.
SceneBuilder corner(bool concave = true) {
  SceneBuilder scene;
  const double back = concave ? -1 : 1;
  scene.quad({kFar_m, 0, -2}, Eigen::Vector3d(back, 1, 0), {0, 0, 4});
  scene.quad(Eigen::Vector3d(kFar_m + back, -1, -2), Eigen::Vector3d(-back, 1, 0), {0, 0, 4});
  return scene;
}

struct Bounce {
  double ratio = 0, bias_m = 0;
};

// By two million places of the field of view instead of sixteen, all in plane geometry of its own.
Bounce expected(double azimuth_rad, double field_rad, double reflectance) {
  using Eigen::Vector3d;
  const Vector3d normal[2] = {Vector3d(-1, -1, 0).normalized(), Vector3d(-1, 1, 0).normalized()};  // of y > 0 and y < 0
  const auto rangeOf = [&](const Vector3d& direction, int wall) {
    return normal[wall].x() * kFar_m / normal[wall].dot(direction);
  };
  const Vector3d axis(std::cos(azimuth_rad), -std::sin(azimuth_rad), 0), across(axis.y(), -axis.x(), 0);
  const int own = axis.y() > 0 ? 0 : 1;
  const double range = rangeOf(axis, own), cosine = -normal[own].dot(axis);
  const Vector3d place = range * axis;
  constexpr int kRings = 700, kSpokes = 700;
  double sum = 0, moment = 0;
  for (int i = 0; i < kRings; ++i)
    for (int k = 0; k < kSpokes; ++k) {
      const double radius = field_rad / 2 * (i + 0.5) / kRings, turn = 2 * std::numbers::pi * (k + 0.5) / kSpokes;
      const double solid = radius * (field_rad / 2 / kRings) * (2 * std::numbers::pi / kSpokes);
      const Vector3d direction =
          (axis + radius * (std::cos(turn) * across + std::sin(turn) * Vector3d::UnitZ())).normalized();
      const int wall = direction.y() > 0 ? 0 : 1;
      if (wall == own) continue;
      const double there = rangeOf(direction, wall);
      const Vector3d way = there * direction - place;
      const double square = way.squaredNorm(), length = std::sqrt(square);
      const double leaving = normal[own].dot(way) / length, arriving = -normal[wall].dot(way) / length;
      const double share =
          reflectance * leaving * arriving * there * there * solid / (std::numbers::pi * square * cosine);
      sum += share, moment += share * (length + there - range) / 2;
    }
  return {sum, sum > 0 ? moment / (1 + sum) : 0};
}

// By columns: the mean of what ranges and powers are over those without the effect.
std::vector<Bounce> measured(const SceneBuilder& scene, const Instrument& instrument, const ScanSettings& settings,
                             double reflectance, Effects effects) {
  const auto rays = scene.build();
  const auto assignment = allOf(*scene.environment(), reflectance);
  ScanOptions options;
  options.channels.truth = true;
  options.effects = effects;
  const auto lit = scanned(*rays, assignment, instrument, settings, options).points;
  options.effects = effects.without(Effect::multipath);
  const auto plain = scanned(*rays, assignment, instrument, settings, options).points;
  EXPECT_EQ(lit.size(), plain.size());
  std::vector<Bounce> columns(settings.columns);
  const auto range = [](const PointBlock& p, std::size_t i) {
    return Eigen::Vector3d(p.x_m[i], p.y_m[i], p.z_m[i]).norm();
  };
  for (std::size_t i = 0; i < std::min(lit.size(), plain.size()); ++i) {
    auto& column = columns[lit.column[i]];
    column.bias_m += (range(lit, i) - range(plain, i)) / settings.rows;
    column.ratio +=
        (std::pow(10, static_cast<double>(lit.truth.received_db[i] - plain.truth.received_db[i]) / 10) - 1) /
        settings.rows;
  }
  return columns;
}

const Effects kMultipath = Effects::none().with(Effect::multipath);

ScanSettings acrossTheCorner(const Instrument& instrument) { return window(instrument, -0.2, 0.2, -0.4, 0.4, 32, 400); }

double azimuthOf(const ScanSettings& settings, std::size_t column) {
  return settings.azimuth_from_rad +
         static_cast<double>(column) * (settings.azimuth_to_rad - settings.azimuth_from_rad) / settings.columns;
}

TEST(CornerLight, MakesRangesTooLongByTheIntegralOverTheFieldOfView) {
  const auto s350 = testing::instrument("faro-focus-s350");
  const double field = s350.waveform.field_of_view_rad;
  ASSERT_GT(field, 0.001);
  const auto settings = acrossTheCorner(s350);
  const auto columns = measured(corner(), s350, settings, 0.8, kMultipath);
  double highest = 0;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const double azimuth = azimuthOf(settings, c), beside_m = kFar_m * std::abs(azimuth);
    if (beside_m < 0.003) continue;  // nearer than the rays lie side by side
    const auto integral = expected(azimuth, field, 0.8);
    EXPECT_NEAR(columns[c].bias_m, integral.bias_m, 1e-5 + 0.08 * integral.bias_m) << beside_m;
    EXPECT_NEAR(columns[c].ratio, integral.ratio, 0.002 + 0.1 * integral.ratio) << beside_m;
    highest = std::max(highest, columns[c].bias_m);
  }
  EXPECT_GT(highest, 0.0002);
  EXPECT_LT(highest, 0.002);
}

TEST(CornerLight, RoundsTheCornerAndLeavesTheWallsAlone) {
  const auto s350 = testing::instrument("faro-focus-s350");
  const auto settings = acrossTheCorner(s350);
  const auto columns = measured(corner(), s350, settings, 0.8, kMultipath);
  EXPECT_NEAR(columns.front().bias_m, 0, 1e-6);  // 35 mm beside it, out of sight
  EXPECT_NEAR(columns.back().bias_m, 0, 1e-6);
  // Black walls send a tenth as much to each other.
  const auto black = measured(corner(), s350, settings, 0.08, kMultipath);
  for (std::size_t c = 8; c < 24; ++c)
    if (columns[c].ratio > 0.02) {
      EXPECT_NEAR(black[c].ratio / columns[c].ratio, 0.1, 0.001) << c;
    }
}

TEST(CornerLight, IsOfConcaveCornersAndPhaseShiftOnly) {
  const auto s350 = testing::instrument("faro-focus-s350");
  for (const auto& column : measured(corner(false), s350, acrossTheCorner(s350), 0.8, kMultipath))
    EXPECT_NEAR(column.bias_m, 0, 1e-6);
  const auto rtc = testing::instrument("leica-rtc360");
  for (const auto& column : measured(corner(), rtc, acrossTheCorner(rtc), 0.8, kMultipath)) EXPECT_EQ(column.bias_m, 0);
}

// A room is one mesh, a box on its floor another: both corners are found, the edge that faces the scanner is none.
TEST(CornerLight, FindsCornersWithinAMeshAndBetweenMeshes) {
  SceneBuilder scene;
  scene.box({-5, -5, -1.5}, {5, 5, 1.5}, true);
  scene.box({3, -1, -1.5}, {4, 1, 0.5}, false);
  const auto s350 = testing::instrument("faro-focus-s350");
  const auto biasOfRows = [&](double azimuth, double from, double to) {
    const auto settings = window(s350, azimuth, azimuth + 2, from, to, 200, 8);
    double highest = 0;
    for (const auto& column : measured(scene, s350, settings, 0.8, kMultipath))
      highest = std::max(highest, column.bias_m);
    return highest;
  };
  const auto degrees = [](double up, double along) { return std::atan2(up, along) / kRadPerDeg; };
  EXPECT_GT(biasOfRows(0, degrees(-1.5, 3) - 0.1, degrees(-1.5, 3) + 0.1), 2e-5);     // the box on the floor
  EXPECT_GT(biasOfRows(180, degrees(-1.5, 5) - 0.1, degrees(-1.5, 5) + 0.1), 2e-5);   // wall and floor
  EXPECT_NEAR(biasOfRows(0, degrees(0.5, 3) - 0.1, degrees(0.5, 3) + 0.1), 0, 1e-6);  // the upper edge of the box
}

}  // namespace
}  // namespace standpoint
