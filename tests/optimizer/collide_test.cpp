// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "core/random.h"
#include "optimizer/optimizer.h"
#include "optimizer/walk/obstacles.h"
#include "tests/optimizer/models.h"

namespace standpoint {
namespace {

using Eigen::Affine3d;
using Eigen::AngleAxisd;
using Eigen::Translation3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

CollideResult collided(const Environment& environment, const CollideOptions& options = {}) {
  Progress progress;
  auto result = collide(environment, options, progress);
  EXPECT_TRUE(result) << describe(result.error());
  EXPECT_EQ(result->products.size(), environment.products.size());
  for (const auto& shape : result->shapes) EXPECT_EQ(validate(shape.mesh, 1), "");
  return std::move(*result);
}

std::string describe(const Door& door) {
  return std::to_string(door.product) + (door.floor ? "f" : "-") + (door.passable ? "p" : "-") +
         std::to_string(door.clear_width_m);
}

Affine3d at(double x, double y, double z) { return Affine3d(Translation3d(x, y, z)); }

// A wall under a roof line in the xz plane, with rectangular holes, pushed along y: cells between all x and z of
// corners and holes, each with the faces that no other solid cell covers, so that no triangulator is needed and it is
// closed.
Mesh extruded(const std::vector<Vector2d>& roof, const std::vector<std::array<double, 4>>& holes, double depth) {
  std::vector<double> xs, zs{0};
  for (const auto& p : roof) xs.push_back(p.x());
  for (const auto& h : holes) {
    xs.insert(xs.end(), {h[0], h[2]});
    zs.insert(zs.end(), {h[1], h[3]});
  }
  for (auto* values : {&xs, &zs}) {
    std::sort(values->begin(), values->end());
    values->erase(std::unique(values->begin(), values->end()), values->end());
  }
  const int columns = static_cast<int>(xs.size()) - 1, rows = static_cast<int>(zs.size());
  const auto height = [&](int row, double x) {
    if (row < rows) return zs[static_cast<std::size_t>(row)];
    std::size_t i = 0;
    while (x > roof[i + 1].x()) ++i;
    return roof[i].y() + (roof[i + 1].y() - roof[i].y()) * (x - roof[i].x()) / (roof[i + 1].x() - roof[i].x());
  };
  const auto solid = [&](int i, int j) {
    if (i < 0 || i >= columns || j < 0 || j >= rows) return false;
    const double x = 0.5 * (xs[i] + xs[i + 1]), z = 0.5 * (height(j, x) + height(j + 1, x));
    return std::none_of(holes.begin(), holes.end(),
                        [&](const auto& h) { return h[0] < x && x < h[2] && h[1] < z && z < h[3]; });
  };
  Mesh mesh;
  const auto quad = [&](const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const auto* p : {&a, &b, &c, &d}) mesh.positions.emplace_back(p->cast<float>());
    mesh.triangles.insert(mesh.triangles.end(), {{first, first + 1, first + 2}, {first, first + 2, first + 3}});
    mesh.surface_of_triangle.insert(mesh.surface_of_triangle.end(), {0, 0});
  };
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      if (!solid(i, j)) continue;
      const double x0 = xs[i], x1 = xs[i + 1];
      const Vector3d a(x0, 0, height(j, x0)), b(x1, 0, height(j, x1)), c(x1, 0, height(j + 1, x1)),
          d(x0, 0, height(j + 1, x0)), y(0, depth, 0);
      quad(a, b, c, d);
      quad(d + y, c + y, b + y, a + y);
      if (!solid(i, j + 1)) quad(d, c, c + y, d + y);
      if (!solid(i, j - 1)) quad(b, a, a + y, b + y);
      if (!solid(i - 1, j)) quad(a, d, d + y, a + y);
      if (!solid(i + 1, j)) quad(c, b, b + y, c + y);
    }
  return mesh;
}

// Of the points of a grid over the box, how much volume lies in any of the shapes, which may lie over each other.
double coveredVolume(const std::vector<CollisionShape>& shapes, const Vector3d& low, const Vector3d& high, int n) {
  const auto isIn = [](const CollisionShape& shape, const Vector3d& p) {
    return std::all_of(shape.mesh.triangles.begin(), shape.mesh.triangles.end(), [&](const Triangle& t) {
      const Vector3d a = shape.mesh.positions[t[0]].cast<double>(), b = shape.mesh.positions[t[1]].cast<double>(),
                     c = shape.mesh.positions[t[2]].cast<double>();
      const Vector3d normal = (b - a).cross(c - a);
      return normal.norm() < 1e-4 * (b - a).norm() || normal.dot(p - a) <= 0;  // a sliver's normal is rounding
    });
  };
  int inside = 0;
  for (int i = 0; i < n * n; ++i) {
    const Vector3d fraction((i % n + 0.5) / n, 0.5, (i / n + 0.5) / n);
    const Vector3d p = low + fraction.cwiseProduct(high - low);
    inside += std::any_of(shapes.begin(), shapes.end(), [&](const auto& shape) { return isIn(shape, p); });
  }
  return (high - low).prod() * inside / (n * n);
}

