// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "importers/geometry/kernel.h"

namespace standpoint::geometry {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
constexpr double kPi = std::numbers::pi;
const Tessellation kFine{0.00001, 0.1};

Region2 rectangle(double x0, double y0, double x1, double y1) { return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}}; }
Region2 frame() { return {rectangle(0, 0, 4, 3).outer, {rectangle(1, 1, 2, 2).outer}}; }  // hole turned the wrong way

Eigen::AlignedBox3d boundsOf(const PolyMesh& mesh) {
  Eigen::AlignedBox3d bounds;
  for (const Vector3d& p : mesh.points) bounds.extend(p);
  return bounds;
}

// Volume of a prism of that many sides in a circle, per height.
double polygonArea(double radius, int n) { return 0.5 * n * radius * radius * std::sin(2 * kPi / n); }

void expectGoodSolid(const PolyMesh& mesh, double expected_volume, double relative = 1e-9) {
  EXPECT_TRUE(isClosed(mesh));
  EXPECT_NEAR(volume(mesh), expected_volume, relative * expected_volume);
  const TriangulatedMesh triangles = triangulate(mesh);
  EXPECT_EQ(triangles.failed_faces, 0u);
  double sum = 0;
  for (const Triangle& t : triangles.triangles) {
    sum += triangles.points[t[0]].dot(triangles.points[t[1]].cross(triangles.points[t[2]])) / 6;
  }
  EXPECT_NEAR(sum, expected_volume, 1e-8 * std::max(1.0, expected_volume));
}

TEST(SegmentCount, KeepsTheSagittaAndTheAngle) {
  for (double radius : {0.005, 0.05, 0.5, 5.0, 50.0}) {
    const Tessellation t;
    const int n = segmentCount(radius, 2 * kPi, t);
    EXPECT_EQ(n % 4, 0);
    EXPECT_LE(radius * (1 - std::cos(kPi / n)), t.chord_error_m + 1e-12);
    EXPECT_LE(2 * kPi / n, t.max_segment_angle_rad + 1e-9);
    EXPECT_GE(segmentCount(radius, 0.01, t), 1);
  }
  EXPECT_EQ(segmentCount(1.0, 0.0, {}), 1);
  EXPECT_LE(segmentCount(1e30, 2 * kPi, {1e-9, 0}), 100000);
  EXPECT_GE(segmentCount(NAN, 1.0, {}), 1);
}

TEST(Region, IsNormalisedToOuterCounterClockwiseAndHolesClockwise) {
  Region2 region{{{0, 0}, {0, 2}, {0, 2}, {2, 2}, {3, 2}, {2, 2}, {2, 0}, {0, 0}}, {{{0.5, 0.5}, {1, 0.5}, {1, 1}}}};
  normalise(region);
  EXPECT_EQ(region.outer.size(), 4u);
  EXPECT_NEAR(area(region), 4 - 0.125, 1e-15);
  double signed_area = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2d &a = region.outer[i], &b = region.outer[(i + 1) % 4];
    signed_area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  EXPECT_GT(signed_area, 0);
}

TEST(Region, ThatIsOnlyALineIsEmpty) {
  Region2 region{{{0, 0}, {1, 0}, {2, 0}, {1, 0}}, {}};
  normalise(region);
  EXPECT_TRUE(region.outer.empty());
  EXPECT_EQ(area(region), 0);
  EXPECT_TRUE(extrude(region, Vector3d::UnitZ(), 1).faces.empty());
}

TEST(Extrusion, OfASquareHasTheVolumeOfAPrism) {
  expectGoodSolid(extrude(rectangle(0, 0, 2, 3), Vector3d::UnitZ(), 4), 24);
  expectGoodSolid(box({0.1, 20, 3}), 6);
}

TEST(Extrusion, WithAHoleDownwardsOrSlantingStaysOutward) {
  expectGoodSolid(extrude(frame(), Vector3d::UnitZ(), 2), 22);
  expectGoodSolid(extrude(frame(), -Vector3d::UnitZ(), 2), 22);
  const double slant = std::sqrt(0.5);
  expectGoodSolid(extrude(frame(), {slant, 0, slant}, 2), 22 * slant);
}

TEST(Extrusion, FarFromTheOriginKeepsItsVolume) {
  PolyMesh mesh = box({1, 2, 3});
  transform(mesh, Eigen::Affine3d(Eigen::Translation3d(1e5, -2e5, 30)));
  EXPECT_NEAR(volume(mesh), 6, 1e-8);
}

TEST(Taper, OfASquareIsAFrustum) {
  const PolyMesh mesh = extrudeTapered(rectangle(-2, -2, 2, 2), rectangle(-1, -1, 1, 1), Vector3d::UnitZ(), 3);
  expectGoodSolid(mesh, 3.0 / 3 * (16 + 4 + 8));
  EXPECT_EQ(mesh.faces.size(), 6u);
  EXPECT_TRUE(
      extrudeTapered(rectangle(0, 0, 1, 1), {{{0, 0}, {1, 0}, {0, 1}}, {}}, Vector3d::UnitZ(), 1).faces.empty());
}

