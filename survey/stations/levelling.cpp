// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/stations/levelling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/random.h"
#include "core/units.h"

namespace standpoint {

namespace {

// No scan draws for a column or row like these, so nothing else shares the numbers.
constexpr std::uint32_t kOfTheStand = 0xFFFFFFFFU;
constexpr std::uint32_t kSettingUp = 0, kCompensator = 1;

RandomKey keyOf(std::uint64_t seed, const std::string& station) {
  return {seed, static_cast<std::uint32_t>(stableHash(station.c_str()))};
}

std::string angleText(double rad) {
  const double arcmin = rad / kRadPerDeg * 60;
  return arcmin < 60 ? fmt::format("{:.3g} arc minutes", arcmin) : fmt::format("{:.3g} degrees", arcmin / 60);
}

}  // namespace

Eigen::Quaterniond rotationOf(double yaw_rad, const Tilt& tilt) {
  Eigen::Quaterniond rotation(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
  if (tilt.angle_rad != 0) {
    const Eigen::Vector3d axis(-std::sin(tilt.towards_rad), std::cos(tilt.towards_rad),
                               0);  // Z turns about it towards there
    rotation = Eigen::Quaterniond(Eigen::AngleAxisd(tilt.angle_rad, axis)) * rotation;
  }
  if (rotation.w() < 0) rotation.coeffs() *= -1;
  return rotation;
}

double yawOf(const Eigen::Quaterniond& rotation) { return 2 * std::atan2(rotation.z(), rotation.w()); }

Tilt tiltOf(const Eigen::Quaterniond& rotation) {
  const Eigen::Vector3d axis = rotation * Eigen::Vector3d::UnitZ();
  const double aside = std::hypot(axis.x(), axis.y());
  return {std::atan2(aside, axis.z()), aside > 0 ? std::atan2(axis.y(), axis.x()) : 0};
}

Tilt drawnTilt(double max_rad, std::uint64_t seed, const std::string& station) {
  const auto block = philox(keyOf(seed, station), kOfTheStand, kOfTheStand, kSettingUp);
  return {max_rad * std::sqrt(uniform(block[0])), 2 * std::numbers::pi * uniform(block[1])};
}

Result<Pose> believedPose(const Station& station, const Instrument& instrument, const Levelling& levelling,
                          Report& report) {
  Pose pose = station.true_pose;
  const Tilt tilt = tiltOf(pose.rotation);
  if (tilt.angle_rad == 0) return pose;
  const double yaw = yawOf(pose.rotation);
  if (!levelling.compensator || !instrument.compensator) {
    report.warn(station.name,
                fmt::format("the station is {} out of level and {}: points stay tilted", angleText(tilt.angle_rad),
                            instrument.compensator ? "the compensator is off" : "the instrument has no compensator"));
    pose.rotation = rotationOf(yaw, {});
    return pose;
  }
  const auto& compensator = *instrument.compensator;
  const double limit_rad = std::max(compensator.range_rad, compensator.reduced_range_rad);
  if (compensator.range_rad > 0 && tilt.angle_rad > limit_rad)
    return failure(ErrorKind::unusable, fmt::format("station {} is {} out of level; the compensator of the {} {} works "
                                                    "up to {}; level the station or turn the compensator off",
                                                    station.name, angleText(tilt.angle_rad), instrument.maker,
                                                    instrument.model, angleText(limit_rad)));
  if (levelling.exact) return pose;
  const double accuracy_rad = tilt.angle_rad > compensator.range_rad && compensator.reduced_range_rad > 0
                                  ? compensator.reduced_accuracy_rad
                                  : compensator.accuracy_rad;
  const auto drawn = normals(philox(keyOf(levelling.seed, station.name), kOfTheStand, kOfTheStand, kCompensator));
  const double x = tilt.angle_rad * std::cos(tilt.towards_rad) + accuracy_rad * drawn[0];
  const double y = tilt.angle_rad * std::sin(tilt.towards_rad) + accuracy_rad * drawn[1];
  pose.rotation = rotationOf(yaw, {std::hypot(x, y), std::atan2(y, x)});
  return pose;
}

}  // namespace standpoint
