// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/walk/door_connectivity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include <fmt/format.h>

namespace standpoint {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kReach = 0.6;      // m above and below the door's lower edge that its way may lie
constexpr double kOneTouch = 1e-4;  // m; rectangles this near are side by side
constexpr double kBeyond = 0.15;    // m past the ends of a free way where the surface may only begin
constexpr double kClimb = kStepHeight + 1e-3;

// Two triangles of the surface.
struct FloorPiece {
  Vector2d low, high;
  double level = 0;
  std::uint32_t island = 0;
};

std::size_t rectangles(const Walkable& walkable) { return walkable.mesh.triangles.size() / 2; }

FloorPiece rectangleAt(const Walkable& walkable, std::size_t i) {
  const auto& t = walkable.mesh.triangles[2 * i];
  const Vector3d a = walkable.mesh.positions[t[0]].cast<double>(), b = walkable.mesh.positions[t[2]].cast<double>();
  return {a.head<2>().cwiseMin(b.head<2>()), a.head<2>().cwiseMax(b.head<2>()), a.z(),
          walkable.island_of_triangle[2 * i]};
}

// Those about the door.
std::vector<FloorPiece> rectanglesNear(const Walkable& walkable, const Passage& passage, double margin) {
  std::vector<FloorPiece> result;
  const double reach = passage.half_depth + passage.half_width + margin;
  for (std::size_t i = 0; i < rectangles(walkable); ++i) {
    const auto r = rectangleAt(walkable, i);
    const Vector2d off = passage.middle.head<2>() - passage.middle.head<2>().cwiseMax(r.low).cwiseMin(r.high);
    if (std::abs(r.level - passage.middle.z()) <= kReach && off.norm() <= reach) result.push_back(r);
  }
  return result;
}

// What of a convex outline lies where along·p <= limit.
std::vector<Vector2d> clipped(const std::vector<Vector2d>& outline, const Vector2d& along, double limit) {
  std::vector<Vector2d> result;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d &p = outline[i], &q = outline[(i + 1) % outline.size()];
    const double a = along.dot(p) - limit, b = along.dot(q) - limit;
    if (a <= 0) result.push_back(p);
    if ((a < 0 && b > 0) || (a > 0 && b < 0)) result.push_back(p + (q - p) * (a / (a - b)));
  }
  return result;
}

// What two rectangles have in common, or of one with itself, within the door's opening.
std::vector<Vector2d> within(const Passage& passage, const FloorPiece& r, const FloorPiece& s, double reach) {
  const Vector2d low = r.low.cwiseMax(s.low), high = r.high.cwiseMin(s.high), middle = passage.middle.head<2>();
  if (((low - high).array() > kOneTouch).any()) return {};
  const Vector2d along = passage.through.head<2>(), across = passage.across.head<2>();
  std::vector<Vector2d> outline{low, {high.x(), low.y()}, high, {low.x(), high.y()}};
  for (const double side : {-1.0, 1.0}) {
    outline = clipped(outline, side * along, side * along.dot(middle) + reach);
    outline = clipped(outline, side * across, side * across.dot(middle) + passage.half_width);
  }
  return outline;
}

// The surface's level at p, the one nearest to p's own within a step.
std::optional<FloorPiece> surfaceAt(const std::vector<FloorPiece>& near, const Vector3d& p) {
  std::optional<FloorPiece> best;
  for (const auto& r : near) {
    const Vector2d off = p.head<2>() - p.head<2>().cwiseMax(r.low).cwiseMin(r.high);
    if (off.norm() > kOneTouch || std::abs(r.level - p.z()) > kClimb) continue;
    if (!best || std::abs(r.level - p.z()) < std::abs(best->level - p.z())) best = r;
  }
  return best;
}

// Points a third of a cell apart on the floor under a way and a little past its ends; empty where there is a hole, or a
// step that nobody climbs.
std::vector<Vector3d> floorUnder(const Obstacles& obstacles, const FreeWay& way, double cell) {
  const Vector3d along = (way.to - way.from).normalized();
  const double length = (way.to - way.from).norm() + 2 * kBeyond;
  const auto count = static_cast<std::size_t>(std::ceil(3 * length / cell));
  std::vector<Vector3d> result;
  for (std::size_t i = 0; i <= count; ++i) {
    Vector3d p = way.from + along * (length * static_cast<double>(i) / static_cast<double>(count) - kBeyond);
    const bool beyond = (p - way.from).dot(along) < 0 || (p - way.to).dot(along) > 0;
    if (!result.empty()) p.z() = result.back().z();
    const Vector3d reach(0, 0, kReach);
    const auto hit = obstacles.ray(p + reach, p - reach);
    if (hit && (result.empty() || std::abs(hit->point.z() - p.z()) <= kClimb))
      result.push_back({p.x(), p.y(), hit->point.z()});
    else if (!beyond)
      return {};
    else if (!result.empty())
      break;
  }
  return result;
}