// A wall along x with a doorway of 0.9 x 2.1 m in its middle.
Mesh wallWithDoorway(double length, double height = 2.8, double thickness = 0.2) {
  const double x = length / 2;
  return extruded({{0, height}, {length, height}}, {{x - 0.45, 0, x + 0.45, 2.1}}, thickness);
}

// Two rooms of 4 x 5 m side by side, a door between them.
Environment twoRooms(bool doorway, bool floor_behind = true) {
  Environment e;
  models::add(e, models::box({4.1, 5, 0.2}, 1), "IfcSlab", at(0, 0, -0.2));
  if (floor_behind) models::add(e, models::box({4.1, 5, 0.2}, 1), "IfcSlab", at(4.1, 0, -0.2));
  models::add(e, models::box({8.2, 0.2, 2.8}, 1), "IfcWall", at(0, -0.2, 0));
  models::add(e, models::box({8.2, 0.2, 2.8}, 1), "IfcWall", at(0, 5, 0));
  models::add(e, models::box({0.2, 5.4, 2.8}, 1), "IfcWall", at(-0.2, -0.2, 0));
  models::add(e, models::box({0.2, 5.4, 2.8}, 1), "IfcWall", at(8.2, -0.2, 0));
  const Affine3d middle = Translation3d(4.2, 0, 0) * AngleAxisd(EIGEN_PI / 2, Vector3d::UnitZ());
  models::add(e, doorway ? wallWithDoorway(5) : models::box({5, 0.2, 2.8}, 1), "IfcWall", middle);
  models::add(e, models::box({0.06, 0.9, 2.1}, 1), "IfcDoor", at(4.07, 2.05, 0));
  return e;
}

TEST(Wall, WithADoorwayBecomesThreeBoxesAndKeepsItsVolume) {
  Environment e;
  const auto wall = wallWithDoorway(5);
  models::add(e, wall, "IfcWall", Translation3d(30, 20, 3) * Affine3d(AngleAxisd(0.4, Vector3d::UnitZ())));
  const auto result = collided(e);
  ASSERT_EQ(result.shapes.size(), 3);
  double sum = 0;
  for (const auto& shape : result.shapes) {
    EXPECT_EQ(shape.kind, CollisionShapeKind::box);
    EXPECT_TRUE(isClosed(shape.mesh));
    sum += volume(shape.mesh);
  }
  EXPECT_NEAR(sum, 0.2 * (5 * 2.8 - 0.9 * 2.1), 1e-3);
  EXPECT_LT(result.products[0].max_deviation_m, 1e-3);
}

TEST(Wall, WithAGableAndWindowsBecomesFewConvexPieces) {
  Environment e;
  models::add(e, extruded({{0, 3}, {4, 6}, {8, 3}}, {{1, 1, 2, 2.2}, {5, 1, 6.2, 2.2}}, 0.3), "IfcWall");
  const auto result = collided(e);
  EXPECT_LE(result.shapes.size(), 5);  // left, right and between the windows, below and above them: less cannot be
  for (const auto& shape : result.shapes) {
    EXPECT_NE(shape.kind, CollisionShapeKind::mesh);
    EXPECT_GT(volume(shape.mesh), 0);
  }
  EXPECT_NEAR(coveredVolume(result.shapes, {0, 0, 0}, {8, 0.3, 6}, 400), 0.3 * (8 * 3 + 8 * 3 / 2.0 - 1.2 - 1.2 * 1.2),
              3e-2);
  EXPECT_LT(result.products[0].max_deviation_m, 2e-3);
}

TEST(Wall, WithManyWindowsIsCoveredByPillarsAndStrips) {
  Environment e;
  std::vector<std::array<double, 4>> windows;
  for (int i = 0; i < 5; ++i) windows.push_back({1.0 + 2 * i, 0.9, 2.0 + 2 * i, 2.1});
  models::add(e, extruded({{0, 2.8}, {11, 2.8}}, windows, 0.3), "IfcWall");
  EXPECT_EQ(collided(e).shapes.size(), 6 + 2);  // pillars, and what runs below and above the windows
}

