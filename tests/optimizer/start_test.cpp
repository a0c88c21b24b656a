// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/walk/start.h"

#include <gtest/gtest.h>

#include "tests/optimizer/models.h"

namespace standpoint {
namespace {

using Eigen::Vector3d;

constexpr Body kVisitor{0.25, 1.70};

// A hut of 8 x 6 m with a flat roof, a door in the wall at y = 0 and lawn around; beside it a platform of 1 m².
class Hut {
 public:
  enum class Ground { lawn, floor };            // floor: only as far as the sill of the door
  enum class Plan { one_room, hall_and_room };  // the hall with a store beside, and a room with a terrace behind
  explicit Hut(Ground ground = Ground::lawn, Plan plan = Plan::one_room) {
    if (ground == Ground::lawn)
      box({-10, -10, -0.3}, {20, 16, 0}, "IfcGeographicElement");
    else
      box({0, -0.4, -0.3}, {8, 6, 0}, "IfcSlab");
    box({0, 0, 0}, {0.2, 6, 3}, "IfcWall");
    box({7.8, 0, 0}, {8, 6, 3}, "IfcWall");
    if (plan == Plan::one_room)
      box({0.2, 5.8, 0}, {7.8, 6, 3}, "IfcWall");
    else
      divide();
    box({0.2, 0, 0}, {5, 0.2, 3}, "IfcWall");
    box({6, 0, 0}, {7.8, 0.2, 3}, "IfcWall");
    box({5, 0, 2.1}, {6, 0.2, 3}, "IfcWall");
    box({5, 0.08, 0}, {6, 0.12, 2.1}, "IfcDoor");
    box({0, 0, 3}, {8, 6, 3.3}, "IfcSlab");
    Progress progress;
    result = collide(environment, {.agent_radius_m = kVisitor.radius_m, .agent_height_m = kVisitor.height_m}, progress)
                 .value();
    obstacles = std::make_unique<Obstacles>(result.shapes);
  }
  std::optional<StartPlace> from(const Vector3d& eye, std::optional<Vector3d> looked_at = {}) const {
    return startPlace(environment, result, *obstacles, kVisitor, {eye, looked_at});
  }

  Environment environment;
  CollideResult result;
  std::unique_ptr<Obstacles> obstacles;