TEST(Transform, ThatMirrorsKeepsTheSolidOutward) {
  PolyMesh mesh = extrude(frame(), Vector3d::UnitZ(), 2);
  transform(mesh, Eigen::Affine3d(Eigen::Scaling(-1.0, 2.0, 1.0)));
  expectGoodSolid(mesh, 44);
}

TEST(Cylinder, TouchesItsBoundsAndHasThePolygonsVolume) {
  const int n = segmentCount(0.5, 2 * kPi, {});
  const PolyMesh mesh = cylinder(0.5, 2, {});
  expectGoodSolid(mesh, 2 * polygonArea(0.5, n));
  EXPECT_LT((boundsOf(mesh).min() - Vector3d(-0.5, -0.5, 0)).norm(), 1e-15);
  EXPECT_LT((boundsOf(mesh).max() - Vector3d(0.5, 0.5, 2)).norm(), 1e-15);
}

TEST(Cone, IsAThirdOfItsCylinder) {
  expectGoodSolid(cone(0.5, 3, {}), polygonArea(0.5, segmentCount(0.5, 2 * kPi, {})));
}

TEST(Pyramid, IsAThirdOfItsBox) { expectGoodSolid(pyramid(2, 3, 4), 8); }

TEST(Sphere, ComesCloseToTheTrueVolumeFromInside) {
  const PolyMesh mesh = sphere(1, kFine);
  EXPECT_TRUE(isClosed(mesh));
  EXPECT_LT(volume(mesh), 4 * kPi / 3);
  EXPECT_NEAR(volume(mesh), 4 * kPi / 3, 1e-3);
  EXPECT_LT((boundsOf(mesh).max() - Vector3d(1, 1, 1)).norm(), 1e-12);
  EXPECT_LT((boundsOf(mesh).min() + Vector3d(1, 1, 1)).norm(), 1e-12);
}

TEST(Revolution, OfASquareBesideTheAxisIsARingByPappus) {
  const Region2 profile = rectangle(2, 0, 3, 1);
  const int n = segmentCount(3, 2 * kPi, kFine);
  const double ring = polygonArea(3, n) - polygonArea(2, n);
  expectGoodSolid(revolve(profile, Vector3d::Zero(), Vector3d::UnitY(), 2 * kPi, kFine), ring);
  expectGoodSolid(revolve(profile, Vector3d::Zero(), -Vector3d::UnitY(), 2 * kPi, kFine), ring);
  const PolyMesh quarter = revolve(profile, Vector3d::Zero(), Vector3d::UnitY(), kPi / 2, kFine);
  EXPECT_NEAR(volume(quarter), 2.5 * kPi / 2, 1e-3);
  EXPECT_TRUE(isClosed(quarter));
  EXPECT_NEAR(volume(revolve(profile, Vector3d::Zero(), Vector3d::UnitY(), -kPi / 2, kFine)), 2.5 * kPi / 2, 1e-3);
}

TEST(Revolution, OfAProfileOnTheAxisIsACylinder) {
  const int n = segmentCount(2, 2 * kPi, {});
  const PolyMesh full = revolve(rectangle(0, 0, 2, 5), Vector3d::Zero(), Vector3d::UnitY(), 2 * kPi, {});
  expectGoodSolid(full, 5 * polygonArea(2, n));
  EXPECT_EQ(full.faces.size(), 3u * n);
  expectGoodSolid(revolve({{{0, 0}, {2, 0}, {0, 3}}, {}}, Vector3d::Zero(), Vector3d::UnitY(), 2 * kPi, {}),
                  polygonArea(2, n));
  const int half = segmentCount(2, kPi, {});
  expectGoodSolid(revolve(rectangle(0, 0, 2, 5), Vector3d::Zero(), Vector3d::UnitY(), kPi, {}),
                  5 * half * 2 * std::sin(kPi / half));
}

TEST(DiskSweep, AlongALineIsACylinder) {
  const std::vector<Vector3d> path{{0, 0, 0}, {0, 0, 1}, {0, 0, 1}, {0, 0, 4}};
  const int n = segmentCount(0.1, 2 * kPi, {});
  expectGoodSolid(sweepDisk(path, false, 0.1, 0, {}), 4 * polygonArea(0.1, n));
  expectGoodSolid(sweepDisk(path, false, 0.1, 0.05, {}), 4 * (polygonArea(0.1, n) - polygonArea(0.05, n)));
}