// A gable with a round window of 60 sides, its ends square or mitred. A circle of 0.6 m that is left by 9 mm at most to
// either side needs 13 sides, each of which is a piece's own.
TEST(Wall, WithARoundWindowUnderAGableHasAPieceForEachSideThatTheWindowNeeds) {
  const int sides = 60;
  for (const double mitre : {0.0, 0.3}) {
    Mesh wall;
    const auto add = [&](double x, double y, double z) {
      wall.positions.push_back(Vector3d(x, y, z).cast<float>());
      return static_cast<std::uint32_t>(wall.positions.size() - 1);
    };
    const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
      wall.triangles.insert(wall.triangles.end(), {{a, b, c}, {a, c, d}});
    };
    // A ring between the window and as many points of the outline, in front (y = 0) and behind.
    const Vector2d middle(4, 3), corners[] = {{8, 3}, {4, 6}, {0, 3}, {0, 0}, {8, 0}};
    std::vector<std::array<std::uint32_t, 4>> ring;
    for (int i = 0; i < sides; ++i) {
      const double angle = 6.283185307179586 * i / sides, side = 5.0 * i / sides;
      const auto corner = static_cast<std::size_t>(side);
      const Vector2d rim =
          corners[corner] + (corners[(corner + 1) % 5] - corners[corner]) * (side - static_cast<double>(corner));
      const double x = 4 + (rim.x() - 4) * (4 - mitre) / 4,
                   z = rim.y() > 2.999 ? 3 + 0.75 * std::min(x, 8 - x) : rim.y();
      const Vector2d hole = middle + 0.6 * Vector2d(std::cos(angle), std::sin(angle));
      ring.push_back(
          {add(hole.x(), 0, hole.y()), add(rim.x(), 0, rim.y()), add(x, 0.3, z), add(hole.x(), 0.3, hole.y())});
    }
    for (int i = 0; i < sides; ++i) {
      const auto &a = ring[static_cast<std::size_t>(i)], &b = ring[static_cast<std::size_t>((i + 1) % sides)];
      for (std::size_t k = 0; k < 4; ++k) quad(a[k], a[(k + 1) % 4], b[(k + 1) % 4], b[k]);
    }
    wall.surface_of_triangle.assign(wall.triangles.size(), 0);
    Environment e;
    models::add(e, wall, "IfcWall");
    const auto result = collided(e);
    EXPECT_LE(result.shapes.size(), 16) << mitre;
    EXPECT_LE(result.products[0].max_deviation_m, 0.010);
    for (const auto& shape : result.shapes) EXPECT_NE(shape.kind, CollisionShapeKind::mesh);
    EXPECT_NEAR(coveredVolume(result.shapes, {0, 0, 0}, {8, 0.3, 6}, 400) / volume(wall), 1, 0.005) << mitre;
  }
}

// The box with its ends cut to 45 degrees, under a gable: oblique in three directions, prismatic in none.
TEST(Wall, WithMitredEndsUnderAGableIsOnePiece) {
  Mesh wall = extruded({{0, 3}, {4, 6}, {8, 3}}, {}, 0.3);
  for (auto& p : wall.positions)
    if (p.y() > 0.1F) p.x() += p.x() < 0.1F ? 0.3F : p.x() > 7.9F ? -0.3F : 0;
  Environment e;
  models::add(e, wall, "IfcWall");
  const auto result = collided(e);
  ASSERT_LE(result.shapes.size(), 2);
  double sum = 0;
  for (const auto& shape : result.shapes) {
    EXPECT_EQ(shape.kind, CollisionShapeKind::convex);
    sum += volume(shape.mesh);
  }
  EXPECT_NEAR(sum / volume(wall), 1, 0.01);
}

TEST(Wall, WithMitredEndsAndADoorwayStaysOpenWithinAMillimetre) {
  Mesh wall = extruded({{0, 3}, {4, 6}, {8, 3}}, {{1, 0, 2, 2.1}, {5, 1, 6, 2}}, 0.3);
  for (auto& p : wall.positions)
    if (p.y() > 0.1F) p.x() += p.x() < 0.1F ? 0.3F : p.x() > 7.9F ? -0.3F : 0;
  Environment e;
  models::add(e, wall, "IfcWall");
  const auto result = collided(e);
  EXPECT_LE(result.shapes.size(), 2 + 3 * 2);
  const Obstacles obstacles(result.shapes);
  EXPECT_FALSE(obstacles.sweep({0.499, 2.099}, {1.5, -1, 0.0005}, {1.5, 1, 0.0005}));
  EXPECT_TRUE(obstacles.sweep({0.501, 2.099}, {1.5, -1, 0.0005}, {1.5, 1, 0.0005}));
  EXPECT_TRUE(obstacles.sweep({0.499, 2.101}, {1.5, -1, 0.0005}, {1.5, 1, 0.0005}));
  EXPECT_FALSE(obstacles.sweep({0.499, 0.998}, {5.5, -1, 1.001}, {5.5, 1, 1.001}));
  for (const auto& shape : result.shapes) EXPECT_NE(shape.kind, CollisionShapeKind::mesh);
}

TEST(Slab, WithAStairwellIsOpenThere) {
  Mesh slab = extruded({{0, 5}, {8, 5}}, {{2, 1, 4.5, 3.6}}, 0.2);  // lies in the xz plane
  Environment e;
  models::add(e, slab, "IfcSlab",
              Affine3d(AngleAxisd(0.3, Vector3d::UnitZ()) * AngleAxisd(-1.5707963267948966, Vector3d::UnitX())));
  const auto result = collided(e);
  EXPECT_LE(result.shapes.size(), 4);
  const Obstacles obstacles(result.shapes);
  const auto falls = [&](double x, double y) {
    const Vector3d top = AngleAxisd(0.3, Vector3d::UnitZ()) * Vector3d(x, y, 1);
    return !obstacles.sweep({0.3, 1.8}, top, top - Vector3d(0, 0, 4));
  };
  EXPECT_TRUE(falls(3.2, 2.3));
  EXPECT_FALSE(falls(2.2, 2.3));
  EXPECT_FALSE(falls(6, 2));
}