 private:
  void space(const Vector3d& low, const Vector3d& high) {
    box(low, high, "IfcSpace");
    environment.products.back().tangible = false;
  }
  void divide() {
    box({0.2, 5.8, 0}, {3, 6, 3}, "IfcWall");  // with a door 2 m wide
    box({5, 5.8, 0}, {7.8, 6, 3}, "IfcWall");
    box({3, 5.8, 2.1}, {5, 6, 3}, "IfcWall");
    box({3, 5.88, 0}, {5, 5.92, 2.1}, "IfcDoor");
    box({0.2, 3, 0}, {6.4, 3.1, 3}, "IfcWall");  // between hall and room
    box({7.3, 3, 0}, {7.8, 3.1, 3}, "IfcWall");
    box({6.4, 3, 2.1}, {7.3, 3.1, 3}, "IfcWall");
    box({6.4, 3.03, 0}, {7.3, 3.07, 2.1}, "IfcDoor");
    box({3, 0.2, 0}, {3.1, 1, 3}, "IfcWall");  // between hall and store
    box({3, 1.9, 0}, {3.1, 3, 3}, "IfcWall");
    box({3, 1, 2.1}, {3.1, 1.9, 3}, "IfcWall");
    box({3.03, 1, 0}, {3.07, 1.9, 2.1}, "IfcDoor");
    space({3.1, 0.2, 0}, {7.8, 3, 3});
    space({0.2, 0.2, 0}, {3, 3, 3});
    space({0.2, 3.1, 0}, {7.8, 5.8, 3});
  }
  void box(const Vector3d& low, const Vector3d& high, const std::string& ifc_class) {
    models::add(environment, models::box(high - low, 1), ifc_class, Eigen::Affine3d(Eigen::Translation3d(low)));
  }
};

TEST(StartPlace, IsUnderTheEyeThatIsIndoors) {
  const auto place = Hut().from({2, 3, 1.7});
  ASSERT_TRUE(place);
  EXPECT_NEAR((place->feet - Vector3d(2, 3, 0)).norm(), 0, 1e-5);
  EXPECT_FALSE(place->facing) << "the way one looks already";
}

TEST(StartPlace, IsTheFloorThatIsLookedAtButNeverTheRoof) {
  const Hut hut;
  const auto lawn = hut.from({30, 30, 30}, Vector3d(12, 10, 0));
  ASSERT_TRUE(lawn);
  EXPECT_NEAR((lawn->feet - Vector3d(12, 10, 0)).norm(), 0, 1e-5);
  const auto roof = hut.from({30, 30, 30}, Vector3d(4, 3, 3.3));
  ASSERT_TRUE(roof);
  EXPECT_NEAR(roof->feet.z(), 0, 1e-5);
}

TEST(StartPlace, IsBeforeTheMainEntranceForWhoeverLooksFromOutside) {
  const auto place = Hut().from({30, 30, 30});
  ASSERT_TRUE(place);
  EXPECT_NEAR((place->feet - Vector3d(5.5, 0.12 + 0.8 - 4, 0)).norm(), 0, 0.1) << place->feet.transpose();
  ASSERT_TRUE(place->facing);
  EXPECT_GT(place->facing->y(), 0.99) << "into the house";
  EXPECT_FALSE(place->no_ground_outside);
}

TEST(StartPlace, IsBehindTheMainEntranceWhereNobodyCanComeToIt) {
  const auto place = Hut(Hut::Ground::floor).from({30, 30, 30});
  ASSERT_TRUE(place);
  EXPECT_NEAR((place->feet - Vector3d(5.5, 0.12 + 0.8, 0)).norm(), 0, 0.1) << place->feet.transpose();
  ASSERT_TRUE(place->facing);
  EXPECT_GT(place->facing->y(), 0.99) << "into the house";
  EXPECT_TRUE(place->no_ground_outside);
}

// The door in the wall at y = 6 is wider, but leads into a room with no other door; that at y = 0 leads into the hall.
TEST(StartPlace, IsAtTheDoorOfTheHallRatherThanAtAWiderOneToTheTerrace) {
  const Hut hut(Hut::Ground::lawn, Hut::Plan::hall_and_room);
  const auto place = hut.from({30, 30, 30});
  ASSERT_TRUE(place);
  EXPECT_LT(place->feet.y(), 0) << place->feet.transpose();
  EXPECT_GT(place->facing->y(), 0.99);
}

TEST(StartPlace, IsIndoorsWhereThereIsNoDoorToComeInBy) {
  Hut hut;
  hut.result.doors.clear();
  const auto place = hut.from({30, 30, 30});
  ASSERT_TRUE(place);
  EXPECT_NEAR((place->feet - Vector3d(4, 3, 0)).norm(), 0, 1) << place->feet.transpose();
}

TEST(StartPlace, IsNowhereWhereThereIsOnlyAPlinth) {
  Environment environment;
  models::add(environment, models::box({1.2, 1.2, 0.3}, 1), "IfcSlab");
  Progress progress;
  const auto result = collide(environment, {.agent_radius_m = 0.25, .agent_height_m = 1.7}, progress).value();
  const Obstacles obstacles(result.shapes);
  EXPECT_FALSE(
      startPlace(environment, result, obstacles, kVisitor, {Vector3d(0.6, 0.6, 1.9), Vector3d(0.6, 0.6, 0.3)}));
}

// In a room of the hut along the wall with its door, that wide.
std::optional<StartPlace> placeInRoomOf(double width_m) {
  Hut hut;
  auto& e = hut.environment;
  models::add(e, models::box({7.6, width_m, 3}, 1), "IfcSpace", Eigen::Affine3d(Eigen::Translation3d(0.2, 0.2, 0)));
  e.products.back().tangible = false;
  return placeInRoom(e, static_cast<std::uint32_t>(e.products.size() - 1), hut.result, *hut.obstacles, kVisitor);
}

TEST(PlaceInRoom, IsWhereMostIsFree) {
  const auto place = placeInRoomOf(5.6);
  ASSERT_TRUE(place);
  EXPECT_GT(place->feet.x(), 2);
  EXPECT_LT(place->feet.x(), 6);
  EXPECT_GT(place->feet.y(), 2);
  EXPECT_LT(place->feet.y(), 4);
  ASSERT_TRUE(place->facing);
  EXPECT_GT(std::abs(place->facing->x()), 0.7) << "along the room";
}

TEST(PlaceInRoom, KeepsToItsRoomWhereItIsOpenToTheNext) {
  const auto place = placeInRoomOf(1.2);
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->feet.y(), 0.8, 0.2) << "in its middle";
  ASSERT_TRUE(place->facing);
  EXPECT_GT(std::abs(place->facing->x()), 0.9) << "along it";
}

}  // namespace
}  // namespace standpoint
