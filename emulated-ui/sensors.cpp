// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/sensors.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/random.h"
#include "core/units.h"
#include "survey/stations/levelling.h"

namespace standpoint {

namespace {

enum Channel : std::uint32_t { kCompass = 701, kAltimeter, kGps };

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// Where the plumb line through the origin meets the triangle, it is above it.
bool isAbove(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double u = cross(b.head<2>(), c.head<2>()), v = cross(c.head<2>(), a.head<2>()),
               w = cross(a.head<2>(), b.head<2>());
  const bool inside = (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
  const double area = u + v + w;
  return inside && area != 0 && (u * a.z() + v * b.z() + w * c.z()) / area > 0;
}

std::string compassText(double azimuth_deg, double sigma) {
  return fmt::format("{:.1f}° ± {:g}°", azimuth_deg - 360 * std::floor(azimuth_deg / 360), sigma);
}

}  // namespace

// Each corner is moved once, and what does not reach over the place is left out as a whole.
bool isUnderARoof(const Environment& environment, const Eigen::Vector3d& place) {
  std::vector<Eigen::Vector3d> corners;
  for (const auto& instance : environment.instances) {
    if (!environment.products[instance.product].inScene()) continue;
    const auto& mesh = *environment.meshes[instance.mesh];
    const Eigen::Affine3d from_mesh = Eigen::Translation3d(-place) * instance.world_from_mesh;
    Eigen::AlignedBox3d box;
    corners.clear();
    for (const auto& p : mesh.positions) {
      corners.emplace_back(from_mesh * p.cast<double>());
      box.extend(corners.back());
    }
    if (corners.empty() || box.max().z() <= 0) continue;
    if ((box.min().head<2>().array() > 0).any() || (box.max().head<2>().array() < 0).any()) continue;
    for (const auto& t : mesh.triangles)
      if (isAbove(corners[t[0]], corners[t[1]], corners[t[2]])) return true;
  }
  return false;
}

SettingValues sensorReadings(const Document& document, const Station& station, const std::vector<SensorRow>& sensors,
                             const std::vector<std::string>& on, std::uint64_t seed, int number) {
  SettingValues readings;
  const Eigen::Vector3d shift = document.georeference ? document.georeference->shift_m : Eigen::Vector3d::Zero();
  const Eigen::Vector3d place = station.true_pose.translation + shift;
  const RandomKey key{seed, static_cast<std::uint32_t>(stableHash(station.name.c_str()))};
  const auto drawn = [&](Channel channel) {
    return normals(philox(key, static_cast<std::uint32_t>(number), 0, channel));
  };
  for (const auto& sensor : sensors) {
    if (std::find(on.begin(), on.end(), sensor.id) == on.end()) continue;
    if (sensor.id == "compass") {
      const double azimuth = 90 - yawOf(station.true_pose.rotation) / kRadPerDeg;
      readings.emplace_back("compass", compassText(azimuth + sensor.sigma * drawn(kCompass)[0], sensor.sigma));
    } else if (sensor.id == "altimeter") {
      readings.emplace_back(
          "altimeter", fmt::format("{:.1f} m ± {:g} m", place.z() + sensor.sigma * drawn(kAltimeter)[0], sensor.sigma));
    } else if (document.environment() && isUnderARoof(*document.environment(), station.true_pose.translation)) {
      readings.emplace_back("gps", "–");
    } else {
      const auto e = drawn(kGps);
      readings.emplace_back(
          "gps", fmt::format("{:.0f} {:.0f} {:.0f} m ± {:g} m", place.x() + sensor.sigma * e[0],
                             place.y() + sensor.sigma * e[1], place.z() + sensor.sigma * e[2], sensor.sigma));
    }
  }
  return readings;
}

}  // namespace standpoint