TEST(RoundThings, AreConvexPiecesWithinACentimetre) {
  Environment e;
  models::add(e, models::cylinder(0.3, 3, 24, 6), "IfcColumn");
  models::add(e, models::torus(2, 0.4, 24, 12), "", at(10, 0, 0));
  const auto result = collided(e);
  EXPECT_EQ(result.products[0].shapes, 1);
  EXPECT_NEAR(volume(result.shapes[0].mesh) / volume(*e.meshes[0]), 1, 1e-4);
  Mesh all;
  for (const auto& shape : result.shapes) {
    EXPECT_EQ(shape.kind, CollisionShapeKind::convex);
    if (shape.product == 1) models::append(all, shape.mesh);
  }
  Mesh placed;
  models::append(placed, *e.meshes[1], at(10, 0, 0));
  EXPECT_LT(models::farthest(placed, all, 2000), 0.010);
}

TEST(Pane, IsAPlateOfAMillimetreOnItsOwnOrOnAFrame) {
  Environment e;
  Mesh pane;
  for (const auto& p : {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(1, 0, 2), Vector3d(0, 0, 2)})
    pane.positions.push_back(p.cast<float>());
  pane.triangles = {{0, 1, 2}, {0, 2, 3}};
  pane.surface_of_triangle = {0, 0};
  models::add(e, pane, "IfcPlate");
  const auto result = collided(e);
  ASSERT_EQ(result.shapes.size(), 1);
  EXPECT_EQ(result.shapes[0].kind, CollisionShapeKind::box);
  EXPECT_NEAR(volume(result.shapes[0].mesh), 1 * 2 * 0.001, 1e-5);
}

TEST(Bowl, IsItsTrianglesAndNamedInTheReport) {
  Environment e;
  Mesh bowl = models::sphere(0.5, 16, 24);
  std::erase_if(bowl.triangles, [&](const Triangle& t) { return bowl.positions[t[0]].z() > 0.2F; });
  bowl.surface_of_triangle.assign(bowl.triangles.size(), 0);
  models::add(e, bowl, "IfcFurniture");
  const auto result = collided(e);
  ASSERT_EQ(result.shapes.size(), 1);
  EXPECT_EQ(result.shapes[0].kind, CollisionShapeKind::mesh);
  EXPECT_THAT(result.report.issues, testing::Contains(testing::Field(&Issue::source, "#1")));
}

TEST(Door, BetweenTwoRoomsIsPassableAndJoinsThem) {
  const auto result = collided(twoRooms(true));
  ASSERT_EQ(result.doors.size(), 1);
  EXPECT_TRUE(result.doors[0].floor);
  EXPECT_TRUE(result.doors[0].passable);
  // The agent's axis keeps its radius from the walls: two rooms of (4 - 0.6) x (5 - 0.6) m, and the doorway's strip.
  const double rooms = 2 * 3.4 * 4.4, doorway = (0.2 + 0.6) * (0.9 - 0.6);
  EXPECT_NEAR(result.walkable_area_m2, rooms + doorway, 2 * (2 * (3.4 + 4.4)) * 0.06);
  EXPECT_NEAR(area(result.walkable), result.walkable_area_m2, 1e-3 * result.walkable_area_m2);
  EXPECT_EQ(validate(result.walkable, 1), "");
  for (const auto& shape : result.shapes) EXPECT_NE(shape.product, 7);  // the door stands open
}

TEST(Door, InAWallWithoutADoorwayIsBlocked) {
  const auto result = collided(twoRooms(false));
  ASSERT_EQ(result.doors.size(), 1);
  EXPECT_FALSE(result.doors[0].passable);
  EXPECT_TRUE(result.doors[0].floor);
  EXPECT_THAT(result.report.issues,
              testing::Contains(testing::Field(&Issue::message, testing::HasSubstr("blocked by IfcWall #7"))));
}

TEST(Door, IsTooNarrowForAWideAgent) {
  EXPECT_TRUE(collided(twoRooms(true), {0.44, 1.8}).doors[0].passable);
  EXPECT_FALSE(collided(twoRooms(true), {0.46, 1.8}).doors[0].passable);
  EXPECT_TRUE(collided(twoRooms(true), {0.3, 2.05}).doors[0].passable);
  EXPECT_FALSE(collided(twoRooms(true), {0.3, 2.15}).doors[0].passable);
}

TEST(Door, WithoutAFloorBehindItIsReported) {
  const auto result = collided(twoRooms(true, false));
  ASSERT_EQ(result.doors.size(), 1);
  EXPECT_FALSE(result.doors[0].floor);
  EXPECT_THAT(result.report.issues, testing::Contains(testing::Field(&Issue::message, testing::HasSubstr("no floor"))));
}

