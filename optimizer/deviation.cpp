// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/deviation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();

double areaOf(std::span<const Vector3d> positions, const Triangle& t) {
  return 0.5 * (positions[t[1]] - positions[t[0]]).cross(positions[t[2]] - positions[t[0]]).norm();
}

struct OneWay {
  double max_squared = 0, sum = 0;
  std::uint32_t count = 0;
  void add(double squared) {
    max_squared = std::max(max_squared, squared);
    sum += std::sqrt(squared);
    ++count;
  }
  double mean() const { return count > 0 ? sum / count : 0; }
};

double squaredDistance(const Vector3d& p, const Shape& s, std::uint32_t triangle) {
  const auto& t = s.triangles[triangle];
  return (closestPoint(p, s.positions[t[0]], s.positions[t[1]], s.positions[t[2]]) - p).squaredNorm();
}

OneWay oneWay(const Shape& from, const std::vector<SurfacePoint>& points, const Shape& to, const TriangleTree& tree,
              const std::vector<std::uint32_t>& counterpart, bool vertices) {
  OneWay result;
  const auto nearest = [&](std::uint32_t triangle, const Vector3d& p) {
    const auto hint = triangle < counterpart.size() ? counterpart[triangle] : kNone;
    return tree.squaredDistance(p, hint != kNone ? squaredDistance(p, to, hint) : std::numeric_limits<double>::infinity());
  };
  for (const auto& point : points) result.add(nearest(point.triangle, point.position));
  if (!vertices) return result;
  std::vector<bool> seen(from.positions.size(), false);
  for (std::uint32_t i = 0; i < from.triangles.size(); ++i) {
    // Between its corners a long triangle may bulge away from the other surface: its middle and its edges' middles, too.
    const auto& t = from.triangles[i];
    const Vector3d &a = from.positions[t[0]], &b = from.positions[t[1]], &c = from.positions[t[2]];
    for (const Vector3d& p : {Vector3d((a + b + c) / 3), Vector3d((a + b) / 2), Vector3d((b + c) / 2), Vector3d((c + a) / 2)})
      result.max_squared = std::max(result.max_squared, nearest(i, p));
    for (const auto v : t) {
      if (seen[v]) continue;
      seen[v] = true;
      result.max_squared = std::max(result.max_squared, nearest(i, from.positions[v]));
    }
  }
  return result;
}

Deviation deviationOfDropped(const Shape& shape, const std::vector<SurfacePoint>& points) {
  OneWay way;
  for (const auto& point : points) way.add(point.position.squaredNorm());
  for (const auto& t : shape.triangles)
    for (const auto v : t) way.max_squared = std::max(way.max_squared, shape.positions[v].squaredNorm());
  return {.max_m = std::sqrt(way.max_squared), .mean_m = way.mean()};
}

}  // namespace

std::vector<SurfacePoint> pointsByArea(std::span<const Vector3d> positions, std::span<const Triangle> triangles, std::uint32_t count,
                                       const RandomKey& key) {
  std::vector<SurfacePoint> points;
  double total = 0;
  for (const auto& t : triangles) total += areaOf(positions, t);
  if (!(total > 0)) return points;
  points.reserve(count);
  double walked = 0;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const auto& t = triangles[i];
    walked += areaOf(positions, t);
    while (points.size() < count && (static_cast<double>(points.size()) + 0.5) * total <= walked * count) {
      const auto block = philox(key, static_cast<std::uint32_t>(points.size()), 0, 0);
      const double r = std::sqrt(uniform(block[0])), s = uniform(block[1]);
      points.push_back({i, (1 - r) * positions[t[0]] + r * (1 - s) * positions[t[1]] + r * s * positions[t[2]]});
    }
  }
  return points;
}

DeviationMeter::DeviationMeter(const Shape& before, std::uint32_t samples, std::uint64_t seed)
    : before_(before), samples_(samples), seed_(seed), tree_(before.positions, before.triangles),
      points_(pointsByArea(before.positions, before.triangles, samples, {seed, 0})) {
  for (const auto& t : before.triangles) area_m2_ += areaOf(before.positions, t);
}

Deviation DeviationMeter::of(const Shape& after, const std::vector<std::uint32_t>& image) const { return measure(after, image, true); }

Deviation DeviationMeter::measure(const Shape& after, const std::vector<std::uint32_t>& image, bool vertices) const {
  Deviation result;
  if (before_.triangles.empty()) return result;
  if (after.triangles.empty()) {
    result = deviationOfDropped(before_, points_);
  } else {
    std::vector<std::uint32_t> origin(after.triangles.size(), kNone);
    for (std::uint32_t i = 0; i < image.size(); ++i)
      if (image[i] != kNone) origin[image[i]] = i;
    const TriangleTree tree(after.positions, after.triangles);
    const OneWay there = oneWay(before_, points_, after, tree, image, vertices);
    const OneWay back = oneWay(after, pointsByArea(after.positions, after.triangles, samples_, {seed_, 1}), before_, tree_, origin, vertices);
    result.max_m = std::sqrt(std::max(there.max_squared, back.max_squared));
    result.mean_m = 0.5 * (there.mean() + back.mean());
  }
  result.area_m2 = area_m2_;
  return result;
}

}  // namespace standpoint
