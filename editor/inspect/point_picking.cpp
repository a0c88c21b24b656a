// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/inspect/point_picking.h"

#include <limits>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

namespace standpoint {

std::optional<std::size_t> firstPoint(const PointPlaces& places, const SightCone& cone,
                                      const std::function<bool(const Eigen::Vector3d&)>& counts) {
  // The least distance wins, of equal ones the lower index: the same for any split.
  using Best = std::pair<double, std::size_t>;
  constexpr Best kNoPointYet{std::numeric_limits<double>::infinity(), std::numeric_limits<std::size_t>::max()};
  const auto best = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, places.count, 1 << 15), kNoPointYet,
      [&](const auto& range, Best found) {
        for (auto i = range.begin(); i < range.end(); ++i) {
          const float* p = places.first + i * places.stride;
          const Eigen::Vector3d d = Eigen::Vector3d(p[0], p[1], p[2]) - cone.origin;
          const double along = d.dot(cone.direction);
          if (along <= 0 || along >= found.first) continue;
          const double reach = cone.radius_m + cone.per_metre * along;
          if (d.squaredNorm() - along * along > reach * reach) continue;
          if (!counts || counts(cone.origin + d)) found = {along, i};
        }
        return found;
      },
      [](const Best& a, const Best& b) { return std::min(a, b); });
  if (best.second == kNoPointYet.second) return std::nullopt;
  return best.second;
}

}  // namespace standpoint