// Three rooms of 4 x 4 m in a row, with spaces: a doorway of 0.9 m from the first into the second, one of 0.5 m from
// the first onto a terrace, one of 0.9 m from the second into the air, and none into the third.
Environment threeRooms() {
  Environment e;
  models::add(e, models::box({12.6, 4.4, 0.2}, 1), "IfcSlab", at(-0.2, -0.2, -0.2));
  models::add(e, models::box({4, 3, 0.2}, 1), "IfcSlab", at(0, -3.2, -0.2));
  models::add(e, extruded({{0, 2.8}, {12.6, 2.8}}, {{1.95, 0, 2.45, 2.1}, {6.05, 0, 6.95, 2.1}}, 0.2), "IfcWall",
              at(-0.2, -0.2, 0));
  models::add(e, models::box({12.6, 0.2, 2.8}, 1), "IfcWall", at(-0.2, 4, 0));
  for (const double x : {-0.2, 8.1, 12.2}) models::add(e, models::box({0.2, 4, 2.8}, 1), "IfcWall", at(x, 0, 0));
  const Affine3d across = at(4.1, 0, 0) * AngleAxisd(1.5707963267948966, Vector3d::UnitZ());
  models::add(e, extruded({{0, 2.8}, {4, 2.8}}, {{1.55, 0, 2.45, 2.1}}, 0.1), "IfcWall", across);
  models::add(e, models::box({0.06, 0.9, 2.1}, 1), "IfcDoor", at(4.02, 1.55, 0));   // #9: into the second room
  models::add(e, models::box({0.5, 0.06, 2.1}, 1), "IfcDoor", at(1.75, -0.13, 0));  // #10: narrow
  models::add(e, models::box({0.9, 0.06, 2.1}, 1), "IfcDoor", at(5.85, -0.13, 0));  // #11: above nothing
  for (const double x : {0.0, 4.1, 8.3}) {
    models::add(e, models::box({3.9, 4, 2.8}, 1), "IfcSpace", at(x, 0, 0));
    e.products.back().tangible = false;
  }
  return e;
}

TEST(Rooms, ThatAreWalledInAreReported) {
  const auto result = collided(threeRooms());
  ASSERT_EQ(result.rooms.size(), 3);
  EXPECT_TRUE(result.rooms[0].reached);
  EXPECT_TRUE(result.rooms[1].reached);
  EXPECT_FALSE(result.rooms[2].reached);
  EXPECT_NEAR(result.rooms[2].walkable_m2, (12.2 - 8.3 - 0.6) * 3.4, 1);
  EXPECT_NEAR((result.rooms[2].position - Vector3d(10.25, 2, 0)).norm(), 0, 1e-5);
  const auto issue = [&](const char* source, const char* text) {
    return testing::Contains(testing::AllOf(testing::Field(&Issue::source, source),
                                            testing::Field(&Issue::message, testing::HasSubstr(text))));
  };
  EXPECT_THAT(result.report.issues, issue("#14", "cannot be reached"));
  EXPECT_THAT(result.report.issues, issue("#10", "0.50 m clear width"));
  EXPECT_THAT(result.report.issues, issue("#11", "no floor"));
  EXPECT_EQ(result.report.issues.size(), 3);
}

// Two rooms and a wall with a doorway between them, turned about the vertical; a space in each.
Environment narrowDoorway(double width, double step, double turn) {
  Environment e;
  models::add(e, models::box({3, 4, 0.2}, 1), "IfcSlab", at(0, 0, -0.2));
  models::add(e, models::box({3, 4, 0.2}, 1), "IfcSlab", at(3, 0, step - 0.2));
  const Affine3d across = at(3.1, 0, 0) * AngleAxisd(1.5707963267948966, Vector3d::UnitZ());
  models::add(e, extruded({{0, 2.8}, {4, 2.8}}, {{2 - width / 2, 0, 2 + width / 2, 2.1}}, 0.2), "IfcWall", across);
  models::add(e, models::box({0.06, width, 2.1}, 1), "IfcDoor", at(2.97, 2 - width / 2, 0));
  for (const double x : {0.0, 3.1}) {
    models::add(e, models::box({2.9, 4, 2.8}, 1), "IfcSpace", at(x, 0, 0));
    e.products.back().tangible = false;
  }
  for (auto& instance : e.instances)
    instance.world_from_mesh = AngleAxisd(turn, Vector3d::UnitZ()) * instance.world_from_mesh;
  return e;
}

TEST(Door, HardlyWiderThanTheAgentLeadsFromRoomToRoom) {
  for (const double width : {0.605, 0.62, 0.65, 0.7})
    for (const double turn : {0.0, 0.02, 0.3, 0.785, 1.2, 2.0}) {
      const auto result = collided(narrowDoorway(width, 0.1, turn));
      ASSERT_EQ(result.doors.size(), 1);
      EXPECT_TRUE(result.doors[0].passable && result.doors[0].floor && result.doors[0].led_through)
          << width << " " << turn;
      EXPECT_TRUE(result.rooms[0].reached && result.rooms[1].reached) << width << " " << turn;
      EXPECT_EQ(validate(result.walkable, 1), "");
      EXPECT_NEAR(area(result.walkable), result.walkable_area_m2, 1e-3 * result.walkable_area_m2);
    }
}

