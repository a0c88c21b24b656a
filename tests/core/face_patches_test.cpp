// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/face_patches.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace standpoint {
namespace {

using Eigen::Vector3d;
constexpr double kStep_m = 0.17;

// Corners a, b, c, d counter-clockwise; with corners of its own, as files without an index have them.
void addQuad(Mesh& mesh, const std::array<Vector3d, 4>& corners) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const auto& c : corners) mesh.positions.push_back(c.cast<float>());
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
  mesh.surface_of_triangle.insert(mesh.surface_of_triangle.end(), 2, 0);
}

// Three steps of 0.3 by 1 m, 0.17 m high, going up along +x: triangles 4k and 4k+1 are the riser, 4k+2 and 4k+3 the
// tread of step k.
struct Stair {
  Environment environment;
  MaterialAssignment assignment;
  Stair() {
    auto mesh = std::make_shared<Mesh>();
    for (int k = 0; k < 3; ++k) {
      const double x = 0.3 * k, z = kStep_m * k, up = z + kStep_m;
      addQuad(*mesh, {Vector3d{x, 0, z}, {x, 0, up}, {x, 1, up}, {x, 1, z}});
      addQuad(*mesh, {Vector3d{x, 0, up}, {x + 0.3, 0, up}, {x + 0.3, 1, up}, {x, 1, up}});
    }
    environment.surfaces.resize(1);
    environment.products.resize(1);
    environment.meshes = {mesh};
    environment.instances = {{0, 0, Eigen::Affine3d::Identity()}};
    assignment.materials.resize(2);
    assignment.surfaces = {{0, 0, 0, "", 1}};
  }
  // The material of each triangle as digits, where material 1 was put on the face at `point` that looks to `direction`.
  std::string painted(const Vector3d& direction, const std::optional<Vector3d>& point) {
    assignment.faces = {{0, 0, direction, 1, "", point}};
    const AssignedTriangles triangles(environment, assignment);
    std::string text;
    for (std::uint32_t t = 0; t < environment.meshes[0]->triangles.size(); ++t)
      text += std::to_string(triangles.materialOf(0, t));
    return text;
  }
};

TEST(FacePatches, OfParallelStepsAreTheOneThatHoldsThePoint) {
  Stair stair;
  ASSERT_EQ(validate(stair.environment), "");
  EXPECT_EQ(stair.painted(Vector3d::UnitZ(), std::nullopt), "001100110011");
  EXPECT_EQ(stair.painted(Vector3d::UnitZ(), Vector3d(0.45, 0.2, 2 * kStep_m)), "000000110000");
  EXPECT_EQ(stair.painted(-Vector3d::UnitX(), Vector3d(0.6, 0.9, 0.4)), "000000001100");
}

TEST(FacePatches, AreNotFoundWhereNoFaceOfThatDirectionIsNear) {
  Stair stair;
  EXPECT_EQ(stair.painted(Vector3d::UnitZ(), Vector3d(0.15, 0.5, kStep_m - 0.08)), "001100000000");  // 8 cm below it
  EXPECT_EQ(stair.painted(Vector3d::UnitZ(), Vector3d(0.15, 0.5, kStep_m - 0.11)), "000000000000");
  EXPECT_EQ(stair.painted(Vector3d::UnitY(), Vector3d(0.15, 1, 0.1)), "000000000000");
  EXPECT_EQ(stair.painted(Vector3d::UnitZ(), Vector3d(0.15, 1.09, kStep_m)), "001100000000");  // beside it
}

TEST(FacePatches, EndAtAGapBetweenCoplanarPanels) {
  Stair panels;
  auto mesh = std::make_shared<Mesh>();
  for (const double y : {0.0, 1.001, 2.001})  // 1 mm apart; the third meets the second
    addQuad(*mesh, {Vector3d{0, y, 0}, {1, y, 0}, {1, y + 1, 0}, {0, y + 1, 0}});
  panels.environment.meshes[0] = mesh;
  EXPECT_EQ(panels.painted(Vector3d::UnitZ(), Vector3d(0.5, 0.999, 0)), "110000");
  EXPECT_EQ(panels.painted(Vector3d::UnitZ(), Vector3d(0.5, 1.5, 0)), "001111");
}

// A cylinder of 36 sides: those within 10° of the direction are its own, one to each side.
TEST(FacePatches, RunOverACurveAsFarAsTheDirectionIsTheSame) {
  Stair round;
  auto mesh = std::make_shared<Mesh>();
  for (int k = 0; k < 36; ++k) {
    const auto at = [](int side, double z) {
      return Vector3d(std::cos(side * M_PI / 18), std::sin(side * M_PI / 18), z);
    };
    addQuad(*mesh, {at(k, 0), at(k + 1, 0), at(k + 1, 1), at(k, 1)});
  }
  round.environment.meshes[0] = mesh;
  const Vector3d between(std::cos(M_PI / 18), std::sin(M_PI / 18), 0);  // the edge of sides 0 and 1, 5° from either
  EXPECT_EQ(round.painted(between, Vector3d(between.x(), between.y(), 0.5)), "1111" + std::string(68, '0'));
}

TEST(FacePatches, AreThoseOfOneInstanceInItsMirroredPlace) {
  Stair stair;
  Eigen::Affine3d second = Eigen::Translation3d(0, 5, 0) * Eigen::Affine3d(Eigen::Scaling(1.0, -1.0, 1.0));
  stair.environment.instances.push_back({0, 0, second});
  EXPECT_EQ(stair.painted(Vector3d::UnitZ(), Vector3d(0.45, 4.5, 2 * kStep_m)),
            "000000000000");  // of the first instance
  const AssignedTriangles triangles(stair.environment, stair.assignment);
  EXPECT_EQ(triangles.patch(0), (std::vector<PlacedTriangle>{{1, 6}, {1, 7}}));
}

TEST(FacePatches, OfSeveralTheLastHolds) {
  Stair stair;
  stair.painted(Vector3d::UnitZ(), Vector3d(0.45, 0.2, 2 * kStep_m));
  stair.assignment.faces.push_back({0, 0, Vector3d::UnitZ(), 0, "", {}});
  EXPECT_EQ(AssignedTriangles(stair.environment, stair.assignment).materialOf(0, 6), 0);
}

}  // namespace
}  // namespace standpoint
