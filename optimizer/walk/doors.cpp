// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/walk/doors.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/ceiling.h"
#include "optimizer/surface/piece.h"
#include "optimizer/walk/walkable.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr double kFloorReach = 0.35;  // m above and below the door's lower edge in which its floor is looked for
constexpr double kTouch = 1e-3;       // m; a capsule that only touches still passes
constexpr double kBeside = 0.30;      // m from the door's middle that a way through it is looked for …
constexpr double kBesideStep = 0.02;  // … in steps of
constexpr double kWidest = 2;         // m that a clear width is measured to
constexpr double kDeep = 1.5;         // times its width, that no door is
constexpr double kPlate = 0.04;       // m, thickness of the leaf of a door that has none

bool isDoor(const Product& product) {
  return product.ifc_class == "IfcDoor" || product.ifc_class == "IfcDoorStandardCase";
}

// Height of the uppermost surface below or above p within reach, unless it is a suspended ceiling's.
std::optional<double> floorAt(const Environment& environment, const Obstacles& obstacles, const Vector3d& p) {
  const Vector3d reach(0, 0, kFloorReach);
  const auto hit = obstacles.ray(p + reach, p - reach);
  if (!hit || isSuspendedCeiling(environment.products[hit->product])) return std::nullopt;
  return hit->point.z();
}

struct Way {
  Vector3d from, to;  // of the feet of what passes, in the door's middle
  Body upper;         // the agent without what it steps over, as in the walkable surface
  int floors = 0;     // of two sides
};

Way wayThrough(const Environment& environment, const Passage& passage, const Obstacles& obstacles,
               const CollideOptions& options) {
  const Vector3d reach = passage.through * (passage.half_depth + options.agent_radius_m);
  const auto before = floorAt(environment, obstacles, passage.middle - reach),
             behind = floorAt(environment, obstacles, passage.middle + reach);
  const double lift = std::min(kStepHeight, options.agent_height_m - 2 * options.agent_radius_m);
  Way way{passage.middle - reach,
          passage.middle + reach,
          {options.agent_radius_m, options.agent_height_m - lift},
          static_cast<int>(before.has_value()) + static_cast<int>(behind.has_value())};
  way.from.z() = way.to.z() = std::max({passage.middle.z(), before.value_or(-1e300), behind.value_or(-1e300)}) + lift;
  return way;
}

struct Attempt {
  std::optional<Vector3d> beside;           // of the free way that is nearest to the door's middle
  std::optional<std::uint32_t> blocked_by;  // the product that stops a body in the middle, where none is free
};

Attempt tryWays(const Obstacles& obstacles, const Passage& passage, const Way& way, double radius) {
  const Body body{radius - kTouch, way.upper.height_m};
  Attempt attempt;
  for (int i = 0; i * kBesideStep <= 2 * kBeside; ++i) {
    const Vector3d beside = passage.across * ((i % 2 == 0 ? 0.5 : -0.5) * kBesideStep * (i + i % 2));
    auto met = obstacles.sweep(body, way.from + beside, way.to + beside);
    if (!met) met = obstacles.sweep(body, way.to + beside, way.from + beside);
    if (!met) return {beside, std::nullopt};
    if (!attempt.blocked_by) attempt.blocked_by = met->product;
  }
  return attempt;
}

double clearWidth(const Obstacles& obstacles, const Passage& passage, const Way& way) {
  double passes = 0, stuck = std::min(kWidest, way.upper.height_m) / 2;
  if (tryWays(obstacles, passage, way, stuck).beside) return 2 * stuck;
  while (stuck - passes > 0.0025) {
    const double radius = 0.5 * (passes + stuck);
    (tryWays(obstacles, passage, way, radius + kTouch).beside ? passes : stuck) = radius;
  }
  return passes < 0.01 ? 0 : 2 * passes;
}

struct Verdict {
  Door door;
  bool shapeless = false;
  int floors = 0;                           // of two sides
  std::optional<std::uint32_t> blocked_by;  // product
};

Verdict judge(const Environment& environment, std::uint32_t product, const Obstacles& obstacles,
              const CollideOptions& options) {
  Verdict verdict;
  verdict.door.product = product;
  const auto passage = passageOf(environment, product);
  verdict.shapeless = !passage;
  if (!passage) return verdict;
  const auto way = wayThrough(environment, *passage, obstacles, options);
  verdict.door.position = passage->middle;
  verdict.floors = way.floors;
  verdict.door.floor = way.floors == 2;
  verdict.blocked_by = tryWays(obstacles, *passage, way, options.agent_radius_m).blocked_by;
  verdict.door.passable = !verdict.blocked_by;
  verdict.door.clear_width_m = clearWidth(obstacles, *passage, way);
  return verdict;
}

std::vector<std::uint32_t> doorsOf(const Environment& environment) {
  std::vector<std::uint32_t> doors;
  for (std::uint32_t i = 0; i < environment.products.size(); ++i)
    if (environment.products[i].inScene() && isDoor(environment.products[i])) doors.push_back(i);
  return doors;
}

void reportDoor(const Environment& environment, const Verdict& verdict, Report& report) {
  const auto& product = environment.products[verdict.door.product];
  if (verdict.shapeless)
    return report.warn(product.id, fmt::format("door {} has no geometry: passability unknown", product.name));
  if (!verdict.door.floor)
    report.warn(product.id,
                verdict.floors == 0
                    ? fmt::format("door {} has no floor on either side", product.name)
                    : fmt::format("door {} has no floor on one side: add what one steps onto there", product.name));
  if (!verdict.blocked_by || verdict.door.closed) return;
  const auto& other = environment.products[*verdict.blocked_by];
  report.warn(product.id, verdict.door.clear_width_m > 0
                              ? fmt::format("door {} is impassable: {:.2f} m clear width next to {} {}", product.name,
                                            verdict.door.clear_width_m, other.ifc_class, other.id)
                              : fmt::format("door {} is blocked by {} {}", product.name, other.ifc_class, other.id));
}

}  // namespace

