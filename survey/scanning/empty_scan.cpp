// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/scanning/empty_scan.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "survey/scene/bodies.h"

namespace standpoint {

std::string whyNothing(const RayScene& scene, const Pose& local_from_scanner, const Instrument& instrument,
                       const ScanSettings& settings) {
  constexpr int kTriedColumns = 180, kTriedRows = 90;
  constexpr double kFar_m = 1e6;
  int met = 0, too_near = 0, too_far = 0;
  double nearest = kFar_m;
  for (int j = 0; j < kTriedColumns; ++j)
    for (int i = 0; i < kTriedRows; ++i) {
      const double azimuth =
          settings.azimuth_from_rad + (settings.azimuth_to_rad - settings.azimuth_from_rad) * (j + 0.5) / kTriedColumns;
      const double elevation = settings.elevation_from_rad +
                               (settings.elevation_to_rad - settings.elevation_from_rad) * (i + 0.5) / kTriedRows;
      const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth), -std::cos(elevation) * std::sin(azimuth),
                                      std::sin(elevation));
      const auto hit = scene.intersect(local_from_scanner.translation, local_from_scanner.rotation * direction, kFar_m);
      if (!hit) continue;
      ++met;
      nearest = std::min(nearest, hit->range_m);
      too_near += static_cast<int>(hit->range_m < instrument.min_range_m);
      too_far += static_cast<int>(hit->range_m > settings.max_range_m);
    }
  if (sceneTriangleCount(scene.environment()) == 0)
    return "the scan is empty: the scene contains no products; import a model, or include products again";
  if (const double away = distanceTo(bounds(scene.environment()), local_from_scanner.translation);
      away > settings.max_range_m) {
    too_far = met;  // and where the model is small from there, no beam of this look round need have met it
    nearest = std::min(nearest, away);
  } else if (met == 0) {
    return "the scan is empty: no beam hits the model; move the station or widen the field of view";
  }
  if (met > 0 && too_near == met)
    return fmt::format(
        "the scan is empty: all surfaces hit are closer than {:.2f} m, the minimum range of the {} {}; move the "
        "station",
        instrument.min_range_m, instrument.maker, instrument.model);
  if (too_far == met)
    return fmt::format(
        "the scan is empty: the nearest surface is {:.0f} m away, but the maximum range of the {} {} is {:.0f} m with "
        "these settings; move the station closer",
        nearest, instrument.maker, instrument.model, settings.max_range_m);
  return fmt::format(
      "the scan is empty: beams hit surfaces from {:.2f} m on, but the returns are too weak to detect; check "
      "materials, weather and range mode",
      nearest);
}

}  // namespace standpoint