TEST(Door, AboveAStepThatNobodyClimbsIsNotLedThrough) {
  for (const double turn : {0.0, 0.3}) {
    const auto result = collided(narrowDoorway(0.9, 0.28, turn));
    EXPECT_TRUE(result.doors[0].passable && result.doors[0].floor);
    EXPECT_FALSE(result.doors[0].led_through);
    EXPECT_FALSE(result.rooms[0].reached && result.rooms[1].reached);
    EXPECT_THAT(result.report.issues, testing::Contains(testing::Field(
                                          &Issue::message, testing::HasSubstr("not connected by walkable surface"))));
  }
}

// A ground floor with an entrance, and above it a gallery and three rooms behind passable doors, to which nothing leads
// up: they are most of the rooms, and the gallery lies in the ground floor's space, which is as high as the house.
TEST(Rooms, AboveTheGroundAreNotReachedWithoutAStair) {
  Environment e;
  models::add(e, models::box({12.4, 6.4, 0.2}, 1), "IfcSlab", at(-0.2, -0.2, -0.2));
  models::add(e, extruded({{0, 6}, {12.4, 6}}, {{6, 0, 6.9, 2.1}}, 0.2), "IfcWall", at(-0.2, -0.2, 0));
  models::add(e, models::box({12.4, 0.2, 6}, 1), "IfcWall", at(-0.2, 6, 0));
  for (const double x : {-0.2, 12.0}) models::add(e, models::box({0.2, 6, 6}, 1), "IfcWall", at(x, 0, 0));
  models::add(e, models::box({12, 4, 0.2}, 1), "IfcSlab", at(0, 2, 2.8));  // whose first metre is the gallery
  models::add(e, extruded({{0, 3}, {12, 3}}, {{1.5, 0, 2.4, 2.1}, {5.5, 0, 6.4, 2.1}, {9.5, 0, 10.4, 2.1}}, 0.1),
              "IfcWall", at(0, 3, 3));
  for (const double x : {4.0, 8.0}) models::add(e, models::box({0.1, 2.9, 3}, 1), "IfcWall", at(x, 3.1, 3));
  models::add(e, models::box({0.9, 0.06, 2.1}, 1), "IfcDoor", at(5.8, -0.13, 0));
  for (const double x : {1.5, 5.5, 9.5}) models::add(e, models::box({0.9, 0.06, 2.1}, 1), "IfcDoor", at(x, 3.02, 3));
  Mesh hall = models::box({12, 6, 2.8}, 1);
  models::append(hall, models::box({12, 3, 3}, 1), at(0, 0, 2.9));
  models::add(e, hall, "IfcSpace");
  for (const double x : {0.0, 4.1, 8.1}) models::add(e, models::box({3.9, 2.9, 3}, 1), "IfcSpace", at(x, 3.1, 3));
  for (std::size_t i = e.products.size() - 4; i < e.products.size(); ++i) e.products[i].tangible = false;
  auto result = collided(e);
  ASSERT_EQ(result.rooms.size(), 4);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(result.rooms[i].reached, i == 0) << i;
    EXPECT_GT(result.rooms[i].walkable_m2, 5) << i;
  }
  for (int i = 0; i < 15; ++i)
    models::add(e, models::box({0.28, 1, 0.2 * (i + 1)}, 1), "IfcStair", at(1 + 0.28 * i, 1, 0));
  models::add(e, models::box({1.5, 1, 3}, 1), "IfcStair", at(1 + 0.28 * 15, 1, 0));
  result = collided(e);
  for (const auto& room : result.rooms) EXPECT_TRUE(room.reached) << room.product;
}

TEST(Door, TellsItsClearWidthAndPlace) {
  const auto result = collided(threeRooms());
  ASSERT_EQ(result.doors.size(), 3);
  EXPECT_TRUE(result.doors[0].passable);
  EXPECT_FALSE(result.doors[1].passable);
  EXPECT_TRUE(result.doors[2].passable);
  EXPECT_FALSE(result.doors[2].floor);
  EXPECT_TRUE(result.doors[0].floor && result.doors[1].floor);
  EXPECT_NEAR(result.doors[0].clear_width_m, 0.9, 0.01);
  EXPECT_NEAR(result.doors[1].clear_width_m, 0.5, 0.01);
  EXPECT_NEAR((result.doors[1].position - Vector3d(2, -0.1, 0)).norm(), 0, 1e-5);
}

TEST(Door, StandsClosedWhereItIsSet) {
  CollideOptions options;
  options.doors = DoorState::closed;
  auto result = collided(threeRooms(), options);
  for (const auto& door : result.doors) EXPECT_TRUE(door.closed && !door.passable) << door.product;
  EXPECT_EQ(std::count_if(result.shapes.begin(), result.shapes.end(),
                          [](const auto& s) { return s.product >= 8 && s.product <= 10; }),
            3);
  options.doors = DoorState::as_set;
  options.closed.assign(threeRooms().products.size(), false);
  options.closed[8] = true;
  result = collided(threeRooms(), options);
  EXPECT_FALSE(result.doors[0].passable);
  EXPECT_TRUE(result.doors[2].passable && !result.doors[2].closed);
  EXPECT_TRUE(result.rooms[0].reached != result.rooms[1].reached) << "the door between them is closed";
}