// A door's leaf and glass are most of its area, so their normals say which way leads through, unless it would be much
// deeper than wide. Angles are doubled, as a normal and its opposite are the same direction.
std::optional<Passage> passageOf(const Environment& environment, std::uint32_t product) {
  double cosine = 0, sine = 0;
  std::vector<Vector3d> points;
  for (const auto& instance : environment.instances) {
    if (instance.product != product) continue;
    const auto& mesh = *environment.meshes[instance.mesh];
    for (const auto& t : mesh.triangles) {
      Vector3d corner[3];
      for (int k = 0; k < 3; ++k)
        points.push_back(corner[k] = instance.world_from_mesh * mesh.positions[t[k]].cast<double>());
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
  const auto boxAlong = [&] {
    passage.across = {-passage.through.y(), passage.through.x(), 0};
    Bounds box;
    for (const auto& p : points) box.extend(Vector3d(passage.through.dot(p), passage.across.dot(p), p.z()));
    return box;
  };
  Bounds box = boxAlong();
  if (const Vector3d size = box.max - box.min; size.x() > kDeep * size.y()) {  // the posts of an empty frame
    passage.through = passage.across;
    box = boxAlong();
  }
  passage.middle =
      passage.through * (0.5 * (box.min.x() + box.max.x())) + passage.across * (0.5 * (box.min.y() + box.max.y()));
  passage.middle.z() = box.min.z();
  const Vector3d size = box.max - box.min;
  passage.half_depth = 0.5 * size.x();
  passage.half_width = 0.5 * size.y();
  passage.height = size.z();
  return passage;
}

int floorSides(const Environment& environment, const Obstacles& obstacles, const Passage& passage,
               const CollideOptions& options) {
  return wayThrough(environment, passage, obstacles, options).floors;
}

std::optional<FreeWay> freeWay(const Environment& environment, const Obstacles& obstacles, const Passage& passage,
                               const CollideOptions& options) {
  const auto way = wayThrough(environment, passage, obstacles, options);
  const auto beside = tryWays(obstacles, passage, way, options.agent_radius_m).beside;
  if (!beside) return std::nullopt;
  const Vector3d down(0, 0, way.upper.height_m - options.agent_height_m);
  return FreeWay{way.from + *beside + down, way.to + *beside + down};
}

std::vector<std::int32_t> doorOf(const Environment& environment) {
  std::vector<std::int32_t> result(environment.products.size(), -1);
  for (std::size_t i = 0; i < result.size(); ++i) {
    auto at = static_cast<std::int32_t>(i);
    for (int depth = 0; depth < 32 && at >= 0; ++depth) {  // a file may make a ring of parts
      if (isDoor(environment.products[static_cast<std::size_t>(at)])) result[i] = at;
      at = environment.products[static_cast<std::size_t>(at)].whole;
    }
  }
  return result;
}

std::vector<bool> closedDoors(const Environment& environment, const CollideOptions& options) {
  const auto door_of = doorOf(environment);
  std::vector<bool> result(door_of.size(), false);
  const auto isSet = [&](std::size_t product) { return product < options.closed.size() && options.closed[product]; };
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (door_of[i] < 0) continue;
    const bool set = isSet(i) || isSet(static_cast<std::size_t>(door_of[i]));
    result[i] = options.doors == DoorState::closed || (options.doors == DoorState::as_set && set);
  }
  return result;
}

CollisionShape doorPlate(const Passage& passage, std::uint32_t product) {
  std::vector<Vector3d> bottom;
  for (const auto& [along, beside] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
    bottom.push_back(passage.middle + passage.through * (along * kPlate / 2) +
                     passage.across * (beside * passage.half_width));
  auto top = bottom;
  for (auto& p : top) p.z() += passage.height;
  return shapeOf(prism(bottom, top, CollisionShapeKind::box), product);
}

void closeWhatIsOpen(const Environment& environment, const CollideOptions& options, std::vector<CollisionShape>& shapes,
                     Report& report) {
  const auto closed = closedDoors(environment, options);
  const Obstacles obstacles(shapes);
  std::vector<CollisionShape> plates;
  for (const auto door : doorsOf(environment)) {
    const auto passage = closed[door] ? passageOf(environment, door) : std::nullopt;
    if (!passage || !freeWay(environment, obstacles, *passage, options)) continue;
    plates.push_back(doorPlate(*passage, door));
    report.note(environment.products[door].id, "has no closing leaf: blocked by a plate");
  }
  shapes.insert(shapes.end(), std::make_move_iterator(plates.begin()), std::make_move_iterator(plates.end()));
  std::stable_sort(shapes.begin(), shapes.end(), [](const auto& a, const auto& b) { return a.product < b.product; });
}

std::vector<Door> checkDoors(const Environment& environment, const std::vector<CollisionShape>& shapes,
                             const CollideOptions& options, Report& report) {
  const auto doors = doorsOf(environment);
  if (doors.empty()) return {};
  const auto closed = closedDoors(environment, options);
  const Obstacles obstacles(shapes);
  std::vector<Verdict> verdicts(doors.size());
  tbb::parallel_for(std::size_t{0}, doors.size(),
                    [&](std::size_t i) { verdicts[i] = judge(environment, doors[i], obstacles, options); });
  std::vector<Door> result;
  for (auto& verdict : verdicts) {
    verdict.door.closed = closed[verdict.door.product];
    reportDoor(environment, verdict, report);
    result.push_back(verdict.door);
  }
  return result;
}

}  // namespace standpoint
