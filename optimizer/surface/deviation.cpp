// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/surface/deviation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "optimizer/surface/farthest.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();

constexpr std::size_t kChunk = 2048;  // points or triangles that one task looks at

std::vector<double> areasOf(std::span<const Vector3d> positions, std::span<const Triangle> triangles) {
  std::vector<double> areas(triangles.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, areas.size(), kChunk), [&](const auto& range) {
    for (auto i = range.begin(); i < range.end(); ++i) {
      const auto& t = triangles[i];
      areas[i] = 0.5 * (positions[t[1]] - positions[t[0]]).cross(positions[t[2]] - positions[t[0]]).norm();
    }
  });
  return areas;
}

struct OneWay {
  double max_squared = 0, sum = 0, turn = 0;
  std::size_t count = 0;
  double mean() const { return count > 0 ? sum / static_cast<double>(count) : 0; }
  double meanTurn() const { return count > 0 ? turn / static_cast<double>(count) : 0; }
  void operator+=(const OneWay& o) {
    max_squared = std::max(max_squared, o.max_squared);
    sum += o.sum;
    turn += o.turn;
    count += o.count;
  }
};

Vector3d normalOf(const Shape& s, std::uint32_t triangle) {
  const auto& t = s.triangles[triangle];
  return (s.positions[t[1]] - s.positions[t[0]]).cross(s.positions[t[2]] - s.positions[t[0]]);
}

// Between lines: which side of a thin sheet is the nearer one is chance.
double angleBetween(const Vector3d& a, const Vector3d& b) { return std::atan2(a.cross(b).norm(), std::abs(a.dot(b))); }

// task(first, last) for chunks of [0, count) side by side; the results added in order.
template <class Task>
OneWay inChunks(std::size_t count, Task task) {
  std::vector<OneWay> parts((count + kChunk - 1) / kChunk);
  tbb::parallel_for(std::size_t{0}, parts.size(),
                    [&](std::size_t i) { parts[i] = task(i * kChunk, std::min(count, (i + 1) * kChunk)); });
  OneWay all;
  for (const auto& part : parts) all += part;
  return all;
}

// Each stride-th of them.
OneWay ofPoints(const OneWaySurfaces& way, const std::vector<SurfacePoint>& points, std::size_t stride) {
  return inChunks((points.size() + stride - 1) / stride, [&](std::size_t first, std::size_t last) {
    OneWay part;
    std::uint32_t lately = kNone;  // what was nearest to the point before
    for (auto i = first; i < last; ++i) {
      const auto& point = points[i * stride];
      const auto own = point.triangle < way.counterpart.size() ? way.counterpart[point.triangle] : kNone;
      TriangleTree::Near near;
      for (const auto known : {own, lately}) {
        if (known == kNone) continue;
        if (const double squared = way.squaredDistance(point.position, known); squared < near.squared)
          near = {squared, known};
      }
      const auto better = way.tree.nearestTriangle(point.position, near.squared);
      if (better.triangle != kNone) near = better;
      lately = near.triangle;
      part.max_squared = std::max(part.max_squared, near.squared);
      part.sum += std::sqrt(near.squared);
      part.turn += near.triangle == kNone
                       ? 0
                       : angleBetween(normalOf(way.from, point.triangle), normalOf(way.to, near.triangle));
      ++part.count;
    }
    return part;
  });
}

// For triangles of what came of it one that it was.
std::vector<std::uint32_t> inverseOf(const std::vector<std::uint32_t>& image, std::size_t count) {
  std::vector<std::uint32_t> origin(count, kNone);
  for (std::uint32_t i = 0; i < image.size(); ++i)
    if (image[i] != kNone) origin[image[i]] = i;
  return origin;
}