TEST(Door, WithoutALeafIsClosedByAPlate) {
  Environment e = twoRooms(true);
  Mesh frame = models::box({0.06, 0.02, 2.1}, 1);  // two posts beside a clear opening
  models::append(frame, models::box({0.06, 0.02, 2.1}, 1), at(0, 0.88, 0));
  e.meshes.back() = std::make_shared<const Mesh>(frame);
  EXPECT_TRUE(collided(e).doors[0].passable);
  CollideOptions options;
  options.doors = DoorState::closed;
  const auto result = collided(e, options);
  EXPECT_FALSE(result.doors[0].passable);
  EXPECT_THAT(result.report.issues,
              testing::Contains(testing::Field(&Issue::message, testing::HasSubstr("blocked by a plate"))));
}

TEST(Stair, OfSeventeenByTwentyEightCentimetresIsWalkable) {
  Environment e;
  const int steps = 16;
  models::add(e, models::box({3, 1.2, 0.2}, 1), "IfcSlab", at(-3, 0, -0.2));
  Mesh stair;
  for (int i = 0; i < steps; ++i)
    models::append(stair, models::box({0.28, 1.2, 0.17 * (i + 1)}, 1), at(0.28 * i, 0, 0));
  models::add(e, stair, "IfcStairFlight");
  models::add(e, models::box({3, 1.2, 0.2}, 1), "IfcSlab", at(0.28 * steps, 0, 0.17 * steps - 0.2));
  const auto result = collided(e);
  // One strip from the lower landing to the upper one, a radius and a cell away from its rim.
  const double length = 6 + 0.28 * steps;
  EXPECT_NEAR(result.walkable_area_m2, (length - 0.6) * 0.6, 0.15 * length * 0.6);
  for (int i = 1; i + 1 < steps; ++i) {  // something to stand on over each tread; the last is level with the landing
    bool found = false;
    for (const auto& t : result.walkable.triangles) {
      const Vector3d c =
          (result.walkable.positions[t[0]] + result.walkable.positions[t[1]] + result.walkable.positions[t[2]])
              .cast<double>() /
          3;
      found |= c.x() > 0.28 * i && c.x() < 0.28 * (i + 1) && std::abs(c.z() - 0.17 * (i + 1)) < 0.06;
    }
    EXPECT_TRUE(found) << "tread " << i;
  }
}

TEST(Stair, OfFortyCentimetreStepsIsNot) {
  Environment e;
  for (int i = 0; i < 6; ++i)
    models::add(e, models::box({0.28, 1.2, 0.4 * (i + 1)}, 1), "IfcStairFlight", at(0.28 * i, 0, 0));
  EXPECT_EQ(collided(e).walkable_area_m2, 0);
}

TEST(Walkability, LeavesOutWhatIsLowAndWhatIsNotThere) {
  Environment e;
  models::add(e, models::box({4, 4, 0.2}, 1), "IfcSlab", at(0, 0, -0.2));
  models::add(e, models::box({4, 4, 0.2}, 1), "IfcSlab", at(0, 0, 1.5));  // too low to stand under
  models::add(e, models::box({4, 4, 3}, 1), "IfcSpace", at(0, 0, 1.7));
  e.products[2].tangible = false;
  const auto result = collided(e);
  EXPECT_NEAR(result.walkable_area_m2, 3.4 * 3.4, 4 * 3.4 * 0.07);  // only on top
  EXPECT_EQ(result.products[2].shapes, 0);
}

TEST(Collision, GivesTheSameForAnyNumberOfThreads) {
  Environment e = threeRooms();
  models::add(e, models::torus(0.5, 0.2, 12, 6), "IfcFurniture", at(2, 2, 0.2));
  Mesh gable = extruded({{0, 3}, {4, 6}, {8, 3}}, {{1, 0, 2, 2.1}, {5, 1, 6, 2}}, 0.3);
  for (auto& p : gable.positions)
    if (p.y() > 0.1F) p.x() += p.x() < 0.1F ? 0.3F : p.x() > 7.9F ? -0.3F : 0;
  models::add(e, gable, "IfcWall", at(0, 10, 0));
  std::string first;
  for (const std::size_t threads : {1, 2, 8}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const auto result = collided(e);
    std::string now;
    for (const auto& shape : result.shapes)
      now.append(reinterpret_cast<const char*>(shape.mesh.positions.data()),
                 shape.mesh.positions.size() * sizeof(Eigen::Vector3f));
    now.append(reinterpret_cast<const char*>(result.walkable.positions.data()),
               result.walkable.positions.size() * sizeof(Eigen::Vector3f));
    for (const auto& door : result.doors) now += describe(door);
    for (const auto& room : result.rooms) now += std::to_string(room.walkable_m2) + (room.reached ? "r" : "-");
    if (first.empty()) first = now;
    EXPECT_TRUE(first == now) << threads << " threads";
  }
}

