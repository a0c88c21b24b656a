// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/doors.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "optimizer/triangle_distance.h"
#include "optimizer/triangle_tree.h"
#include "optimizer/walkable.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr double kFloorReach = 0.35;  // m above and below the door's lower edge in which its floor is looked for
constexpr double kTouch = 1e-3;       // m; a capsule that only touches still passes
constexpr double kOffsets[] = {0, 0.02, -0.02, 0.05, -0.05, 0.1, -0.1, 0.15, -0.15};  // m beside the door's middle

struct Obstacles {
  std::vector<Vector3d> positions;
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> shape_of_triangle;

  explicit Obstacles(const std::vector<CollisionShape>& shapes) {
    for (std::uint32_t i = 0; i < shapes.size(); ++i) {
      const auto first = static_cast<std::uint32_t>(positions.size());
      for (const auto& p : shapes[i].mesh.positions) positions.emplace_back(p.cast<double>());
      for (const auto& t : shapes[i].mesh.triangles) {
        triangles.push_back({first + t[0], first + t[1], first + t[2]});
        shape_of_triangle.push_back(i);
      }
    }
  }
  Corners corners(std::uint32_t i) const { return {positions[triangles[i][0]], positions[triangles[i][1]], positions[triangles[i][2]]}; }
};

// Height of the uppermost surface below or above p within reach.
std::optional<double> floorAt(const Obstacles& obstacles, const TriangleTree& tree, const Vector3d& p) {
  std::optional<double> best;
  const Vector3d reach(1e-6, 1e-6, kFloorReach);
  tree.inBox(p - reach, p + reach, [&](std::uint32_t i) {
    const auto t = obstacles.corners(i);
    const auto side = [&](const Vector3d& a, const Vector3d& b) { return (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x()); };
    const double a = side(t[1], t[2]), b = side(t[2], t[0]), c = side(t[0], t[1]), sum = a + b + c;
    if (sum == 0 || a * sum < 0 || b * sum < 0 || c * sum < 0) return true;
    const double z = (a * t[0].z() + b * t[1].z() + c * t[2].z()) / sum;
    if (std::abs(z - p.z()) <= kFloorReach && (!best || z > *best)) best = z;
    return true;
  });
  return best;
}

bool isInside(const CollisionShape& shape, const Vector3d& p) {
  if (shape.kind == CollisionShapeKind::mesh) return false;
  for (const auto& t : shape.mesh.triangles) {
    const Vector3d a = shape.mesh.positions[t[0]].cast<double>();
    const Vector3d normal = (shape.mesh.positions[t[1]].cast<double>() - a).cross(shape.mesh.positions[t[2]].cast<double>() - a);
    if (normal.dot(p - a) > 0) return false;
  }
  return true;
}

// What a sphere swept over the whole rectangle low..high meets first: the volume that an upright capsule sweeps on a
// straight way, the same in both senses.
std::optional<std::uint32_t> blocker(const std::vector<CollisionShape>& shapes, const Obstacles& obstacles, const TriangleTree& tree, const Vector3d& from,
                                     const Vector3d& to, double height, double radius) {
  const Vector3d up(0, 0, height);
  const Corners first{from, to, to + up}, second{from, to + up, from + up};
  const Vector3d margin = Vector3d::Constant(radius);
  std::optional<std::uint32_t> result;
  tree.inBox(from.cwiseMin(to) - margin, from.cwiseMax(to) + up + margin, [&](std::uint32_t i) {
    const auto t = obstacles.corners(i);
    if (distance(first, t) < radius || distance(second, t) < radius) result = obstacles.shape_of_triangle[i];
    return !result;
  });
  for (std::uint32_t i = 0; i < shapes.size() && !result; ++i)
    if (isInside(shapes[i], 0.5 * (from + to) + 0.5 * up)) result = i;
  return result;
}

struct Verdict {
  Door door;
  bool shapeless = false;
  std::optional<std::uint32_t> blocked_by;  // product
};

