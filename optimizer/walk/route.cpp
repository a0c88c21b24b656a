// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/walk/route.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>

#include "optimizer/walk/walkable.h"

namespace standpoint {

namespace {

constexpr double kFinest_m = 0.05, kMostCells = 2e6;
constexpr double kBeside_m = 1.5, kAbove_m = 0.5;
constexpr float kSameFloor_m = 0.02F;  // rectangles of the surface share their edges
constexpr double kHighestStep_m = kStepHeight + 0.02;

}  // namespace

WalkRoutes::WalkRoutes(const Mesh& walkable) {
  double area_m2 = 0;
  for (const auto& t : walkable.triangles) {
    const Eigen::Vector3d a = walkable.positions[t[0]].cast<double>(), b = walkable.positions[t[1]].cast<double>(),
                          c = walkable.positions[t[2]].cast<double>();
    area_m2 += (b - a).cross(c - a).norm() / 2;
  }
  cell_m_ = std::max(kFinest_m, std::sqrt(area_m2 / kMostCells));
  for (std::size_t t = 0; t < walkable.triangles.size(); ++t) cover(walkable, t);
  const auto key = [](const Cell& c) { return std::tuple(c.y, c.x, c.z); };
  std::sort(cells_.begin(), cells_.end(), [&](const Cell& a, const Cell& b) { return key(a) < key(b); });
  const auto same = [](const Cell& a, const Cell& b) { return a.x == b.x && a.y == b.y && b.z - a.z < kSameFloor_m; };
  cells_.erase(std::unique(cells_.begin(), cells_.end(), same), cells_.end());
}

// The cells whose middle is in the triangle, seen from above.
void WalkRoutes::cover(const Mesh& walkable, std::size_t triangle) {
  std::array<Eigen::Vector3d, 3> p;
  for (std::size_t i = 0; i < 3; ++i) p[i] = walkable.positions[walkable.triangles[triangle][i]].cast<double>();
  const auto cross = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b, double x, double y) {
    return (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
  };
  const double doubled = cross(p[0], p[1], p[2].x(), p[2].y());
  if (std::abs(doubled) < 1e-12) return;
  const auto cellOf = [&](double metres) { return static_cast<std::int32_t>(std::floor(metres / cell_m_)); };
  const auto [low_x, high_x] = std::minmax({p[0].x(), p[1].x(), p[2].x()});
  const auto [low_y, high_y] = std::minmax({p[0].y(), p[1].y(), p[2].y()});
  for (auto y = cellOf(low_y); y <= cellOf(high_y); ++y)
    for (auto x = cellOf(low_x); x <= cellOf(high_x); ++x) {
      const double px = (x + 0.5) * cell_m_, py = (y + 0.5) * cell_m_;
      const double a = cross(p[1], p[2], px, py) / doubled, b = cross(p[2], p[0], px, py) / doubled, c = 1 - a - b;
      constexpr double kOnEdge = -1e-9;
      if (a < kOnEdge || b < kOnEdge || c < kOnEdge) continue;
      cells_.push_back({x, y, static_cast<float>(a * p[0].z() + b * p[1].z() + c * p[2].z())});
    }
}

Eigen::Vector3d WalkRoutes::place(std::uint32_t cell) const {
  const auto& c = cells_[cell];
  return {(c.x + 0.5) * cell_m_, (c.y + 0.5) * cell_m_, c.z};
}

// Of those above each other the nearest in height.
std::uint32_t WalkRoutes::cellAt(std::int32_t x, std::int32_t y, double z, double reach_m) const {
  const auto before = [](const Cell& c, const std::pair<std::int32_t, std::int32_t>& wanted) {
    return std::pair(c.y, c.x) < wanted;
  };
  auto at = std::lower_bound(cells_.begin(), cells_.end(), std::pair(y, x), before);
  std::uint32_t best = kNone;
  for (; at != cells_.end() && at->x == x && at->y == y; ++at)
    if (const double apart = std::abs(at->z - z); apart <= reach_m) {
      best = static_cast<std::uint32_t>(at - cells_.begin());
      reach_m = apart;
    }
  return best;
}

std::uint32_t WalkRoutes::nearestCell(const Eigen::Vector3d& point) const {
  const auto x = static_cast<std::int32_t>(std::floor(point.x() / cell_m_)),
             y = static_cast<std::int32_t>(std::floor(point.y() / cell_m_));
  const auto reach = static_cast<std::int32_t>(std::ceil(kBeside_m / cell_m_));
  std::uint32_t best = kNone;
  double best_m = std::numeric_limits<double>::infinity();
  for (auto dy = -reach; dy <= reach; ++dy)
    for (auto dx = -reach; dx <= reach; ++dx) {
      const auto cell = cellAt(x + dx, y + dy, point.z(), kAbove_m);
      if (cell == kNone) continue;
      const Eigen::Vector3d away = place(cell) - point;
      if (away.head<2>().norm() > kBeside_m || away.norm() >= best_m) continue;
      best = cell;
      best_m = away.norm();
    }
  return best;
}

std::optional<Eigen::Vector3d> WalkRoutes::nearest(const Eigen::Vector3d& point) const {
  const auto cell = nearestCell(point);
  return cell == kNone ? std::nullopt : std::optional(place(cell));
}

Result<std::vector<Eigen::Vector3d>> WalkRoutes::between(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                                         Progress& progress) const {
  const auto begin = nearestCell(from), end = nearestCell(to);
  if (begin == kNone || end == kNone) return std::vector<Eigen::Vector3d>();
  const Eigen::Vector3d goal = place(end);
  std::vector<float> cost(cells_.size(), std::numeric_limits<float>::infinity());
  std::vector<std::uint32_t> came_from(cells_.size(), kNone);
  using Open = std::pair<float, std::uint32_t>;  // at least as far in all; equal ones by their cell, so always alike
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  cost[begin] = 0;
  open.push({0.0F, begin});
  for (std::size_t step = 0; !open.empty(); ++step) {
    if (step % 65536 == 0) TRY(progress.check());
    const auto [all, cell] = open.top();
    open.pop();
    if (cell == end) break;
    const Cell& c = cells_[cell];
    if (all > cost[cell] + static_cast<float>((goal - place(cell)).norm()) + 1e-3F)
      continue;  // a shorter way came since
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        if (dx == 0 && dy == 0) continue;
        const auto next = cellAt(c.x + dx, c.y + dy, c.z, kHighestStep_m);
        if (next == kNone) continue;
        const auto there = cost[cell] + static_cast<float>((place(next) - place(cell)).norm());
        if (there >= cost[next]) continue;
        cost[next] = there;
        came_from[next] = cell;
        open.push({there + static_cast<float>((goal - place(next)).norm()), next});
      }
  }
  std::vector<std::uint32_t> cells;
  if (begin != end && came_from[end] == kNone) return std::vector<Eigen::Vector3d>();
  for (auto cell = end; cell != kNone; cell = came_from[cell]) cells.push_back(cell);
  std::reverse(cells.begin(), cells.end());
  return pulled(cells);
}

