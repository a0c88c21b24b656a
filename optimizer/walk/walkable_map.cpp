// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/walk/walkable_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <tuple>

#include "optimizer/walk/walkable.h"

namespace standpoint {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kTouching = 1e-3;     // m; rectangles this near are side by side
constexpr double kBesideIsland = 0.6;  // m from a place to the rectangle that it is beside
constexpr double kStoreyBelow = 1.5;   // m; what has a floor so far under it is not the ground
constexpr double kStepUpMost = kStepHeight + 1e-3;
constexpr double kTile = 0.5;             // m, of the index of places
constexpr double kStraightSample = 0.02;  // m between the places of a straight way that are looked at
constexpr double kLongestStraight = 8;    // m

int tileOf(double x) { return static_cast<int>(std::floor(x / kTile)); }

Vector3d nearestIn(const Bounds& box, const Vector3d& p) { return p.cwiseMax(box.min).cwiseMin(box.max); }

}  // namespace

WalkableMap::WalkableMap(const Mesh& walkable) : island_(walkable.triangles.size() / 2), neighbours_(island_.size()) {
  std::iota(island_.begin(), island_.end(), 0U);
  for (std::size_t i = 0; i + 1 < walkable.triangles.size(); i += 2) {
    auto& box = boxes_.emplace_back();
    for (const auto v : walkable.triangles[i]) box.extend(walkable.positions[v].cast<double>());
  }
  join();
  for (std::uint32_t i = 0; i < island_.size(); ++i) {
    island_[i] = rootOf(i);
    area_of_island_[island_[i]] += area(i);
    for (int x = tileOf(boxes_[i].min.x()); x <= tileOf(boxes_[i].max.x()); ++x)
      for (int y = tileOf(boxes_[i].min.y()); y <= tileOf(boxes_[i].max.y()); ++y) in_tile_[{x, y}].push_back(i);
  }
}

double WalkableMap::area(std::uint32_t i) const {
  const Vector3d size = boxes_[i].max - boxes_[i].min;
  return size.x() * size.y();
}

std::optional<std::uint32_t> WalkableMap::at(const Vector3d& p) const {
  std::optional<std::uint32_t> best;
  double nearest = kBesideIsland;
  for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
    const Vector3d off = p - nearestIn(boxes_[i], p);
    if (std::abs(off.z()) > kStepHeight || off.head<2>().norm() >= nearest) continue;
    nearest = off.head<2>().norm();
    best = i;
  }
  return best;
}

std::optional<std::uint32_t> WalkableMap::under(const Vector3d& p) const {
  const auto tile = in_tile_.find({tileOf(p.x()), tileOf(p.y())});
  if (tile == in_tile_.end()) return std::nullopt;
  std::optional<std::uint32_t> best;
  double nearest = kStepUpMost;
  for (const auto i : tile->second) {
    const Vector3d off = p - nearestIn(boxes_[i], p);
    if (std::abs(off.x()) > kTouching || std::abs(off.y()) > kTouching || std::abs(off.z()) > nearest) continue;
    nearest = std::abs(off.z());
    best = i;
  }
  return best;
}

bool WalkableMap::anyUnder(const Vector3d& p) const {
  return std::any_of(boxes_.begin(), boxes_.end(), [&](const Bounds& box) {
    return box.max.z() < p.z() - kStoreyBelow &&
           (p.head<2>().array() >= box.min.head<2>().array() - kBesideIsland).all() &&
           (p.head<2>().array() <= box.max.head<2>().array() + kBesideIsland).all();
  });
}

void WalkableMap::join() {
  std::vector<std::uint32_t> order(boxes_.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto low = [&](std::uint32_t i) { return boxes_[i].min.y(); };
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return std::pair(low(a), a) < std::pair(low(b), b); });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Bounds& a = boxes_[order[i]];
    for (std::size_t k = i + 1; k < order.size() && low(order[k]) <= a.max.y() + kTouching; ++k) {
      const Bounds& b = boxes_[order[k]];
      if (a.min.x() > b.max.x() + kTouching || b.min.x() > a.max.x() + kTouching ||
          a.min.z() > b.max.z() + kStepUpMost || b.min.z() > a.max.z() + kStepUpMost)
        continue;
      unite(order[i], order[k]);
      neighbours_[order[i]].push_back(order[k]);
      neighbours_[order[k]].push_back(order[i]);
    }
  }
}

