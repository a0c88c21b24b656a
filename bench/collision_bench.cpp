// SPDX-License-Identifier: GPL-3.0-or-later
// What the collision shapes of real buildings are worth, judged by the models' own triangles and not by the code that
// made the shapes: one line for each file. build/release/bin/bench_collision FILE.ifc...
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <numeric>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/collision_soup.h"
#include "bench/door_ways.h"
#include "bench/room_flood.h"
#include "core/random.h"
#include "importers/importers.h"
#include "optimizer/surface/deviation.h"
#include "optimizer/surface/triangle_distance.h"
#include "optimizer/surface/triangle_tree.h"
#include "optimizer/walk/avatar.h"
#include "optimizer/walk/doors.h"
#include "optimizer/walk/obstacles.h"
#include "optimizer/walk/walkable.h"

namespace standpoint {
namespace {

using Eigen::Vector3d;

constexpr std::uint32_t kSweeps = 20'000;
constexpr std::uint32_t kSamples = 2000;  // of each product's surface
constexpr double kGrid = 0.05;            // m, of the walkable areas that are compared
const Body kWalker{0.30, 1.80};
const Body kBall{0.05, 0.10};

// What stops somebody when the doors stand open, as the model has it.
Soup rawTriangles(const Environment& environment) {
  const auto door_of = doorOf(environment);
  Soup soup;
  for (const auto& instance : environment.instances)
    if (environment.products[instance.product].inScene() && door_of[instance.product] < 0)
      soup.add(*environment.meshes[instance.mesh], instance.world_from_mesh, instance.product);
  return soup;
}

// Somewhere in the door a walker of this size passes between the model's own triangles; sills up to a step are stepped
// over.
bool passable(const Soup& raw, const TriangleTree& tree, const Passage& door) {
  const Vector3d reach = door.through * (door.half_depth + kWalker.radius_m);
  double level = door.middle.z();
  for (const double side : {-1.0, 1.0})
    level = std::max(level, floorUnder(raw, tree, door.middle + side * reach, 0.35, 0.35));
  const Body upper{kWalker.radius_m - 1e-3, kWalker.height_m - kStepHeight};
  for (int i = 0; i <= 40; ++i) {
    Vector3d middle = door.middle + door.across * ((i % 2 == 0 ? 0.01 : -0.01) * i);
    middle.z() = level + kStepHeight;
    if (!meets(raw, tree, upper, middle - reach, middle + reach)) return true;
  }
  return false;
}

struct DoorFigures {
  int doors = 0, truth = 0, kept = 0, added = 0, closed_passable = 0;
  int floored = 0, joined = 0,
      joined_raw = 0;  // of those passable in truth: with a floor, and that the surfaces lead through
  std::string lost, parted;
};

// `raw_walkable`: the surface that the model's own triangles have.
DoorFigures judgeDoors(const Environment& environment, const Soup& raw, const Mesh& raw_walkable,
                       const CollideResult& open, const CollideResult& closed) {
  const TriangleTree tree(raw.positions, raw.triangles);
  DoorFigures figures;
  Soup shut;  // by distances, not by the product's queries
  for (std::uint32_t i = 0; i < closed.shapes.size(); ++i)
    shut.add(closed.shapes[i].mesh, Eigen::Affine3d::Identity(), i);
  const TriangleTree shut_tree(shut.positions, shut.triangles);
  for (const auto& door : closed.doors)
    if (const auto passage = passageOf(environment, door.product))
      figures.closed_passable += door.passable || passable(shut, shut_tree, *passage);
  for (const auto& door : open.doors) {
    const auto passage = passageOf(environment, door.product);
    if (!passage) continue;
    ++figures.doors;
    const bool truth = passable(raw, tree, *passage);
    figures.truth += truth;
    figures.kept += truth && door.passable;
    figures.added += !truth && door.passable;
    if (truth && !door.passable) figures.lost += " " + environment.products[door.product].id;
    if (!truth || !hasFloor(raw, tree, *passage, kWalker.radius_m)) continue;
    ++figures.floored;
    const bool joined = leadsThrough(open.walkable, *passage, kWalker.radius_m),
               in_raw = leadsThrough(raw_walkable, *passage, kWalker.radius_m);
    figures.joined += joined;
    figures.joined_raw += in_raw;
    if (!joined) figures.parted += " " + environment.products[door.product].id + (in_raw ? "!" : "");
  }
  return figures;
}

// Sweeps from both sides through points of wall faces: each meets that face in truth, so none may pass the shapes.
struct Leaks {
  int ball = 0, walker = 0;
  int exact = 0;  // the same walkers and balls by distances between triangles instead of by the product's queries
};

Leaks sweepWalls(const Environment& environment, const Soup& raw, const CollideResult& result) {
  Leaks leaks;
  std::vector<Triangle> faces;
  for (std::size_t i = 0; i < raw.triangles.size(); ++i)
    if (environment.products[raw.owner[i]].ifc_class.starts_with("IfcWall")) faces.push_back(raw.triangles[i]);
  if (faces.empty()) return leaks;
  const Obstacles obstacles(result.shapes);
  Soup shapes;
  for (std::uint32_t i = 0; i < result.shapes.size(); ++i)
    shapes.add(result.shapes[i].mesh, Eigen::Affine3d::Identity(), i);
  const TriangleTree tree(shapes.positions, shapes.triangles);
  std::uint32_t number = 0;
  for (const auto& point : pointsByArea(raw.positions, faces, kSweeps / 2, {7, 0})) {
    const auto random = philox({11, 0}, number++, 0, 0);
    const auto& t = faces[point.triangle];
    const Vector3d normal =
        (raw.positions[t[1]] - raw.positions[t[0]]).cross(raw.positions[t[2]] - raw.positions[t[0]]).normalized();
    const auto pass = [&](const Body& body, int& count) {
      const Vector3d way = normal * (body.radius_m + 0.05 + 0.5 * uniform(random[0]));
      const double below = body.radius_m + uniform(random[1]) * (body.height_m - 2 * body.radius_m);
      const Vector3d feet = point.position - Vector3d(0, 0, below);
      if (obstacles.sweep(body, feet + way, feet - way)) return;
      ++count;
      if (!meets(shapes, tree, body, feet + way, feet - way)) ++leaks.exact;
    };
    pass(kBall, leaks.ball);
    pass(kWalker, leaks.walker);
  }
  return leaks;
}

bool inside(const CollisionShape& shape, const Vector3d& p, double tolerance) {
  if (shape.kind == CollisionShapeKind::mesh) return false;
  for (const auto& t : shape.mesh.triangles) {
    const Vector3d a = shape.mesh.positions[t[0]].cast<double>();
    const Vector3d ab = shape.mesh.positions[t[1]].cast<double>() - a,
                   ac = shape.mesh.positions[t[2]].cast<double>() - a, normal = ab.cross(ac);
    if (normal.norm() < 1e-4 * std::max(ab.norm(), ac.norm())) continue;  // a sliver's normal is rounding
    if (normal.dot(p - a) > tolerance * normal.norm()) return false;
  }
  return true;
}

// How often the closed surface goes around p.
double winding(const Soup& soup, const std::vector<std::uint32_t>& triangles, const Vector3d& p) {
  double sum = 0;
  for (const auto i : triangles) {
    const auto t = soup.corners(i);
    const Vector3d a = t[0] - p, b = t[1] - p, c = t[2] - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4 * 3.14159265358979323846);
}

// The triangles of a soup by bodies: parted where an edge has not just two of them. A closed stringer and the open
// treads that end on it are bodies of their own, or the treads would take from what goes around a point in the
// stringer.
std::vector<std::vector<std::uint32_t>> bodiesOf(const Soup& soup) {
  using Point = std::array<double, 3>;
  std::map<std::pair<Point, Point>, std::vector<std::uint32_t>> edges;
  for (std::uint32_t i = 0; i < soup.triangles.size(); ++i) {
    const auto t = soup.corners(i);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d &a = t[k], &b = t[(k + 1) % 3];
      const Point p{a.x(), a.y(), a.z()}, q{b.x(), b.y(), b.z()};
      edges[{std::min(p, q), std::max(p, q)}].push_back(i);
    }
  }
  std::vector<std::uint32_t> joined(soup.triangles.size());
  std::iota(joined.begin(), joined.end(), 0U);
  const auto root = [&](std::uint32_t i) {
    while (joined[i] != i) i = joined[i] = joined[joined[i]];
    return i;
  };
  for (const auto& [edge, triangles] : edges)
    if (triangles.size() == 2) joined[root(triangles[0])] = root(triangles[1]);
  std::map<std::uint32_t, std::vector<std::uint32_t>> bodies;
  for (std::uint32_t i = 0; i < joined.size(); ++i) bodies[root(i)].push_back(i);
  std::vector<std::vector<std::uint32_t>> result;
  for (auto& [first, triangles] : bodies) result.push_back(std::move(triangles));
  return result;
}

// In a body, and in no cavity of one.
bool isInside(const Soup& soup, const std::vector<std::vector<std::uint32_t>>& bodies, const Vector3d& p) {
  double all = 0, most = 0, least = 0;
  for (const auto& body : bodies) {
    const double own = winding(soup, body, p);
    all += own;
    most = std::max(most, own);
    least = std::min(least, own);
  }
  return std::abs(all) > 0.5 || (most > 0.5 && least > -0.5);
}

struct Deviations {
  double outward = 0, inward = 0;  // m, the largest of any product
  std::string outward_id, inward_id;
  std::uint64_t overfull = 0,
                points = 0;  // points inside of convex shapes of walls, and those more than 10 mm out of the wall
};

void deviationOf(const std::string& id, bool wall, const Soup& raw, const std::vector<const CollisionShape*>& shapes,
                 Deviations& sum) {
  Soup made;
  for (std::uint32_t i = 0; i < shapes.size(); ++i) made.add(shapes[i]->mesh, Eigen::Affine3d::Identity(), i);
  const TriangleTree raw_tree(raw.positions, raw.triangles), made_tree(made.positions, made.triangles);
  const auto bodies = bodiesOf(raw);
  double outward = 0, inward = 0;
  for (const auto& point : pointsByArea(made.positions, made.triangles, kSamples, {3, 0})) {
    const auto own = made.owner[point.triangle];
    const bool covered = std::any_of(shapes.begin(), shapes.end(), [&](const auto* s) {
      return s != shapes[own] && inside(*s, point.position, 1e-4);
    });
    if (covered) continue;
    // Between pieces there may be a crack within the solid: only what is out of the model's surface is too much.
    if (const double off = std::sqrt(raw_tree.squaredDistance(point.position));
        off > outward && !isInside(raw, bodies, point.position))
      outward = off;
  }
  for (const auto& point : pointsByArea(raw.positions, raw.triangles, kSamples, {4, 0})) {
    const bool covered =
        std::any_of(shapes.begin(), shapes.end(), [&](const auto* s) { return inside(*s, point.position, 1e-4); });
    if (!covered) inward = std::max(inward, std::sqrt(made_tree.squaredDistance(point.position)));
  }
  if (outward > sum.outward) sum.outward = outward, sum.outward_id = id;
  if (inward > sum.inward) sum.inward = inward, sum.inward_id = id;
  if (!wall || raw.triangles.size() > 5000) return;
  for (std::uint32_t i = 0; i < 500; ++i) {  // a point within: on the way from a shape's corner to its middle
    const auto random = philox({5, 0}, i, 0, 0);
    const auto& shape = *shapes[i % shapes.size()];
    if (shape.kind == CollisionShapeKind::mesh) continue;
    const auto corner = [&](std::uint32_t r) {
      return shape.mesh.positions[r % shape.mesh.positions.size()].cast<double>();
    };
    const double u = uniform(random[3]), v = uniform(random[2] ^ random[1]);
    const Vector3d p = corner(random[0]) * u + (1 - u) * (corner(random[1]) * v + (1 - v) * corner(random[2]));
    ++sum.points;
    if (!isInside(raw, bodies, p) && raw_tree.squaredDistance(p) > 1e-4) ++sum.overfull;
  }
}

Deviations deviations(const Environment& environment, const CollideResult& result) {
  Deviations sum;
  std::map<std::uint32_t, std::vector<const CollisionShape*>> shapes;
  for (const auto& shape : result.shapes) shapes[shape.product].push_back(&shape);
  std::map<std::uint32_t, Soup> soups;
  for (const auto& instance : environment.instances)
    if (shapes.contains(instance.product))
      soups[instance.product].add(*environment.meshes[instance.mesh], instance.world_from_mesh, 0);
  for (const auto& [product, own] : shapes)
    deviationOf(environment.products[product].id, environment.products[product].ifc_class.starts_with("IfcWall"),
                soups.at(product), own, sum);
  return sum;
}

using Column = std::array<long long, 2>;

// Heights over each point of a grid.
std::map<Column, std::vector<double>> columns(const Mesh& mesh) {
  std::map<Column, std::vector<double>> result;
  for (const auto& t : mesh.triangles) {
    const Vector3d a = mesh.positions[t[0]].cast<double>(), b = mesh.positions[t[1]].cast<double>(),
                   c = mesh.positions[t[2]].cast<double>();
    const Vector3d low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    for (auto x = static_cast<long long>(std::ceil(low.x() / kGrid - 0.37));
         (static_cast<double>(x) + 0.37) * kGrid <= high.x(); ++x)
      for (auto y = static_cast<long long>(std::ceil(low.y() / kGrid - 0.61));
           (static_cast<double>(y) + 0.61) * kGrid <= high.y(); ++y) {
        const Vector3d p((static_cast<double>(x) + 0.37) * kGrid, (static_cast<double>(y) + 0.61) * kGrid, 0);
        const auto side = [&](const Vector3d& s, const Vector3d& e) {
          return (e.x() - s.x()) * (p.y() - s.y()) - (e.y() - s.y()) * (p.x() - s.x());
        };
        if (side(a, b) >= 0 && side(b, c) >= 0 && side(c, a) > 0)
          result[{x, y}].push_back(a.z());  // level rectangles, seen from above
      }
  }
  return result;
}

struct Floors {
  double area_m2 = 0, truth_m2 = 0, overlap = 0;
  double largest_gap_m = 0;  // the shapes' floor over the model's
  int points = 0, gaps = 0;  // on a grid of 0.1 m; of more than 20 mm
};

Mesh rawWalkable(const Soup& raw) {
  std::vector<CollisionShape> skins(1);
  skins[0].kind = CollisionShapeKind::mesh;
  for (const auto& p : raw.positions) skins[0].mesh.positions.push_back(p.cast<float>());
  skins[0].mesh.triangles = raw.triangles;
  skins[0].mesh.surface_of_triangle.assign(raw.triangles.size(), 0);
  Progress progress;
  auto truth = walkableSurface(skins, {}, {}, progress);
  return truth ? std::move(truth->mesh) : Mesh{};
}

Floors judgeFloors(const Soup& raw, const Mesh& raw_walkable, const CollideResult& result) {
  Floors floors;
  const auto here = columns(result.walkable), there = columns(raw_walkable);
  std::size_t ours = 0, theirs = 0, both = 0;
  for (const auto& [at, heights] : there) theirs += heights.size();
  for (const auto& [at, heights] : here) {
    ours += heights.size();
    const auto other = there.find(at);
    if (other == there.end()) continue;
    for (const double z : heights)
      both += std::any_of(other->second.begin(), other->second.end(), [&](double o) { return std::abs(o - z) < 0.1; });
  }
  floors.area_m2 = static_cast<double>(ours) * kGrid * kGrid;
  floors.truth_m2 = static_cast<double>(theirs) * kGrid * kGrid;
  floors.overlap = ours + theirs > both ? static_cast<double>(both) / static_cast<double>(ours + theirs - both) : 1;
  Soup made;
  for (std::uint32_t i = 0; i < result.shapes.size(); ++i)
    made.add(result.shapes[i].mesh, Eigen::Affine3d::Identity(), i);
  const TriangleTree raw_tree(raw.positions, raw.triangles), made_tree(made.positions, made.triangles);
  for (const auto& [at, heights] : here) {
    if (at[0] % 2 != 0 || at[1] % 2 != 0) continue;
    for (const double z : heights) {
      const Vector3d p((static_cast<double>(at[0]) + 0.37) * kGrid, (static_cast<double>(at[1]) + 0.61) * kGrid, z);
      const double floor = floorUnder(made, made_tree, p, 0.15, 0.4), model = floorUnder(raw, raw_tree, p, 0.15, 0.4);
      if (floor < -1e299) continue;  // beside a ledge, where a cell is wider than its floor
      ++floors.points;
      floors.gaps += floor - model > 0.020;
      floors.largest_gap_m = std::max(floors.largest_gap_m, floor - model);
    }
  }
  return floors;
}

// Of each wall, by its id, as the file's own lines say.
std::map<std::string, std::uint32_t> openingsOf(const std::string& file) {
  std::map<std::string, std::uint32_t> openings;
  std::ifstream in(file);
  const std::regex voids(R"(=\s*IFCRELVOIDSELEMENT\s*\(.*,\s*(#\d+)\s*,\s*#\d+\s*\)\s*;)");
  std::smatch found;
  for (std::string line; std::getline(in, line);)
    if (line.find("IFCRELVOIDSELEMENT") != std::string::npos && std::regex_search(line, found, voids))
      ++openings[found[1]];
  return openings;
}

struct Walk {
  int steps = 0, through = 0, floats = 0,
      starts = 0;  // what of the steps met the model's triangles, and ended over its floor
  double way_m = 0, climbed_m = 0;
};

// Walks at random from many places of the walkable surface, each step judged by the model's triangles.
Walk walkAtRandom(const Soup& raw, const CollideResult& result) {
  constexpr std::uint32_t kStarts = 40, kSteps = 1000;
  constexpr double kLet = 0.0105;  // m that the shapes may be off, and a little
  Walk walk;
  const Obstacles obstacles(result.shapes);
  const TriangleTree tree(raw.positions, raw.triangles);
  const auto& triangles = result.walkable.triangles;
  for (std::uint32_t start = 0; start < kStarts && !triangles.empty(); ++start) {
    const auto& t = triangles[triangles.size() * start / kStarts];
    Avatar avatar(obstacles, kWalker);
    const Vector3d place = (result.walkable.positions[t[0]] + result.walkable.positions[t[2]]).cast<double>() / 2;
    if (!avatar.stand(place, 0.5)) continue;
    ++walk.starts;
    double angle = 0, lowest = avatar.feet().z(), highest = lowest;
    for (std::uint32_t i = 0; i < kSteps; ++i) {
      const auto random = philox({13, 0}, start, i, 0);
      angle += i % 50 == 0 ? 6.28 * uniform(random[0]) : 0.4 * (uniform(random[0]) - 0.5);
      const Vector3d before = avatar.feet();
      avatar.walk(0.05 * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
      const Vector3d after = avatar.feet(), up(0, 0, kStepHeight);
      if ((after - before).head<2>().norm() < 0.005) angle += 6.28 * uniform(random[1]);
      ++walk.steps;
      walk.way_m += (after - before).norm();
      lowest = std::min(lowest, after.z()), highest = std::max(highest, after.z());
      const double level = std::max(before.z(), after.z());
      walk.through += meets(raw, tree, {kWalker.radius_m - kLet, kWalker.height_m - kStepHeight - kLet},
                            Vector3d(before.x(), before.y(), level) + up, Vector3d(after.x(), after.y(), level) + up);
      walk.floats += after.z() - floorUnder(raw, tree, after, 0.02, 0.5) > 0.020;
    }
    walk.climbed_m = std::max(walk.climbed_m, highest - lowest);
  }
  return walk;
}

// Whether a flood of the model's own triangles comes to the same.
void printRooms(const Environment& environment, const Soup& raw, const CollideResult& result) {
  const auto reached = std::count_if(result.rooms.begin(), result.rooms.end(), [](const Room& r) { return r.reached; });
  const auto flooded = floodRooms(environment, raw, kWalker);
  int same = 0;
  std::string rows;
  for (const auto& room : result.rooms) {
    const auto own =
        std::find_if(flooded.begin(), flooded.end(), [&](const FloodedRoom& f) { return f.product == room.product; });
    if (own == flooded.end()) continue;
    const bool truth = own->mainland_m2 + own->entered_m2 > 0.05;
    same += truth == room.reached;
    if (truth && room.reached) continue;
    const auto& product = environment.products[room.product];
    rows += fmt::format(
        "    room {} {}: {}, {:.1f} m2; flood: {}, {:.1f} m2, {:.1f} with most rooms, {:.1f} from an entrance, with {} "
        "other rooms\n",
        product.id, product.name, room.reached ? "reached" : "unreached", room.walkable_m2,
        truth ? "reached" : "unreached", own->area_m2, own->mainland_m2, own->entered_m2, own->others);
  }
  fmt::print("  rooms: {} of {} reached, the flood agrees on {}\n{}", reached, result.rooms.size(), same, rows);
}

void printPieces(const std::string& file, const Environment& environment, const CollideResult& result) {
  auto openings = openingsOf(file);
  std::vector<std::uint32_t> walls;
  int over = 0;
  for (std::uint32_t i = 0; i < result.products.size(); ++i) {
    if (result.products[i].shapes == 0 || !environment.products[i].ifc_class.starts_with("IfcWall")) continue;
    walls.push_back(result.products[i].shapes);
    over += result.products[i].shapes > 2 + 3 * openings[environment.products[i].id];
  }
  std::map<std::string, std::set<std::uint32_t>> fell_back;
  for (const auto& shape : result.shapes)
    if (shape.kind == CollisionShapeKind::mesh)
      fell_back[environment.products[shape.product].ifc_class].insert(shape.product);
  std::sort(walls.begin(), walls.end());
  if (!walls.empty())
    fmt::print("  pieces per wall: median {}, most {}, {} of {} walls over 2 + 3 x openings\n",
               walls[(walls.size() - 1) / 2], walls.back(), over, walls.size());
  for (const auto& [ifc_class, products] : fell_back)
    fmt::print("  stays triangles: {} {}\n", products.size(), ifc_class);
}

int judge(const std::string& file) {
  Progress progress;
  const auto model = importFile(file, {}, progress);
  if (!model) return fmt::print("{}: {}\n", file, describe(model.error())), 1;
  const auto& environment = model->environment;
  const auto start = std::chrono::steady_clock::now();
  const auto result = collide(environment, {}, progress);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!result) return fmt::print("{}: {}\n", file, describe(result.error())), 1;
  CollideOptions shut;
  shut.doors = DoorState::closed;
  const auto closed = collide(environment, shut, progress);
  if (!closed) return fmt::print("{}: {}\n", file, describe(closed.error())), 1;
  const Soup raw = rawTriangles(environment);
  fmt::print("{}\n  {} shapes in {:.2f} s\n", std::filesystem::path(file).stem().string(), result->shapes.size(),
             seconds);
  const Mesh raw_walkable = rawWalkable(raw);
  const auto doors = judgeDoors(environment, raw, raw_walkable, *result, *closed);
  fmt::print("  doors: {} of {} that are passable in truth ({} more of {}), {} when closed{}{}\n", doors.kept,
             doors.truth, doors.added, doors.doors, doors.closed_passable,
             doors.lost.empty() ? "" : ", lost:", doors.lost);
  fmt::print(
      "  ways: the surface leads through {} of {} that are passable and have a floor in truth, that of the raw "
      "triangles through {}{}{}\n",
      doors.joined, doors.floored, doors.joined_raw, doors.parted.empty() ? "" : ", parted:", doors.parted);
  const auto leaks = sweepWalls(environment, raw, *result);
  fmt::print("  leaks: ball {}, walker {} of {} each, {} of them confirmed by distances\n", leaks.ball, leaks.walker,
             kSweeps / 2, leaks.exact);
  printPieces(file, environment, *result);
  printRooms(environment, raw, *result);
  const auto off = deviations(environment, *result);
  fmt::print("  deviation: outward {:.1f} mm ({}), inward {:.1f} mm ({}), overfill {} of {} points in walls\n",
             off.outward * 1000, off.outward_id, off.inward * 1000, off.inward_id, off.overfull, off.points);
  const auto floors = judgeFloors(raw, raw_walkable, *result);
  fmt::print(
      "  walkable: {:.1f} m2 of {:.1f} m2, overlap {:.2f} %, gap at most {:.1f} mm, over 20 mm at {} of {} points\n",
      floors.area_m2, floors.truth_m2, floors.overlap * 100, floors.largest_gap_m * 1000, floors.gaps, floors.points);
  const auto walk = walkAtRandom(raw, *result);
  fmt::print("  walk: {} steps, {:.0f} m from {} places, {} through something, {} over the floor, climbed {:.1f} m\n",
             walk.steps, walk.way_m, walk.starts, walk.through, walk.floats, walk.climbed_m);
  std::fflush(stdout);
  return 0;
}

}  // namespace
}  // namespace standpoint

int main(int count, char** arguments) {
  int wrong = 0;
  for (int i = 1; i < count; ++i) wrong += standpoint::judge(arguments[i]);
  return wrong == 0 ? 0 : 1;
}
