// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/deviation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include "optimizer/triangle_distance.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();

double areaOf(std::span<const Vector3d> positions, const Triangle& t) {
  return 0.5 * (positions[t[1]] - positions[t[0]]).cross(positions[t[2]] - positions[t[0]]).norm();
}

constexpr std::size_t kChunk = 2048;     // points that one task looks at
constexpr int kHalvings = 9;             // of a triangle that is searched for its farthest point
constexpr std::size_t kMostSearched = 200'000;  // triangles of both shapes
constexpr double kSettled = 1.04 * 1.04; // a piece that can only be 4 % further than what was found is not searched
constexpr double kTooSmall = 0.25;       // nor one whose longest edge is half of that; its corners were looked at

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

double squaredDistance(const Vector3d& p, const Shape& s, std::uint32_t triangle) {
  const auto& t = s.triangles[triangle];
  return (closestPoint(p, s.positions[t[0]], s.positions[t[1]], s.positions[t[2]]) - p).squaredNorm();
}

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
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) { parts[i] = task(i * kChunk, std::min(count, (i + 1) * kChunk)); });
  OneWay all;
  for (const auto& part : parts) all += part;
  return all;
}

// One direction of a measurement.
class Way {
 public:
  Way(const Shape& from, const Shape& to, const TriangleTree& tree, const std::vector<std::uint32_t>& counterpart)
      : from_(from), to_(to), tree_(tree), counterpart_(counterpart) {}

  // Each stride-th of them.
  OneWay ofPoints(const std::vector<SurfacePoint>& points, std::size_t stride) const {
    return inChunks((points.size() + stride - 1) / stride, [&](std::size_t first, std::size_t last) {
      OneWay part;
      std::uint32_t lately = kNone;  // what was nearest to the point before
      for (auto i = first; i < last; ++i) {
        const auto& point = points[i * stride];
        auto near = hint(point.triangle, point.position);
        if (lately != kNone)
          if (const double squared = squaredDistance(point.position, to_, lately); squared < near.squared) near = {squared, lately};
        const auto better = tree_.nearestTriangle(point.position, near.squared);
        if (better.triangle != kNone) near = better;
        lately = near.triangle;
        part.max_squared = std::max(part.max_squared, near.squared);
        part.sum += std::sqrt(near.squared);
        part.turn += near.triangle == kNone ? 0 : angleBetween(normalOf(from_, point.triangle), normalOf(to_, near.triangle));
        ++part.count;
      }
      return part;
    });
  }

  // The largest squared distance of any point of the surface, at most 4 % below the truth but for pieces that are still in doubt when a triangle
  // was halved nine times; or `known`, if none is further. Of dense meshes only vertices and middles of faces and edges are looked at.
  double farthest(double known) const {
    const bool dense = from_.triangles.size() + to_.triangles.size() > kMostSearched;
    // Of the finer one most triangles are settled as a whole, so that sorting its edges would cost more than it saves.
    std::vector<std::uint8_t> fresh(from_.triangles.size(), 63);
    if (dense && from_.triangles.size() < to_.triangles.size()) fresh = freshPoints();
    return inChunks(from_.triangles.size(), [&](std::size_t first, std::size_t last) {
      OneWay part{known};
      std::uint32_t lately = kNone;  // what was near enough for the piece before
      Corner corner_before[3];
      for (auto i = static_cast<std::uint32_t>(first); i < last; ++i) {
        const auto& t = from_.triangles[i];
        const auto own = i < counterpart_.size() ? counterpart_[i] : kNone;
        const Corners corners{from_.positions[t[0]], from_.positions[t[1]], from_.positions[t[2]]};
        if (lately != kNone && answers(lately, t, corner_before, part.max_squared)) continue;
        if (own != kNone && own != lately && answers(own, t, corner_before, part.max_squared)) lately = own;
        else if (dense) lookAtMiddles(corners, fresh[i], lately, part.max_squared);
        else search(corners, kHalvings, lately, part.max_squared);
      }
      return part;
    }).max_squared;
  }

