// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/walk/tight_places.h"

#include <gtest/gtest.h>

#include "optimizer/walk/door_leaves.h"
#include "optimizer/walk/walkable_map.h"
#include "tests/optimizer/models.h"

namespace standpoint {
namespace {

using Eigen::Vector3d;

void addBox(Environment& e, const Vector3d& low, const Vector3d& high, const std::string& ifc_class) {
  models::add(e, models::box(high - low, 1), ifc_class, Eigen::Affine3d(Eigen::Translation3d(low)));
}

void addSpace(Environment& e, const Vector3d& low, const Vector3d& high) {
  addBox(e, low, high, "IfcSpace");
  e.products.back().tangible = false;
}

// Two rooms of 4 x 4 m in a row, and a beam over the only way from the one to the other; outside a door leads into the
// first.
Environment roomsWithBeam(double headroom) {
  Environment e;
  addBox(e, {0, -3, -0.2}, {9, 4, 0}, "IfcSlab");
  addBox(e, {0, 3.8, 0}, {9, 4, 3}, "IfcWall");
  addBox(e, {-0.2, 0, 0}, {0, 4, 3}, "IfcWall");
  addBox(e, {9, 0, 0}, {9.2, 4, 3}, "IfcWall");
  addBox(e, {0, 0, 0}, {1, 0.2, 3}, "IfcWall");
  addBox(e, {2, 0, 0}, {9, 0.2, 3}, "IfcWall");
  addBox(e, {1, 0.08, 0}, {2, 0.12, 2.1}, "IfcDoor");
  addBox(e, {4.4, 0.2, 0}, {4.6, 1.5, 3}, "IfcWall");
  addBox(e, {4.4, 2.5, 0}, {4.6, 3.8, 3}, "IfcWall");
  addBox(e, {4.3, 1.5, headroom}, {4.7, 2.5, 3}, "IfcBeam");
  addBox(e, {0, 0, 3}, {9, 4, 3.2}, "IfcSlab");
  addSpace(e, {0, 0.2, 0}, {4.4, 3.8, 3});
  addSpace(e, {4.6, 0.2, 0}, {9, 3.8, 3});
  return e;
}

CollideResult collided(const Environment& e, double height_m) {
  Progress progress;
  return collide(e, {.agent_radius_m = 0.25, .agent_height_m = height_m}, progress).value();
}

TEST(TightPlace, IsWhereTheBeamIsThatKeepsTheAgentOut) {
  const auto result = collided(roomsWithBeam(1.55), 1.80);
  ASSERT_EQ(result.rooms.size(), 2U);
  EXPECT_TRUE(result.rooms[0].reached);
  EXPECT_FALSE(result.rooms[0].tight_place);
  ASSERT_FALSE(result.rooms[1].reached);
  ASSERT_TRUE(result.rooms[1].tight_place);
  const auto& low = *result.rooms[1].tight_place;
  EXPECT_NEAR(low.headroom_m, 1.55, 0.011);
  EXPECT_NEAR(low.passes_height_m, 1.5, 1e-9);
  EXPECT_NEAR(low.position.x(), 4.5, 0.2 + 0.25 + 0.03) << "within its radius of the beam";
  EXPECT_NEAR(low.position.y(), 2, 0.5);
  EXPECT_NEAR(low.position.z(), 0, 1e-3);
}

TEST(TightPlace, IsNoneWhereTheAgentPassesOrNobodyDoes) {
  EXPECT_TRUE(collided(roomsWithBeam(1.55), 1.50).rooms[1].reached);
  const auto blocked = collided(roomsWithBeam(1.0), 1.80);
  EXPECT_FALSE(blocked.rooms[1].reached);
  EXPECT_FALSE(blocked.rooms[1].tight_place) << "nobody crouches so far";
}

TEST(WalkableMap, LeadsStraightWhereNothingIsInTheWayAndAroundWhatIs) {
  const auto result = collided(roomsWithBeam(2.2), 1.80);
  const WalkableMap map(result.walkable);
  const auto at = [&](double x, double y) {
    const auto i = map.at({x, y, 0});
    return Vector3d(x, y, map.box(*i).min.z());
  };
  const auto straight = map.way(at(1, 1), at(3.5, 3));
  ASSERT_EQ(straight.size(), 2U);
  const auto around = map.way(at(1, 1), at(8, 1));
  ASSERT_GE(around.size(), 3U);
  double length = 0;
  for (std::size_t i = 0; i + 1 < around.size(); ++i) length += (around[i + 1] - around[i]).norm();
  EXPECT_GT(length, 7.1);
  EXPECT_LT(length, 8);
}

// A door in the plane y = 0, from x = 0 to 1: a frame of three bars, a leaf and its handle near x = 0.9.
Environment framedDoor() {
  Environment e;
  Mesh door;
  const auto add = [&](const Vector3d& low, const Vector3d& high) {
    models::append(door, models::box(high - low, 1), Eigen::Affine3d(Eigen::Translation3d(low)));
  };
  add({0, -0.05, 0}, {0.06, 0.05, 2.1});
  add({0.94, -0.05, 0}, {1, 0.05, 2.1});
  add({0, -0.05, 2.04}, {1, 0.05, 2.1});
  add({0.065, -0.02, 0.01}, {0.935, 0.02, 2.035});
  add({0.85, -0.08, 1.0}, {0.92, 0.08, 1.05});
  models::add(e, door, "IfcDoor");
  return e;
}

TEST(DoorLeaves, TurnAboutTheHingeAcrossFromTheHandleAndLeaveTheFrame) {
  const auto leaves = doorLeaves(framedDoor());
  ASSERT_EQ(leaves.doors.size(), 1U);
  ASSERT_EQ(leaves.leaves.size(), 1U);
  EXPECT_NEAR(leaves.leaves[0].hinge.x(), 0.065, 1e-4);
  ASSERT_EQ(leaves.scene.instances.size(), 2U);
  const std::vector<double> open(1, 1.0), back(1, -1.0);
  const double through = leaves.doors[0].passage.through.y();
  for (const auto& [opened, side] : {std::pair(open, through), std::pair(back, -through)}) {
    const auto scene = swung(leaves, opened);
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
      Bounds used;
      for (const auto& t : scene.meshes[scene.instances[i].mesh]->triangles)
        for (const auto v : t)
          used.extend(scene.instances[i].world_from_mesh *
                      scene.meshes[scene.instances[i].mesh]->positions[v].cast<double>());
      if (leaves.leaf_of_instance[i] < 0) {
        EXPECT_NEAR(used.max.x() - used.min.x(), 1, 1e-4) << "the frame stays";
        continue;
      }
      EXPECT_NEAR(side > 0 ? used.max.y() : -used.min.y(), 0.87, 0.03) << "a quarter of a turn";
      EXPECT_LT(used.max.x(), 0.2);
    }
  }
}

TEST(DoorLeaves, AreTwoWhereNeitherIsAsWideAsTheOpening) {
  Environment e;
  Mesh door;
  for (const double x : {0.0, 1.0})
    models::append(door, models::box({0.995, 0.04, 2.1}, 1), Eigen::Affine3d(Eigen::Translation3d(x, 0, 0)));
  models::add(e, door, "IfcDoor");
  const auto leaves = doorLeaves(e);
  ASSERT_EQ(leaves.leaves.size(), 2U);
  const double low = std::min(leaves.leaves[0].hinge.x(), leaves.leaves[1].hinge.x()),
               high = std::max(leaves.leaves[0].hinge.x(), leaves.leaves[1].hinge.x());
  EXPECT_NEAR(low, 0, 1e-3);
  EXPECT_NEAR(high, 1.995, 1e-3);
  EXPECT_NE(leaves.leaves[0].turn, leaves.leaves[1].turn);
}

}  // namespace
}  // namespace standpoint