TEST(Collision, OfAHundredThousandLooseTrianglesIsThese) {
  Mesh loose;
  for (std::uint32_t i = 0; i < 100'000; ++i) {
    const auto r = philox({9, 0}, i, 0, 0);
    const Vector3d middle(20 * uniform(r[0]), 20 * uniform(r[1]), 3 * uniform(r[2]));
    for (const auto& d : {Vector3d(0, 0, 0), Vector3d(0.1, 0, 0), Vector3d(0, 0.1, 0.1)})
      loose.positions.push_back((middle + d).cast<float>());
    loose.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  loose.surface_of_triangle.assign(loose.triangles.size(), 0);
  Environment e;
  models::add(e, loose);
  const auto result = collided(e);
  ASSERT_EQ(result.shapes.size(), 1);
  EXPECT_EQ(result.shapes[0].kind, CollisionShapeKind::mesh);
  EXPECT_GE(result.products[0].triangles, 99'990);
}

TEST(Collision, OfAnInvertedWallIsThatOfTheWall) {
  Mesh inverted = extruded({{0, 3}, {4, 6}, {8, 3}}, {{1, 0, 2, 2.1}, {5, 1, 6, 2}}, 0.3);
  Environment right, wrong;
  models::add(right, inverted, "IfcWall");
  for (auto& t : inverted.triangles) std::swap(t[1], t[2]);
  models::add(wrong, inverted, "IfcWall");
  const auto a = collided(right), b = collided(wrong);
  for (const auto& shape : b.shapes) {
    EXPECT_NE(shape.kind, CollisionShapeKind::mesh);
    EXPECT_GT(volume(shape.mesh), 0);
  }
  EXPECT_EQ(a.shapes.size(), b.shapes.size());
  EXPECT_NEAR(coveredVolume(b.shapes, {0, 0, 0}, {8, 0.3, 6}, 400), -volume(inverted), 3e-2);
}

TEST(Collision, OfWhatIsNotANumberIsRefusedWithItsPlace) {
  Environment e = twoRooms(true);
  Mesh bad = models::box({1, 1, 1}, 1);
  bad.positions[3].y() = std::nanf("");
  models::add(e, bad, "IfcWall");
  Progress progress;
  const auto result = collide(e, {}, progress);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::unusable);
}

TEST(Collision, OfWhatIsOutOfReachIsRefusedWithItsName) {
  Environment e = twoRooms(true);
  models::add(e, models::box({1e30, 1, 1}, 1), "IfcWall");
  Progress progress;
  const auto result = collide(e, {}, progress);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::unusable);
  EXPECT_THAT(result.error().message, testing::HasSubstr("#9"));
}

// A screw thread of thin turns: many planes, none of them worth a cut.
TEST(Collision, OfARichShapeEndsSoon) {
  Mesh spiral;
  const int turns = 40, segments = 24;
  for (int i = 0; i <= turns * segments; ++i) {
    const double angle = 6.283185307 * i / segments, z = 0.05 * i / segments;
    for (const auto& [radius, height] : {std::pair(0.5, 0.0), {0.8, 0.0}, {0.8, 0.02}, {0.5, 0.02}})
      spiral.positions.push_back(
          Vector3d(radius * std::cos(angle), radius * std::sin(angle), z + height).cast<float>());
  }
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    spiral.triangles.insert(spiral.triangles.end(), {{a, b, c}, {a, c, d}});
  };
  quad(3, 2, 1, 0);
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(turns * segments); ++i)
    for (std::uint32_t k = 0; k < 4; ++k) quad(4 * i + k, 4 * i + (k + 1) % 4, 4 * i + 4 + (k + 1) % 4, 4 * i + 4 + k);
  const std::uint32_t last = 4U * turns * segments;
  quad(last, last + 1, last + 2, last + 3);
  spiral.surface_of_triangle.assign(spiral.triangles.size(), 0);
  Environment e;
  models::add(e, spiral);
  const auto result = collided(e);
  ASSERT_EQ(result.shapes.size(), 1);
  EXPECT_EQ(result.shapes[0].kind, CollisionShapeKind::mesh);
}

TEST(Collision, SurvivesEmptyFlatAndMirroredInput) {
  EXPECT_EQ(collided(Environment{}).walkable_area_m2, 0);
  Environment e;
  models::add(e, Mesh{});
  models::add(e, models::plateWithHole(4, 3, 1, 0.5));
  models::add(e, Mesh{}, "IfcDoor");
  Affine3d mirror = Affine3d::Identity();
  mirror.linear()(0, 0) = -1;
  models::add(e, wallWithDoorway(3), "IfcWall", mirror);
  const auto result = collided(e);
  EXPECT_EQ(result.doors.size(), 1);
  EXPECT_THAT(result.report.issues,
              testing::Contains(testing::Field(&Issue::message, testing::HasSubstr("no geometry"))));
  for (const auto& shape : result.shapes) EXPECT_TRUE(shape.product != 3 || volume(shape.mesh) > 0);
}

TEST(Collision, CanBeCancelledAndRefusesNonsense) {
  Progress progress;
  EXPECT_EQ(collide(twoRooms(true), {0, 1.8}, progress).error().kind, ErrorKind::usage);
  EXPECT_EQ(collide(twoRooms(true), {0.3, 0.1}, progress).error().kind, ErrorKind::usage);
  progress.cancel();
  EXPECT_EQ(collide(twoRooms(true), {}, progress).error().kind, ErrorKind::cancelled);
}

}  // namespace
}  // namespace standpoint
