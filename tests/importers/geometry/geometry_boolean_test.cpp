// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "importers/geometry/boolean_ways.h"
#include "importers/geometry/kernel.h"

namespace standpoint::geometry {
namespace {

using Eigen::Vector3d;
const Vector3d kWall(20, 0.3, 3);
const double kWallVolume = 18;

PolyMesh boxAt(const Vector3d& low, const Vector3d& size) {
  PolyMesh mesh = box(size);
  transform(mesh, Eigen::Affine3d(Eigen::Translation3d(low)));
  return mesh;
}

PolyMesh moved(PolyMesh mesh, const Eigen::Affine3d& by) {
  transform(mesh, by);
  return mesh;
}

const Eigen::Affine3d kTurned =
    Eigen::Affine3d(Eigen::Translation3d(3, -4, 1.5) * Eigen::AngleAxisd(std::numbers::pi / 6, Vector3d::UnitZ()));
const Eigen::Affine3d kTumbled =
    Eigen::Affine3d(Eigen::Translation3d(3, -4, 1.5) * Eigen::AngleAxisd(0.7, Vector3d(1, -2, 0.5).normalized()));

void expectSolid(const Result<PolyMesh>& result, double expected, double relative = 1e-9) {
  ASSERT_TRUE(result.has_value()) << describe(result.error());
  EXPECT_NEAR(volume(*result), expected, relative * std::max(1.0, expected));
  EXPECT_TRUE(result->faces.empty() || isClosed(*result));
  EXPECT_EQ(triangulate(*result).failed_faces, 0u);
}

// n openings of 0.2 x 1 m, `beyond` past each face of the wall (0: flush; negative: a niche).
std::vector<PolyMesh> openings(int n, double beyond_front, double beyond_back) {
  std::vector<PolyMesh> tools;
  for (int i = 0; i < n; ++i) {
    tools.push_back(boxAt({20.0 * (i + 0.25) / n, -beyond_front, 1}, {0.2, 0.3 + beyond_front + beyond_back, 1}));
  }
  return tools;
}

TEST(Subtraction, OfOpeningsThroughAWallInEveryPoseAndFit) {
  for (const Eigen::Affine3d& pose : {Eigen::Affine3d::Identity(), kTurned, kTumbled}) {
    for (int n : {1, 10, 50}) {
      for (double beyond : {0.0, 0.1, 1e-8}) {
        std::vector<PolyMesh> tools = openings(n, beyond, beyond);
        for (PolyMesh& tool : tools) transform(tool, pose);
        const auto result = subtract(moved(box(kWall), pose), tools);
        expectSolid(result, kWallVolume - n * 0.06);
        EXPECT_EQ(result->faces.size(), 6u + 4u * static_cast<unsigned>(n));  // polygons kept, no extra cuts
      }
    }
  }
}

TEST(Subtraction, OfNichesLeavesTheirBacks) {
  for (const Eigen::Affine3d& pose : {Eigen::Affine3d::Identity(), kTurned, kTumbled}) {
    std::vector<PolyMesh> tools = openings(10, 0.1, -0.2);
    for (PolyMesh& tool : tools) transform(tool, pose);
    const auto result = subtract(moved(box(kWall), pose), tools);
    expectSolid(result, kWallVolume - 10 * 0.02);
    EXPECT_EQ(result->faces.size(), 6u + 10u * 5u);
  }
}

TEST(Subtraction, OfNichesOfManyDepthsAndAVoidInside) {
  std::vector<PolyMesh> tools;
  for (int i = 0; i < 5; ++i) tools.push_back(boxAt({1.0 + 3 * i, -0.1, 1}, {1, 0.15 + 0.04 * i, 1}));
  tools.push_back(boxAt({17, 0.1, 1}, {1, 0.1, 1}));
  expectSolid(subtract(box(kWall), tools), kWallVolume - (0.05 + 0.09 + 0.13 + 0.17 + 0.21) - 0.1);
}

TEST(Subtraction, OfTouchingOverlappingAndRepeatedOpenings) {
  const auto cut = [](std::vector<PolyMesh> tools) { return subtract(box(kWall), tools); };
  const PolyMesh first = boxAt({2, -0.1, 1}, {1, 0.5, 1});
  expectSolid(cut({first, boxAt({3, -0.1, 1}, {1, 0.5, 1})}), kWallVolume - 0.6);
  expectSolid(cut({first, boxAt({3, -0.1, 2}, {1, 0.5, 0.5})}), kWallVolume - 0.45);  // meet in an edge
  expectSolid(cut({first, boxAt({2.5, -0.1, 1.5}, {1, 0.5, 1})}), kWallVolume - 0.6 + 0.075);
  expectSolid(cut({first, first}), kWallVolume - 0.3);
  expectSolid(cut({first, boxAt({2.2, 0, 1.2}, {0.2, 0.3, 0.2})}), kWallVolume - 0.3);
}

TEST(Subtraction, ThroughEdgesCornersAndTheWholeBody) {
  const auto cut = [](const PolyMesh& tool) { return subtract(box(kWall), std::vector<PolyMesh>{tool}); };
  expectSolid(cut(boxAt({2, -0.1, -0.1}, {1, 0.5, 2.1})), kWallVolume - 0.6);  // a door: through the lower edge
  expectSolid(cut(boxAt({2, 0, 0}, {1, 0.3, 2})), kWallVolume - 0.6);          // the same, flush
  expectSolid(cut(boxAt({-1, -1, 2}, {2, 2, 2})), kWallVolume - 0.3);          // a corner
  expectSolid(cut(boxAt({5, -1, -1}, {1, 2, 5})), kWallVolume - 0.9);          // in two
  expectSolid(cut(boxAt({-1, -1, -1}, {30, 5, 5})), 0);                        // nothing left
  expectSolid(cut(boxAt({0, 0, 0}, kWall)), 0);
  expectSolid(cut(boxAt({0, 0.3, 0}, kWall)), kWallVolume);  // touches only
  expectSolid(cut(boxAt({50, 0, 0}, kWall)), kWallVolume);   // misses
}

TEST(Subtraction, OfARoundOpening) {
  const int n = segmentCount(0.4, 2 * std::numbers::pi, {});
  PolyMesh tool = cylinder(0.4, 2, {});
  transform(tool, Eigen::Affine3d(Eigen::Translation3d(5, 1, 1.5) *
                                  Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitX())));
  expectSolid(subtract(box(kWall), std::vector<PolyMesh>{tool}),
              kWallVolume - 0.3 * 0.5 * n * 0.16 * std::sin(2 * std::numbers::pi / n));
}

TEST(Subtraction, FromAWallThatARoofHasClipped) {
  const auto gable = clip(box({4, 0.3, 4}), Vector3d(1, 0, 1).normalized(), 5 / std::sqrt(2.0));
  ASSERT_TRUE(gable.has_value());
  const double before = 0.3 * (16 - 4.5);
  EXPECT_NEAR(volume(*gable), before, 1e-12);
  expectSolid(subtract(*gable, std::vector<PolyMesh>{boxAt({1, -0.1, 1}, {1, 0.5, 1})}), before - 0.3);
}

TEST(Subtraction, FromAMitredWallWorksAlongItsHeight) {
  const PolyMesh mitred = extrude({{{0, 0}, {5, 0}, {4.7, 0.3}, {0.3, 0.3}}, {}}, Vector3d::UnitZ(), 3);
  const double before = 3 * 0.3 * 4.7;
  std::vector<PolyMesh> tools{boxAt({1, -0.1, 1}, {1, 0.5, 1}), boxAt({3, -0.1, 0}, {1, 0.5, 2.1})};
  const auto common = commonDirection(mitred, tools);
  ASSERT_TRUE(common.has_value());
  EXPECT_NEAR(std::abs(common->direction.z()), 1, 1e-12);
  expectSolid(subtract(mitred, tools), before - 0.3 - 0.63);
}

TEST(Subtraction, WithoutACommonDirectionIsDoneByCarve) {
  PolyMesh slanting = box({0.5, 2, 0.5});
  transform(slanting, Eigen::Affine3d(Eigen::Translation3d(5, -0.85, 1) *
                                      Eigen::AngleAxisd(0.3, Vector3d(1, 0, 1).normalized())));
  const PolyMesh wall = box(kWall);
  const auto result = subtract(wall, std::vector<PolyMesh>{slanting, boxAt({8, -0.1, 1}, {1, 0.5, 1})});
  const auto common = intersect(wall, slanting);
  ASSERT_TRUE(common.has_value());
  ASSERT_TRUE(result.has_value()) << describe(result.error());
  EXPECT_GT(volume(*common), 0.05);
  EXPECT_NEAR(volume(*result), kWallVolume - 0.3 - volume(*common), 1e-5);
  EXPECT_TRUE(isClosed(*result));
}

TEST(Subtraction, FromARoundBodyKeepsTheVolumesOfBothKernels) {
  const PolyMesh ball = sphere(1, {0.01, 0.5});
  const PolyMesh tool = boxAt({0, 0, 0}, {2, 2, 2});
  const std::vector<PolyMesh> tools{tool};
  const auto carve = combineWithCarve(ball, tool, Operation::difference);
  const auto cgal = combineWithCgal(ball, tools, Operation::difference);
  ASSERT_TRUE(carve.has_value()) << describe(carve.error());
  ASSERT_TRUE(cgal.has_value()) << describe(cgal.error());
  EXPECT_NEAR(volume(*carve), volume(ball) * 7 / 8, 1e-5);
  EXPECT_NEAR(volume(*cgal), volume(ball) * 7 / 8, 1e-9);
  EXPECT_TRUE(isClosed(*carve));
  EXPECT_TRUE(isClosed(*cgal));
}

TEST(Subtraction, CarriesTags) {
  PolyMesh wall = box(kWall), tool = boxAt({2, -0.1, 1}, {1, 0.5, 1});
  setTag(wall, 1);
  setTag(tool, 2);
  for (Face& face : wall.faces) {  // the face at y = 0 has a style of its own
    bool front = true;
    for (std::uint32_t i : face.outer) front = front && wall.points[i].y() == 0;
    if (front) face.tag = 3;
  }
  const auto result = subtract(wall, std::vector<PolyMesh>{tool});
  ASSERT_TRUE(result.has_value());
  std::vector<int> count(4, 0);
  for (const Face& face : result->faces) ++count[face.tag];
  EXPECT_EQ(count, (std::vector<int>{0, 5, 4, 1}));
}

TEST(Booleans, OfRandomBoxesAgreeWithTheirOverlap) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1, 1), size(0.2, 1.5);
  const auto point = [&](auto& d) { return Vector3d(d(random), d(random), d(random)); };
  for (int i = 0; i < 300; ++i) {
    Vector3d al = point(place), as = point(size), bl = point(place), bs = point(size);
    if (i % 3 == 0) {  // coarse numbers: faces, edges and corners fall together
      for (Vector3d* v : {&al, &as, &bl, &bs}) *v = (*v * 2).array().round() / 2;
      as = as.cwiseMax(0.5), bs = bs.cwiseMax(0.5);
    }
    const Eigen::Affine3d& pose = i % 2 ? kTumbled : kTurned;
    const PolyMesh a = moved(boxAt(al, as), pose), b = moved(boxAt(bl, bs), pose);
    const Vector3d overlap = ((al + as).cwiseMin(bl + bs) - al.cwiseMax(bl)).cwiseMax(0.0);
    expectSolid(subtract(a, std::span(&b, 1)), as.prod() - overlap.prod());
    expectSolid(intersect(a, b), overlap.prod());
    expectSolid(unite(a, b), as.prod() + bs.prod() - overlap.prod());
  }
}