void addCell(Walkable& walkable, const Vector2d& low, double level, std::uint32_t island) {
  auto& mesh = walkable.mesh;
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const double cell = walkable.cell_m;
  for (const auto& corner : {Vector2d(0, 0), Vector2d(cell, 0), Vector2d(cell, cell), Vector2d(0, cell)})
    mesh.positions.push_back(Vector3d(low.x() + corner.x(), low.y() + corner.y(), level).cast<float>());
  mesh.triangles.insert(mesh.triangles.end(), {{first, first + 1, first + 2}, {first, first + 2, first + 3}});
  mesh.surface_of_triangle.insert(mesh.surface_of_triangle.end(), 2, 0);
  walkable.island_of_triangle.insert(walkable.island_of_triangle.end(), 2, island);
  walkable.area_m2 += cell * cell;
}

// A strip from the last point before the door's middle that is on the surface to the first behind it.
bool join(const Environment& environment, const Obstacles& obstacles, const Passage& passage,
          const CollideOptions& options, Walkable& walkable) {
  const auto way = freeWay(environment, obstacles, passage, options);
  if (!way) return false;
  const auto path = floorUnder(obstacles, *way, walkable.cell_m);
  const auto near = rectanglesNear(walkable, passage, options.agent_radius_m + 2 * kBeyond);
  std::optional<FloorPiece> before, behind;
  std::size_t first = 0, last = 0;
  for (std::size_t i = 0; i < path.size() && !behind; ++i) {
    const auto here = surfaceAt(near, path[i]);
    if (!here) continue;
    if ((path[i] - passage.middle).dot(passage.through) < 0)
      before = here, first = i;
    else
      behind = here, last = i;
  }
  if (!before || !behind) return false;
  const Vector2d origin = before->low;  // cells lie on the grid that the rectangles are made of
  std::array<double, 3> done{NAN, NAN, NAN};
  for (std::size_t i = first; i <= last; ++i) {
    const Vector2d low =
        origin + ((path[i].head<2>() - origin) / walkable.cell_m).array().floor().matrix() * walkable.cell_m;
    if (done == std::array<double, 3>{low.x(), low.y(), path[i].z()} || surfaceAt(near, path[i])) continue;
    addCell(walkable, low, path[i].z(), before->island);
    done = {low.x(), low.y(), path[i].z()};
  }
  std::replace(walkable.island_of_triangle.begin(), walkable.island_of_triangle.end(), behind->island, before->island);
  return true;
}

}  // namespace

bool leadsThrough(const Walkable& walkable, const Passage& passage, double radius_m) {
  const double reach = passage.half_depth + radius_m;
  auto near = rectanglesNear(walkable, passage, radius_m);
  std::erase_if(near, [&](const FloorPiece& r) { return within(passage, r, r, reach).empty(); });
  const auto touches = [&](const FloorPiece& r, double end) {
    const auto outline = within(passage, r, r, reach);
    return std::any_of(outline.begin(), outline.end(), [&](const Vector2d& p) {
      return end * (p - passage.middle.head<2>()).dot(passage.through.head<2>()) >= reach - walkable.cell_m;
    });
  };
  std::vector<char> seen(near.size(), 0);
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < near.size(); ++i)
    if (touches(near[i], -1)) seen[i] = 1, front.push_back(i);
  while (!front.empty()) {
    const auto at = front.back();
    front.pop_back();
    if (touches(near[at], 1)) return true;
    for (std::size_t i = 0; i < near.size(); ++i) {
      if (seen[i] || near[i].island != near[at].island || std::abs(near[i].level - near[at].level) > kClimb ||
          within(passage, near[at], near[i], reach).empty())
        continue;
      seen[i] = 1;
      front.push_back(i);
    }
  }
  return false;
}

void joinThroughDoors(const Environment& environment, const std::vector<CollisionShape>& shapes,
                      const CollideOptions& options, std::vector<Door>& doors, Walkable& walkable, Report& report) {
  const Obstacles obstacles(shapes);
  for (auto& door : doors) {
    if (!door.passable || !door.floor) continue;
    const auto passage = passageOf(environment, door.product);
    if (!passage) continue;
    door.led_through = leadsThrough(walkable, *passage, options.agent_radius_m) ||
                       join(environment, obstacles, *passage, options, walkable);
    const auto& product = environment.products[door.product];
    if (!door.led_through)
      report.warn(product.id, fmt::format("door {} is passable, but not connected by walkable surface: check for a "
                                          "step, a gap or insufficient space on either side",
                                          product.name));
  }
}

}  // namespace standpoint