void WalkableMap::unite(std::uint32_t a, std::uint32_t b) {
  a = rootOf(a), b = rootOf(b);
  island_[std::max(a, b)] = std::min(a, b);
}

std::uint32_t WalkableMap::rootOf(std::uint32_t i) {
  while (island_[i] != i) i = island_[i] = island_[island_[i]];
  return i;
}

std::vector<Vector3d> WalkableMap::cheapestWay(std::span<const Vector3d> from,
                                               const std::function<bool(std::uint32_t)>& wanted,
                                               const Cost& cost) const {
  constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
  struct Step {
    double cost = std::numeric_limits<double>::infinity();
    Vector3d entered = Vector3d::Zero();
    std::uint32_t before = kNone;
  };
  std::vector<Step> steps(boxes_.size());
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  for (const auto& p : from) {
    const auto i = under(p);
    if (!i || steps[*i].cost == 0) continue;
    steps[*i] = {0, nearestIn(boxes_[*i], p), kNone};
    open.emplace(0.0, *i);
  }
  while (!open.empty()) {
    const auto [so_far, i] = open.top();
    open.pop();
    if (so_far > steps[i].cost) continue;
    if (wanted(i)) {
      std::vector<Vector3d> way;
      for (auto k = i; k != kNone; k = steps[k].before) way.push_back(steps[k].entered);
      std::reverse(way.begin(), way.end());
      return way;
    }
    for (const auto k : neighbours_[i]) {
      // Over the middle of a short threshold, and the nearest point of a long one.
      const Bounds shared{boxes_[i].min.cwiseMax(boxes_[k].min), boxes_[i].max.cwiseMin(boxes_[k].max)};
      Vector3d threshold =
          nearestIn({shared.min.cwiseMin(shared.max), shared.max.cwiseMax(shared.min)}, steps[i].entered);
      threshold.z() = boxes_[k].min.z();
      const double next = so_far + cost(steps[i].entered, threshold);
      if (next >= steps[k].cost) continue;
      steps[k] = {next, threshold, i};
      open.emplace(next, k);
    }
  }
  return {};
}

bool WalkableMap::isStraight(const Vector3d& from, const Vector3d& to) const {
  const double length = (to - from).head<2>().norm();
  const int samples = 1 + static_cast<int>(length / kStraightSample);
  double z = from.z();
  for (int i = 1; i <= samples; ++i) {
    Vector3d p = from + (to - from) * i / samples;
    p.z() = z;
    const auto rectangle = under(p);
    if (!rectangle) return false;
    z = boxes_[*rectangle].min.z();
  }
  return std::abs(z - to.z()) < kTouching;
}

std::vector<Vector3d> WalkableMap::way(const Vector3d& from, const Vector3d& to) const {
  const auto goal = under(to);
  if (!goal) return {};
  auto corners = cheapestWay(
      std::span(&from, 1), [&](std::uint32_t i) { return i == *goal; },
      [](const Vector3d& a, const Vector3d& b) { return (b - a).norm(); });
  if (corners.empty()) return {};
  corners.push_back(nearestIn(boxes_[*goal], to));
  std::vector<Vector3d> straight{corners.front()};
  for (std::size_t i = 0; i + 1 < corners.size();) {
    std::size_t next = i + 1;
    for (std::size_t k = i + 2; k < corners.size() && (corners[k] - corners[i]).norm() < kLongestStraight; ++k)
      if (isStraight(corners[i], corners[k])) next = k;
    straight.push_back(corners[next]);
    i = next;
  }
  return straight;
}

}  // namespace standpoint