 private:
  TriangleTree::Near hint(std::uint32_t triangle, const Vector3d& p) const {
    const auto other = triangle < counterpart_.size() ? counterpart_[triangle] : kNone;
    return other != kNone ? TriangleTree::Near{squaredDistance(p, to_, other), other} : TriangleTree::Near{};
  }

  // No point of the piece is further from that triangle: the distance from one convex set is greatest at a corner.
  double reach(const Corners& piece, std::uint32_t triangle) const {
    return std::max({squaredDistance(piece[0], to_, triangle), squaredDistance(piece[1], to_, triangle), squaredDistance(piece[2], to_, triangle)});
  }

  // The same of a triangle; it mostly shares two corners with the one that was asked for before.
  struct Corner {
    std::uint32_t vertex = kNone, triangle = kNone;
    double squared = 0;
  };
  bool answers(std::uint32_t triangle, const Triangle& t, Corner (&before)[3], double max_squared) const {
    Corner now[3];
    for (int k = 0; k < 3; ++k) {
      now[k] = {t[k], triangle, -1};
      for (const auto& corner : before)
        if (corner.vertex == t[k] && corner.triangle == triangle) now[k].squared = corner.squared;
    }
    bool near = true;
    for (auto& corner : now) {
      if (corner.squared < 0) corner.squared = squaredDistance(from_.positions[corner.vertex], to_, triangle);
      near = corner.squared <= max_squared;
      if (!near) break;
    }
    if (near) std::copy(now, now + 3, before);
    return near;
  }

  // Branch and bound: halves along the longest edge, until one triangle of the other surface answers for all of a piece.
  void search(const Corners& piece, int halvings, std::uint32_t& lately, double& max_squared) const {
    if (lately != kNone && reach(piece, lately) <= kSettled * max_squared) return;
    const Vector3d middle = (piece[0] + piece[1] + piece[2]) / 3;
    auto near = tree_.nearestTriangle(middle, lately != kNone ? squaredDistance(middle, to_, lately) : std::numeric_limits<double>::infinity());
    if (near.triangle == kNone) near.triangle = lately;
    lately = near.triangle;
    max_squared = std::max(max_squared, near.squared);
    const double radius = std::sqrt(std::max({(piece[0] - middle).squaredNorm(), (piece[1] - middle).squaredNorm(), (piece[2] - middle).squaredNorm()}));
    const double furthest = std::sqrt(near.squared) + radius;  // no two points' distances differ by more than they are apart
    if (furthest * furthest <= kSettled * max_squared || reach(piece, lately) <= kSettled * max_squared) return;
    int longest = 0;
    for (int k = 1; k < 3; ++k)
      if ((piece[(k + 1) % 3] - piece[k]).squaredNorm() > (piece[(longest + 1) % 3] - piece[longest]).squaredNorm()) longest = k;
    const Vector3d &a = piece[longest], &b = piece[(longest + 1) % 3], &c = piece[(longest + 2) % 3];
    if (halvings == kHalvings)
      for (const auto& p : piece) lookAt(p, lately, max_squared);
    if (halvings == 0 || (b - a).squaredNorm() <= kTooSmall * max_squared) return;
    const Vector3d half = (a + b) / 2;
    lookAt(half, lately, max_squared);
    search({a, half, c}, halvings - 1, lately, max_squared);
    search({half, b, c}, halvings - 1, lately, max_squared);
  }