TEST(Booleans, OfRandomlyTurnedBoxesAddUp) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(-0.5, 0.5), size(0.5, 1.5);
  const auto point = [&](auto& d) { return Vector3d(d(random), d(random), d(random)); };
  for (int i = 0; i < 60; ++i) {
    const PolyMesh a = boxAt(point(place), point(size));
    const Eigen::Affine3d pose(Eigen::AngleAxisd(place(random), point(place).normalized()));
    const PolyMesh b = moved(boxAt(point(place), point(size)), pose);
    const auto rest = subtract(a, std::span(&b, 1)), both = intersect(a, b), all = unite(a, b);
    ASSERT_TRUE(rest && both && all) << i;
    EXPECT_NEAR(volume(*rest), volume(a) - volume(*both), 2e-5) << i;
    EXPECT_NEAR(volume(*all), volume(*rest) + volume(b), 2e-5) << i;
  }
}

TEST(Booleans, ReportBodiesThatAreNotSolids) {
  PolyMesh open = box({1, 1, 1});
  open.faces.erase(open.faces.begin() + 2, open.faces.end());
  const PolyMesh tool = moved(boxAt({0.2, 0.2, -1}, {0.3, 0.3, 3}), kTumbled);
  PolyMesh open_there = moved(open, kTumbled);
  transform(open_there, Eigen::Affine3d(Eigen::AngleAxisd(0.1, Vector3d::UnitX())));
  const auto result = subtract(open_there, std::span(&tool, 1));
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().kind, ErrorKind::unusable);
  EXPECT_NE(result.error().message.find("carve"), std::string::npos) << result.error().message;
  EXPECT_NE(result.error().message.find("CGAL"), std::string::npos);
  PolyMesh broken = box({1, 1, 1});
  broken.points[0].x() = NAN;
  EXPECT_FALSE(subtract(broken, std::span(&tool, 1)).has_value());
  EXPECT_FALSE(subtract(tool, std::span(&broken, 1)).has_value());
}