// Whether one can walk straight, and over which cells: one for each half of a cell of the way.
bool WalkRoutes::straight(std::uint32_t from, std::uint32_t to, std::vector<std::uint32_t>& between) const {
  between.clear();
  const Eigen::Vector3d a = place(from), b = place(to);
  const int steps = std::max(1, static_cast<int>(std::ceil(2 * (b - a).head<2>().norm() / cell_m_)));
  auto at = from;
  for (int i = 1; i <= steps; ++i) {
    const Eigen::Vector3d p = a + (b - a) * (static_cast<double>(i) / steps);
    at = cellAt(static_cast<std::int32_t>(std::floor(p.x() / cell_m_)),
                static_cast<std::int32_t>(std::floor(p.y() / cell_m_)), cells_[at].z, kHighestStep_m);
    if (at == kNone) return false;
    if (between.empty() || between.back() != at) between.push_back(at);
  }
  return at == to;
}

std::vector<Eigen::Vector3d> WalkRoutes::pulled(const std::vector<std::uint32_t>& cells) const {
  std::vector<Eigen::Vector3d> way = {place(cells.front())};
  std::vector<std::uint32_t> over, tried;
  for (std::size_t at = 0; at + 1 < cells.size();) {
    std::size_t reached = at + 1;
    over = {cells[reached]};
    // Farther and farther while it goes, then nearer again.
    for (std::size_t jump = 2; jump > 0;) {
      const auto next = std::min(reached + jump, cells.size() - 1);
      if (next > reached && straight(cells[at], cells[next], tried)) {
        reached = next;
        over = tried;
        jump *= 2;
      } else {
        jump /= 2;
      }
    }
    const Eigen::Vector3d a = place(cells[at]), b = place(cells[reached]);
    const double length = std::max((b - a).head<2>().norm(), 1e-9);
    for (const auto cell : over) {  // on the straight line, with the height of the floor there
      Eigen::Vector3d p = place(cell);
      const double along = std::clamp((p - a).head<2>().dot((b - a).head<2>()) / (length * length), 0.0, 1.0);
      p.head<2>() = a.head<2>() + (b - a).head<2>() * along;
      way.push_back(p);
    }
    at = reached;
  }
  return way;
}

}  // namespace standpoint
