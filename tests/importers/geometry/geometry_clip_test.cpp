// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "importers/geometry/kernel.h"

namespace standpoint::geometry {
namespace {

using Eigen::Vector3d;

PolyMesh lShape() { return extrude({{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}, {}}, Vector3d::UnitZ(), 2); }
PolyMesh comb() {  // teeth of equal height, so that a plane may lie on all tips and on all roots
  return extrude({{{0, 0}, {5, 0}, {5, 2}, {4, 2}, {4, 1}, {3, 1}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, {}},
                 Vector3d::UnitZ(), 1);
}
PolyMesh tube() {
  return extrude({{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{{1, 1}, {1, 3}, {3, 3}, {3, 1}}}}, Vector3d::UnitZ(), 3);
}

void expectClip(const PolyMesh& mesh, const Vector3d& direction, double offset, double expected) {
  const auto result = clip(mesh, direction.normalized(), offset);
  ASSERT_TRUE(result.has_value()) << describe(result.error());
  EXPECT_NEAR(volume(*result), expected, 1e-9 * std::max(1.0, expected)) << direction.transpose() << " at " << offset;
  if (expected > 0) {
    EXPECT_TRUE(isClosed(*result)) << direction.transpose() << " at " << offset;
    EXPECT_EQ(triangulate(*result).failed_faces, 0u);
  } else {
    EXPECT_TRUE(result->faces.empty());
  }
}

TEST(Clip, OfABoxInEveryDegeneratePosition) {
  const PolyMesh cube = box({1, 1, 1});
  for (double at : {-0.5, 0.0, 0.25, 0.5, 1.0, 1.5}) {
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d n = Vector3d::Unit(axis);
      expectClip(cube, n, at, std::clamp(at, 0.0, 1.0));
      expectClip(cube, -n, -at, 1 - std::clamp(at, 0.0, 1.0));
    }
  }
  // Through two opposite edges, along one edge, through three corners, touching one corner.
  expectClip(cube, {1, 1, 0}, std::sqrt(0.5), 0.5);
  expectClip(cube, {1, 1, 0}, 0, 0);
  expectClip(cube, {-1, -1, 0}, 0, 1);
  expectClip(cube, {1, 1, 1}, 1 / std::sqrt(3.0), 1.0 / 6);
  expectClip(cube, {-1, -1, -1}, -1 / std::sqrt(3.0), 5.0 / 6);
  expectClip(cube, {1, 1, 1}, 0, 0);
  expectClip(cube, {1, 1, 1}, std::sqrt(3.0), 1);
  expectClip(cube, {1, 1, 1}, 1.5 / std::sqrt(3.0), 0.5);
}

TEST(Clip, OfConcaveSolidsThroughTheirCornersAndFaces) {
  expectClip(lShape(), Vector3d::UnitX(), 1, 6);
  expectClip(lShape(), Vector3d::UnitY(), 1, 6);
  expectClip(lShape(), {1, 1, 0}, 2 / std::sqrt(2.0), 4);  // through the inner corner: touches it from inside
  expectClip(lShape(), {-1, 1, 0}, 0, 5);                  // through inner and outer corner
  expectClip(comb(), Vector3d::UnitY(), 1, 5);
  expectClip(comb(), Vector3d::UnitY(), 2, 8);
  expectClip(comb(), Vector3d::UnitY(), 1.5, 6.5);
  expectClip(comb(), -Vector3d::UnitY(), -1, 3);
  expectClip(comb(), -Vector3d::UnitY(), -1.5, 1.5);
}

TEST(Clip, AcrossAHoleGivesTwoCapsAndAlongItACapWithAHole) {
  expectClip(tube(), Vector3d::UnitX(), 2, 18);
  expectClip(tube(), Vector3d::UnitX(), 1, 12);
  expectClip(tube(), Vector3d::UnitX(), 3, 24);
  expectClip(tube(), Vector3d::UnitZ(), 1, 12);
  const auto slanting = clip(tube(), Vector3d(0, 0.28, 0.96), 0.96 * 1 + 0.28 * 2);
  ASSERT_TRUE(slanting.has_value());
  EXPECT_NEAR(volume(*slanting), 12, 1e-9);  // the plane halves at z = 1 in the middle
  EXPECT_TRUE(isClosed(*slanting));
}

TEST(Clip, KeepsPolygonsAndTags) {
  PolyMesh mesh = box({1, 1, 1});
  setTag(mesh, 7);
  const auto half = clip(mesh, Vector3d::UnitX(), 0.5);
  ASSERT_TRUE(half.has_value());
  EXPECT_EQ(half->faces.size(), 6u);
  for (const Face& face : half->faces) EXPECT_EQ(face.tag, 7u);
}

TEST(Clip, OfAnOpenSurfaceLeavesItOpen) {
  PolyMesh sheet;
  sheet.points = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
  sheet.faces.push_back({{0, 1, 2, 3}, {}, 0});
  const auto half = clip(sheet, Vector3d::UnitX(), 1);
  ASSERT_TRUE(half.has_value());
  EXPECT_EQ(half->faces.size(), 1u);
}

TEST(Clip, BothSidesTogetherAreTheWhole) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const PolyMesh& mesh : {lShape(), comb(), tube(), sphere(1.3, {0.01, 0.4})}) {
    for (int i = 0; i < 200; ++i) {
      Vector3d n(uniform(random), uniform(random), uniform(random));
      n.normalize();
      const double d =
          n.dot(mesh.points[static_cast<std::size_t>(i) % mesh.points.size()]) + (i % 3 ? uniform(random) : 0);
      const auto below = clip(mesh, n, d), above = clip(mesh, -n, -d);
      ASSERT_TRUE(below.has_value() && above.has_value());
      EXPECT_NEAR(volume(*below) + volume(*above), volume(mesh), 1e-5) << i;
      EXPECT_TRUE(below->faces.empty() || isClosed(*below)) << i;
      EXPECT_TRUE(above->faces.empty() || isClosed(*above)) << i;
    }
  }
}

TEST(Clip, RefusesWhatIsNotANumber) {
  PolyMesh mesh = box({1, 1, 1});
  EXPECT_FALSE(clip(mesh, Vector3d::UnitX(), NAN).has_value());
  EXPECT_FALSE(clip(mesh, Vector3d::Zero(), 0).has_value());
  mesh.faces[0].outer[0] = 99;
  EXPECT_FALSE(clip(mesh, Vector3d::UnitX(), 0.5).has_value());
}

}  // namespace
}  // namespace standpoint::geometry