TEST(Subtraction, ByCarveCarriesTags) {
  PolyMesh wall = box(kWall), tool = boxAt({0, 0, 0}, {0.5, 2, 0.5});
  transform(tool, Eigen::Affine3d(Eigen::Translation3d(5, -0.85, 1) *
                                  Eigen::AngleAxisd(0.3, Vector3d(1, 0, 1).normalized())));
  for (std::uint32_t f = 0; f < wall.faces.size(); ++f) wall.faces[f].tag = 10 + f;
  setTag(tool, 2);
  const auto result = combineWithCarve(wall, tool, Operation::difference);
  ASSERT_TRUE(result.has_value());
  std::vector<int> count(20, 0);
  for (const Face& face : result->faces) ++count.at(face.tag);
  EXPECT_EQ(count[2], 4);
  for (std::uint32_t f = 0; f < 6; ++f) EXPECT_GE(count[10 + f], 1);
}

TEST(Subtraction, FromASurfaceThatLacksFacesIsNotDoneInThePlane) {
  const PolyMesh tool = boxAt({2, -0.1, 1}, {1, 0.5, 1});
  for (std::size_t missing = 0; missing < 6; ++missing) {
    PolyMesh wall = box(kWall);
    wall.faces.erase(wall.faces.begin() + static_cast<std::ptrdiff_t>(missing));
    EXPECT_FALSE(subtract(wall, std::span(&tool, 1)).has_value()) << missing;
  }
  PolyMesh duct = box(kWall);  // two opposite faces missing: the area vectors still add up to nothing
  duct.faces.erase(duct.faces.begin() + 1), duct.faces.erase(duct.faces.begin() + 2);
  EXPECT_FALSE(subtract(duct, std::span(&tool, 1)).has_value());
}

