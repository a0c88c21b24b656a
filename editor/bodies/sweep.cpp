// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/bodies/sweep.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace standpoint {

namespace {

constexpr double kWholeTurn = 2 * std::numbers::pi;
constexpr int kBeams = 49;                                  // of a fan
constexpr double kFarthest_m = 25, kInInstrument_m = 0.15;  // of what is drawn of a beam

}  // namespace

SweepShape sweepShapeOf(const InstrumentBody& body, const ScanSettings& settings) {
  const double measured = std::min(kWholeTurn, settings.azimuth_to_rad - settings.azimuth_from_rad);
  const bool all_around = measured > kWholeTurn - 0.01;
  const int fans = all_around ? body.fans : 1;
  return {settings.azimuth_from_rad, measured / fans, fans, settings.elevation_from_rad, settings.elevation_to_rad};
}

double shareAt(const SweepShape& shape, double azimuth_rad) {
  double turned = std::fmod(azimuth_rad - shape.from_rad, kWholeTurn);
  if (turned < 0) turned += kWholeTurn;
  if (shape.fans == 2) turned = std::fmod(turned, kWholeTurn / 2);
  return std::clamp(turned / shape.turn_rad, 0.0, 1.0);
}

std::vector<SweepFan> fansOf(const SweepShape& shape, double share, const StandingInstrument& stands,
                             const RayScene* scene) {
  std::vector<SweepFan> fans;
  for (int i = 0; i < shape.fans; ++i) {
    SweepFan fan{shape.from_rad + share * shape.turn_rad + i * std::numbers::pi, shape.low_rad, shape.high_rad, {}};
    for (int k = 0; k < kBeams; ++k) {
      const double elevation = fan.from_rad + (fan.to_rad - fan.from_rad) * k / (kBeams - 1);
      const Eigen::Vector3d way =
          stands.rotation * Eigen::Vector3d(std::cos(fan.azimuth_rad) * std::cos(elevation),
                                            -std::sin(fan.azimuth_rad) * std::cos(elevation), std::sin(elevation));
      const auto hit =
          scene == nullptr ? std::nullopt : scene->intersect(stands.centre_m + kInInstrument_m * way, way, kFarthest_m);
      fan.ranges_m.push_back(static_cast<float>(hit ? hit->range_m + kInInstrument_m : kFarthest_m));
    }
    fans.push_back(std::move(fan));
  }
  return fans;
}

}  // namespace standpoint