std::vector<SurfacePoint> spread(std::span<const Vector3d> positions, std::span<const Triangle> triangles,
                                 const std::vector<double>& areas, std::uint32_t count, const RandomKey& key) {
  std::vector<SurfacePoint> points;
  const double total = std::accumulate(areas.begin(), areas.end(), 0.0);
  if (!(total > 0)) return points;
  points.reserve(count);
  // A start by chance: with few points on each of many equal instances a fixed one would look at the same triangles of
  // all.
  const double start = uniform(philox(key, std::numeric_limits<std::uint32_t>::max(), 0, 0)[0]);
  double walked = 0;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const auto& t = triangles[i];
    walked += areas[i];
    while (points.size() < count && (static_cast<double>(points.size()) + start) * total <= walked * count) {
      const auto block = philox(key, static_cast<std::uint32_t>(points.size()), 0, 0);
      const double r = std::sqrt(uniform(block[0])), s = uniform(block[1]);
      points.push_back({i, (1 - r) * positions[t[0]] + r * (1 - s) * positions[t[1]] + r * s * positions[t[2]]});
    }
  }
  return points;
}

Deviation deviationOfDropped(const Shape& shape, const std::vector<SurfacePoint>& points) {
  OneWay way;
  for (const auto& point : points) way += {point.position.squaredNorm(), point.position.norm(), 0, 1};
  for (const auto& t : shape.triangles)
    for (const auto v : t) way.max_squared = std::max(way.max_squared, shape.positions[v].squaredNorm());
  return {.max_m = std::sqrt(way.max_squared), .mean_m = way.mean()};
}

}  // namespace

std::vector<SurfacePoint> pointsByArea(std::span<const Vector3d> positions, std::span<const Triangle> triangles,
                                       std::uint32_t count, const RandomKey& key) {
  return spread(positions, triangles, areasOf(positions, triangles), count, key);
}

DeviationMeter::DeviationMeter(const Shape& before, const TriangleTree& tree, std::uint32_t samples, std::uint64_t seed)
    : before_(before), samples_(samples), seed_(seed), tree_(tree) {
  const auto areas = areasOf(before.positions, before.triangles);
  area_m2_ = std::accumulate(areas.begin(), areas.end(), 0.0);
  points_ = spread(before.positions, before.triangles, areas, samples, {seed, 0});
}

Deviation DeviationMeter::of(const Shape& after, const std::vector<std::uint32_t>& image) const {
  return measure(after, image, samples_, true);
}

Deviation DeviationMeter::ofItself() const { return {.area_m2 = area_m2_}; }

Deviation DeviationMeter::measure(const Shape& after, const std::vector<std::uint32_t>& image, std::uint32_t samples,
                                  bool search) const {
  Deviation result;
  if (before_.triangles.empty()) return result;
  if (after.triangles.empty()) {
    result = deviationOfDropped(before_, points_);
  } else {
    const auto origin = inverseOf(image, after.triangles.size());
    const TriangleTree tree(after.positions, after.triangles);
    const OneWaySurfaces forth{before_, after, tree, image}, back{after, before_, tree_, origin};
    const std::size_t stride = std::max<std::size_t>(1, points_.size() / std::max<std::uint32_t>(samples, 1));
    const OneWay there = ofPoints(forth, points_, stride),
                 here = ofPoints(back, pointsByArea(after.positions, after.triangles, samples, {seed_, 1}), 1);
    double max_squared = std::max(there.max_squared, here.max_squared);
    if (search) max_squared = farthestSquared(forth, farthestSquared(back, max_squared));
    result.max_m = std::sqrt(max_squared);
    result.mean_m = 0.5 * (there.mean() + here.mean());
    result.turn_rad = there.meanTurn();
  }
  result.area_m2 = area_m2_;
  return result;
}

bool DeviationMeter::exceeds(const Shape& after, const std::vector<std::uint32_t>& image, double limit_m) const {
  if (before_.triangles.empty()) return false;
  if (after.triangles.empty()) return deviationOfDropped(before_, points_).max_m > limit_m;
  const auto origin = inverseOf(image, after.triangles.size());
  const TriangleTree tree(after.positions, after.triangles);
  return isAnyFurther({after, before_, tree_, origin}, limit_m * limit_m) ||
         isAnyFurther({before_, after, tree, image}, limit_m * limit_m);
}

}  // namespace standpoint
