// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/inspect/model_deviation.h"

#include <algorithm>
#include <limits>

#include <tbb/parallel_for.h>

#include "editor/inspect/point_colour.h"

namespace standpoint {

Result<std::vector<float>> ModelDeviation::of(std::span<const CloudPoint> points, const CloudHeader& header,
                                              Progress& progress) const {
  progress.stage("Distances from the model");
  std::vector<float> deviations(points.size(), std::numeric_limits<float>::quiet_NaN());
  if (surface_.empty()) return deviations;
  constexpr std::size_t kPart = 1 << 16;
  for (std::size_t begin = 0; begin < points.size(); begin += kPart) {
    TRY(progress.check());
    progress.advance(static_cast<double>(begin) / static_cast<double>(points.size()));
    const std::size_t end = std::min(points.size(), begin + kPart);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, 256), [&](const auto& range) {
      for (auto i = range.begin(); i < range.end(); ++i) {
        const auto& p = points[i].position_m;
        const Eigen::Vector3d place = header.origin_m + Eigen::Vector3d(p[0], p[1], p[2]) - shift_m_;
        const auto& station = header.stations[points[i].station];
        const Eigen::Vector3d from = station.file_from_scanner.translation - shift_m_;
        const auto touch = surface_.nearest(place, kDeviationReach_m, standsSomewhere(station) ? &from : nullptr);
        if (touch.normal.isZero()) continue;
        const Eigen::Vector3d off = place - touch.position;
        deviations[i] = static_cast<float>(off.dot(touch.normal) < 0 ? -off.norm() : off.norm());
      }
    });
  }
  return deviations;
}

}  // namespace standpoint