Verdict judge(const Environment& environment, std::uint32_t product, const std::vector<CollisionShape>& shapes, const Obstacles& obstacles,
              const TriangleTree& tree, const CollideOptions& options) {
  Verdict verdict;
  verdict.door.product = product;
  const auto passage = passageOf(environment, product);
  verdict.shapeless = !passage;
  if (!passage) return verdict;
  const Vector3d reach = passage->through * (passage->half_depth + options.agent_radius_m);
  const auto before = floorAt(obstacles, tree, passage->middle - reach), behind = floorAt(obstacles, tree, passage->middle + reach);
  verdict.door.floor = before && behind;
  const double level = std::max({passage->middle.z(), before.value_or(-1e300), behind.value_or(-1e300)});
  // What is lower than a step is climbed, as in the walkable surface.
  const double radius = options.agent_radius_m;
  const double low = level + std::min(kStepHeight, options.agent_height_m - 2 * radius) + radius;
  const double height = level + options.agent_height_m - radius - low;
  std::optional<std::uint32_t> first;
  for (const double offset : kOffsets) {
    Vector3d middle = passage->middle + passage->across * offset;
    middle.z() = low;
    const auto met = blocker(shapes, obstacles, tree, middle - reach, middle + reach, height, radius - kTouch);
    verdict.door.passable = !met;
    if (!met) break;
    if (!first) first = shapes[*met].product;
  }
  if (!verdict.door.passable) verdict.blocked_by = first;
  return verdict;
}

}  // namespace

bool isDoor(const Product& product) { return product.ifc_class == "IfcDoor" || product.ifc_class == "IfcDoorStandardCase"; }

// A door's leaf and glass are most of its area, so their normals say which way leads through. Angles are doubled, as a
// normal and its opposite are the same direction.
std::optional<Passage> passageOf(const Environment& environment, std::uint32_t product) {
  double cosine = 0, sine = 0;
  std::vector<Vector3d> points;
  for (const auto& instance : environment.instances) {
    if (instance.product != product) continue;
    const auto& mesh = *environment.meshes[instance.mesh];
    for (const auto& t : mesh.triangles) {
      Vector3d corner[3];
      for (int k = 0; k < 3; ++k) points.push_back(corner[k] = instance.world_from_mesh * mesh.positions[t[k]].cast<double>());
      const Vector3d normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
      const double level = normal.head<2>().norm(), angle = 2 * std::atan2(normal.y(), normal.x());
      cosine += level * std::cos(angle);
      sine += level * std::sin(angle);
    }
  }
  if (points.empty()) return std::nullopt;
  Passage passage;
  const double angle = std::atan2(sine, cosine) / 2;
  passage.through = {std::cos(angle), std::sin(angle), 0};
  passage.across = {-passage.through.y(), passage.through.x(), 0};
  Bounds box;
  for (const auto& p : points) box.extend(Vector3d(passage.through.dot(p), passage.across.dot(p), p.z()));
  passage.middle = passage.through * (0.5 * (box.min.x() + box.max.x())) + passage.across * (0.5 * (box.min.y() + box.max.y()));
  passage.middle.z() = box.min.z();
  passage.half_depth = 0.5 * (box.max.x() - box.min.x());
  return passage;
}

std::vector<bool> belongsToDoor(const Environment& environment) {
  std::vector<bool> result(environment.products.size(), false);
  for (std::size_t i = 0; i < result.size(); ++i) {
    auto at = static_cast<std::int32_t>(i);
    for (int depth = 0; depth < 32 && at >= 0; ++depth) {  // a file may make a ring of parts
      if (isDoor(environment.products[static_cast<std::size_t>(at)])) result[i] = true;
      at = environment.products[static_cast<std::size_t>(at)].whole;
    }
  }
  return result;
}

std::vector<Door> checkDoors(const Environment& environment, const std::vector<CollisionShape>& shapes, const CollideOptions& options, Report& report) {
  std::vector<std::uint32_t> doors;
  for (std::uint32_t i = 0; i < environment.products.size(); ++i)
    if (environment.products[i].tangible && isDoor(environment.products[i])) doors.push_back(i);
  const Obstacles obstacles(shapes);
  const TriangleTree tree(obstacles.positions, obstacles.triangles);
  std::vector<Verdict> verdicts(doors.size());
  tbb::parallel_for(std::size_t{0}, doors.size(), [&](std::size_t i) { verdicts[i] = judge(environment, doors[i], shapes, obstacles, tree, options); });
  std::vector<Door> result;
  for (const auto& verdict : verdicts) {
    const auto& product = environment.products[verdict.door.product];
    result.push_back(verdict.door);
    if (verdict.shapeless) {
      report.warn(product.id, fmt::format("door {} has no geometry: whether one can pass is unknown", product.name));
      continue;
    }
    if (!verdict.door.floor) report.warn(product.id, fmt::format("door {} has no floor on both sides", product.name));
    if (!verdict.door.passable)
      report.warn(product.id, fmt::format("door {} is blocked by {} {}", product.name, environment.products[*verdict.blocked_by].ifc_class,
                                          environment.products[*verdict.blocked_by].id));
  }
  return result;
}

}  // namespace standpoint
