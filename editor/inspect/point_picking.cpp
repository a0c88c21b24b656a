// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/inspect/point_picking.h"

#include <cmath>
#include <limits>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "core/decompositions.h"

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

std::optional<Eigen::Vector3d> normalAround(const PointPlaces& places, const Eigen::Vector3d& place, double radius_m) {
  constexpr std::size_t kFewest = 10;
  constexpr double kStray = 0.05, kBroad = 0.15;  // as parts of the radius
  struct Sums {
    std::size_t count = 0;
    Eigen::Vector3d first = Eigen::Vector3d::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  };
  const auto sums = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, places.count, 1 << 15), Sums{},
      [&](const auto& range, Sums so_far) {
        for (auto i = range.begin(); i < range.end(); ++i) {
          const float* p = places.first + i * places.stride;
          const Eigen::Vector3d d = Eigen::Vector3d(p[0], p[1], p[2]) - place;
          if (d.squaredNorm() > radius_m * radius_m) continue;
          ++so_far.count;
          so_far.first += d;
          so_far.second += d * d.transpose();
        }
        return so_far;
      },
      [](const Sums& a, const Sums& b) {
        return Sums{a.count + b.count, a.first + b.first, a.second + b.second};
      });
  if (sums.count < kFewest) return std::nullopt;
  const auto n = static_cast<double>(sums.count);
  const Eigen::Vector3d mean = sums.first / n;
  const auto [values, axes] = principalAxes(sums.second / n - mean * mean.transpose());
  if (std::sqrt(std::max(0.0, values[0])) > kStray * radius_m) return std::nullopt;
  if (std::sqrt(std::max(0.0, values[1])) < kBroad * radius_m) return std::nullopt;
  return Eigen::Vector3d(axes.col(0));
}

}  // namespace standpoint