// Bent boxes: faces that are not planar, bodies that pass through themselves. Any answer is good that comes in time, is
// finite and, when it claims to be a solid, has a volume that fits.
TEST(Booleans, OfBentAndSelfCrossingBodiesEndInAnAnswer) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 200; ++i) {
    PolyMesh a = box({1, 1, 1}), b = boxAt({0.2, 0.3, -0.5}, {0.5, 0.5, 1.2});
    for (PolyMesh* mesh : {&a, &b}) {
      const double by = i % 4 == 0 ? 2.0 : i % 4 == 1 ? 1e-3 : i % 4 == 2 ? 1e-6 : 1e-9;
      for (int k = 0; k < 2; ++k)
        mesh->points[random() % 8] += by * Vector3d(uniform(random), uniform(random), uniform(random));
    }
    for (const auto& result : {subtract(a, std::span(&b, 1)), intersect(a, b), unite(a, b)}) {
      if (!result) continue;
      for (const Vector3d& p : result->points) EXPECT_TRUE(p.allFinite());
      EXPECT_LE(volume(*result), (std::abs(volume(a)) + std::abs(volume(b))) * 1.01 + 1e-5);
    }
  }
}

double totalArea(const std::vector<Region2>& regions) {
  double sum = 0;
  for (const Region2& region : regions) sum += area(region);
  return sum;
}

TEST(Regions, OfTouchingAndOverlappingRectangles) {
  const auto rectangle = [](double x0, double y0, double x1, double y1) {
    return Region2{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}};
  };
  const std::vector<Region2> a{rectangle(0, 0, 4, 3)};
  const auto hole = difference(a, std::vector<Region2>{rectangle(1, 1, 2, 2)});
  ASSERT_TRUE(hole.has_value());
  ASSERT_EQ(hole->size(), 1u);
  EXPECT_EQ(hole->front().holes.size(), 1u);
  EXPECT_DOUBLE_EQ(area(hole->front()), 11);
  const auto split = difference(a, std::vector<Region2>{rectangle(1, -1, 2, 4)});
  ASSERT_TRUE(split.has_value());
  EXPECT_EQ(split->size(), 2u);
  const auto joined =
      unite(std::vector<Region2>{rectangle(0, 0, 1, 1), rectangle(1, 0, 2, 1), rectangle(0.5, 0, 1.5, 1)});
  ASSERT_TRUE(joined.has_value());
  ASSERT_EQ(joined->size(), 1u);
  EXPECT_EQ(joined->front().outer.size(), 4u);
  const auto apart = intersection(a, std::vector<Region2>{rectangle(4, 0, 5, 3)});
  ASSERT_TRUE(apart.has_value());
  EXPECT_TRUE(apart->empty());
}

TEST(Regions, OfRandomTrianglesAddUp) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto triangle = [&] {
    Region2 r{
        {{uniform(random), uniform(random)}, {uniform(random), uniform(random)}, {uniform(random), uniform(random)}},
        {}};
    normalise(r);
    return r;
  };
  for (int i = 0; i < 500; ++i) {
    const std::vector<Region2> a{triangle(), triangle(), triangle()}, b{triangle(), triangle()};
    const auto both = intersection(a, b), rest = difference(a, b), a_all = unite(a);
    ASSERT_TRUE(both && rest && a_all) << i;
    EXPECT_NEAR(totalArea(*both) + totalArea(*rest), totalArea(*a_all), 1e-5) << i;
  }
}

}  // namespace
}  // namespace standpoint::geometry
