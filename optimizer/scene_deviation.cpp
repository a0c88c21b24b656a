// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/scene_deviation.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "optimizer/placed_surfaces.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr std::size_t kMostCorners = 3'000'000;  // that are looked at for the maximum, each way

struct OneWay {
  double max_squared = 0, sum = 0;
  std::size_t count = 0;
};

OneWay oneWay(const PlacedSurfaces& from, const PlacedSurfaces& to, const std::vector<bool>& unchanged, std::uint32_t samples, const Progress& progress) {
  double all = 0;
  for (std::size_t i = 0; i < from.instances(); ++i) all += from.area(i);
  std::vector<std::uint32_t> counts(from.instances(), 0);
  double walked = 0;
  std::uint32_t given = 0;
  for (std::size_t i = 0; i < counts.size() && all > 0; ++i) {
    walked += from.area(i);
    const auto until = static_cast<std::uint32_t>(samples * std::min(1.0, walked / all) + 0.5);
    counts[i] = until - given;
    given = until;
  }
  std::size_t corners = 0;
  for (std::size_t i = 0; i < from.instances(); ++i) corners += unchanged[i] ? 0 : from.corners(i);
  const std::size_t stride = 1 + corners / kMostCorners;
  std::vector<OneWay> parts(from.instances());
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {  // each into its own slot, summed in order below
    if (progress.cancelled()) return;
    if (unchanged[i]) {
      parts[i].count = counts[i];
      return;
    }
    for (const auto& p : from.points(i, counts[i])) {
      const double squared = to.squaredDistance(p);
      if (!std::isfinite(squared)) continue;  // nothing is left at all
      parts[i].max_squared = std::max(parts[i].max_squared, squared);
      parts[i].sum += std::sqrt(squared);
      ++parts[i].count;
    }
    for (std::size_t k = 0; k < from.corners(i); k += stride)
      if (const double squared = to.squaredDistance(from.corner(i, k)); std::isfinite(squared)) parts[i].max_squared = std::max(parts[i].max_squared, squared);
  });
  OneWay result;
  for (const auto& part : parts) {
    result.max_squared = std::max(result.max_squared, part.max_squared);
    result.sum += part.sum;
    result.count += part.count;
  }
  return result;
}

}  // namespace

Deviation sceneDeviation(const Environment& before, const Environment& after, std::uint32_t samples, const Progress& progress) {
  const PlacedSurfaces a(before), b(after);
  const auto unchanged = [&](const Environment& environment) {
    std::vector<bool> result;
    for (const auto& instance : environment.instances) result.push_back(before.meshes[instance.mesh] == after.meshes[instance.mesh]);
    return result;
  };
  const OneWay there = oneWay(a, b, unchanged(before), samples, progress), back = oneWay(b, a, unchanged(after), samples, progress);
  Deviation result;
  result.max_m = std::sqrt(std::max(there.max_squared, back.max_squared));
  const auto mean = [](const OneWay& way) { return way.count > 0 ? way.sum / static_cast<double>(way.count) : 0; };
  result.mean_m = 0.5 * (mean(there) + mean(back));
  for (std::size_t i = 0; i < a.instances(); ++i) result.area_m2 += a.area(i);
  return result;
}

}  // namespace standpoint