TEST(DiskSweep, IsMitredSoThatCornersKeepTheVolumeOfTheAxis) {
  const int n = segmentCount(0.1, 2 * kPi, {});
  const std::vector<Vector3d> bent{{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {2, 3, 1}};
  expectGoodSolid(sweepDisk(bent, false, 0.1, 0, {}), 6 * polygonArea(0.1, n));
  const std::vector<Vector3d> square{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  expectGoodSolid(sweepDisk(square, true, 0.1, 0, {}), 8 * polygonArea(0.1, n));
  expectGoodSolid(sweepDisk(square, true, 0.1, 0.06, {}), 8 * (polygonArea(0.1, n) - polygonArea(0.06, n)));
}

TEST(DiskSweep, ClosedInSpaceIsStillClosed) {
  const std::vector<Vector3d> path{{0, 0, 0}, {2, 0, 0}, {2, 2, 1}, {0, 2, 0}, {0, 1, 2}};
  const PolyMesh mesh = sweepDisk(path, true, 0.1, 0, {});
  EXPECT_TRUE(isClosed(mesh));
  EXPECT_GT(volume(mesh), 0);
}

TEST(DiskSweep, ThatTurnsBackDoesNotRunAway) {
  const std::vector<Vector3d> path{{0, 0, 0}, {1, 0, 0}, {0, 1e-4, 0}};
  EXPECT_LT(boundsOf(sweepDisk(path, false, 0.1, 0, {})).diagonal().norm(), 2);
  EXPECT_TRUE(sweepDisk(std::vector<Vector3d>{{1, 1, 1}, {1, 1, 1}}, false, 0.1, 0, {}).faces.empty());
}

TEST(Loft, OfUnequalProfilesIsRefused) {
  const std::vector<Region2> profiles{rectangle(0, 0, 1, 1), {{{0, 0}, {1, 0}, {0, 1}}, {}}};
  std::vector<Eigen::Isometry3d> frames(2, Eigen::Isometry3d::Identity());
  frames[1].translation().z() = 1;
  EXPECT_FALSE(loft(profiles, frames, false).has_value());
  EXPECT_FALSE(loft({}, {}, false).has_value());
}

TEST(Loft, AroundACircleIsARing) {
  std::vector<Region2> profiles;
  std::vector<Eigen::Isometry3d> frames;
  for (int i = 0; i < 8; ++i) {
    profiles.push_back(rectangle(2, 0, 3, 1));
    frames.emplace_back(Eigen::AngleAxisd(2 * kPi * i / 8, Vector3d::UnitY()));
  }
  const auto ring = loft(profiles, frames, true);
  ASSERT_TRUE(ring.has_value());
  expectGoodSolid(*ring, polygonArea(3, 8) - polygonArea(2, 8));
}

TEST(Orientation, TurnsMixedFacesAndInsideOutShellsOutward) {
  PolyMesh mesh = extrude(frame(), Vector3d::UnitZ(), 2);
  for (std::size_t f = 0; f < mesh.faces.size(); f += 2) {
    std::reverse(mesh.faces[f].outer.begin(), mesh.faces[f].outer.end());
  }
  PolyMesh second = box({1, 1, 1});
  transform(second, Eigen::Affine3d(Eigen::Translation3d(10, 0, 0)));
  for (Face& face : second.faces) std::reverse(face.outer.begin(), face.outer.end());
  append(mesh, second);
  orientOutward(mesh);
  expectGoodSolid(mesh, 23);
}

TEST(Orientation, WeldsASoupAndDropsDegenerateFaces) {
  const PolyMesh whole = box({1, 2, 3});
  PolyMesh soup;
  for (const Face& face : whole.faces) {
    Face own;
    for (std::uint32_t i : face.outer) {
      own.outer.push_back(static_cast<std::uint32_t>(soup.points.size()));
      soup.points.push_back(whole.points[i] + Vector3d::Constant(1e-9 * static_cast<double>(soup.points.size())));
    }
    soup.faces.push_back(own);
  }
  soup.faces.push_back({{0, 1, 0}, {}, 0});
  soup.faces.push_back({{0, 0, 0, 0}, {}, 0});
  orientOutward(soup);
  EXPECT_EQ(soup.faces.size(), 6u);
  EXPECT_TRUE(isClosed(soup));
  EXPECT_NEAR(volume(soup), 6, 1e-6);
}

TEST(Closedness, NoticesAMissingFace) {
  PolyMesh mesh = box({1, 1, 1});
  EXPECT_TRUE(isClosed(mesh));
  mesh.faces.pop_back();
  EXPECT_FALSE(isClosed(mesh));
  EXPECT_FALSE(isClosed({}));
}

TEST(Tags, SurviveAppending) {
  PolyMesh a = box({1, 1, 1}), b = box({2, 2, 2});
  setTag(a, 3);
  setTag(b, 4);
  append(a, b);
  const TriangulatedMesh mesh = triangulate(a);
  EXPECT_EQ(std::count(mesh.tag_of_triangle.begin(), mesh.tag_of_triangle.end(), 3u), 12);
  EXPECT_EQ(std::count(mesh.tag_of_triangle.begin(), mesh.tag_of_triangle.end(), 4u), 12);
}

}  // namespace
}  // namespace standpoint::geometry