  // Of each triangle which corners (the lower three bits) and which edges no triangle before it has.
  std::vector<std::uint8_t> freshPoints() const {
    std::vector<std::uint8_t> fresh(from_.triangles.size(), 0);
    std::vector<bool> seen(from_.positions.size(), false);
    for (std::size_t i = 0; i < fresh.size(); ++i)
      for (unsigned k = 0; k < 3; ++k) {
        const auto v = from_.triangles[i][k];
        if (!seen[v]) fresh[i] |= static_cast<std::uint8_t>(1U << k);
        seen[v] = true;
      }
    std::vector<std::pair<std::uint64_t, std::uint32_t>> edges(3 * fresh.size());  // its vertices, the corner it begins at
    for (std::uint32_t corner = 0; corner < edges.size(); ++corner) {
      const auto& t = from_.triangles[corner / 3];
      const auto [a, b] = std::minmax(t[corner % 3], t[(corner + 1) % 3]);
      edges[corner] = {std::uint64_t{a} << 32U | b, corner};
    }
    tbb::parallel_sort(edges.begin(), edges.end());
    for (std::size_t i = 0; i < edges.size(); ++i)
      if (i == 0 || edges[i].first != edges[i - 1].first) fresh[edges[i].second / 3] |= static_cast<std::uint8_t>(8U << (edges[i].second % 3));
    return fresh;
  }

  void lookAtMiddles(const Corners& t, std::uint8_t fresh, std::uint32_t& lately, double& max_squared) const {
    lookAt((t[0] + t[1] + t[2]) / 3, lately, max_squared);
    if (lately != kNone && reach(t, lately) <= max_squared) return;
    for (unsigned k = 0; k < 3; ++k) {
      if ((fresh & 1U << k) != 0) lookAt(t[k], lately, max_squared);
      if ((fresh & 8U << k) != 0) lookAt((t[k] + t[(k + 1) % 3]) / 2, lately, max_squared);
    }
  }

  void lookAt(const Vector3d& p, std::uint32_t& lately, double& max_squared) const {
    const double known = lately != kNone ? squaredDistance(p, to_, lately) : std::numeric_limits<double>::infinity();
    if (known <= max_squared) return;
    const auto near = tree_.nearestTriangle(p, known, max_squared);
    if (near.triangle != kNone) lately = near.triangle;
    max_squared = std::max(max_squared, near.squared);
  }

  const Shape &from_, &to_;
  const TriangleTree& tree_;
  const std::vector<std::uint32_t>& counterpart_;
};

Deviation deviationOfDropped(const Shape& shape, const std::vector<SurfacePoint>& points) {
  OneWay way;
  for (const auto& point : points) way += {point.position.squaredNorm(), point.position.norm(), 0, 1};
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

DeviationMeter::DeviationMeter(const Shape& before, const TriangleTree& tree, std::uint32_t samples, std::uint64_t seed)
    : before_(before), samples_(samples), seed_(seed), tree_(tree),
      points_(pointsByArea(before.positions, before.triangles, samples, {seed, 0})) {
  for (const auto& t : before.triangles) area_m2_ += areaOf(before.positions, t);
}

Deviation DeviationMeter::of(const Shape& after, const std::vector<std::uint32_t>& image) const { return measure(after, image, samples_, true); }

Deviation DeviationMeter::ofItself() const { return {.area_m2 = area_m2_}; }

Deviation DeviationMeter::measure(const Shape& after, const std::vector<std::uint32_t>& image, std::uint32_t samples, bool search) const {
  Deviation result;
  if (before_.triangles.empty()) return result;
  if (after.triangles.empty()) {
    result = deviationOfDropped(before_, points_);
  } else {
    std::vector<std::uint32_t> origin(after.triangles.size(), kNone);
    for (std::uint32_t i = 0; i < image.size(); ++i)
      if (image[i] != kNone) origin[image[i]] = i;
    const TriangleTree tree(after.positions, after.triangles);
    const std::size_t stride = std::max<std::size_t>(1, points_.size() / std::max<std::uint32_t>(samples, 1));
    const Way forth(before_, after, tree, image), back(after, before_, tree_, origin);
    const OneWay there = forth.ofPoints(points_, stride), here = back.ofPoints(pointsByArea(after.positions, after.triangles, samples, {seed_, 1}), 1);
    double max_squared = std::max(there.max_squared, here.max_squared);
    if (search) max_squared = forth.farthest(back.farthest(max_squared));
    result.max_m = std::sqrt(max_squared);
    result.mean_m = 0.5 * (there.mean() + here.mean());
    result.turn_rad = there.meanTurn();
  }
  result.area_m2 = area_m2_;
  return result;
}

}  // namespace standpoint
