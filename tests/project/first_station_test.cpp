// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>

#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;
using testing::HasSubstr;

// Storeys from below; boxes are put into one by its number.
class House {
 public:
  House(std::initializer_list<double> floors_m) {
    e_->surfaces.push_back({"Concrete", {0.6F, 0.6F, 0.6F, 1}, "#1", {}, {}});
    e_->spatial.push_back({"#10", "IfcBuilding", "House", "", -1, 0});
    for (const double floor : floors_m)
      e_->spatial.push_back({"#" + std::to_string(e_->spatial.size()), "IfcBuildingStorey",
                             "storey " + std::to_string(e_->spatial.size()), "", 0, floor});
  }
  Product& add(int storey, const char* ifc_class, const Eigen::Vector3d& min, const Eigen::Vector3d& max) {
    addBox(*e_, ifc_class + std::to_string(e_->products.size()), ifc_class, min, max);
    auto& product = e_->products.back();
    product.container = storey;
    product.storey = e_->spatial[static_cast<std::size_t>(storey)].name;
    product.tangible = product.ifc_class != "IfcSpace";
    return product;
  }
  // A slab, four walls, and `rooms` spaces side by side.
  void furnish(int storey, double floor, double width, int rooms) {
    add(storey, "IfcSlab", {0, 0, floor - 0.3}, {width, 6, floor});
    add(storey, "IfcWall", {0, -0.2, floor}, {width, 0, floor + 2.6});
    add(storey, "IfcWall", {0, 6, floor}, {width, 6.2, floor + 2.6});
    add(storey, "IfcWall", {-0.2, 0, floor}, {0, 6, floor + 2.6});
    add(storey, "IfcWall", {width, 0, floor}, {width + 0.2, 6, floor + 2.6});
    for (int i = 0; i < rooms; ++i)
      add(storey, "IfcSpace", {width * i / rooms, 0, floor}, {width * (i + 1) / rooms, 6, floor + 2.6});
  }
  void door(int storey, double floor, const char* is_external) {
    add(storey, "IfcDoor", {1, -0.1, floor}, {2, 0, floor + 2.1}).properties = {
        {"Pset_DoorCommon", "IsExternal", is_external}};
  }
  Document document(double shift_z_m = 0) const {
    Document d = twoStoreyDocument();
    d.imported = e_;
    Georeference g;
    g.shift_m = {0, 0, shift_z_m};
    d.georeference = std::make_shared<const Georeference>(g);
    return d;
  }

 private:
  std::shared_ptr<Environment> e_ = std::make_shared<Environment>();
};

double floorOf(const Document& d, json options = json::object()) {
  options["add"] = "S1";
  const auto placed = run("station", d, options);
  EXPECT_TRUE(placed) << describe(placed.error());
  return placed ? placed->document.job->stations.front().true_pose.translation.z() - 1.6 : -99;
}

TEST(FirstStation, IsInTheStoreyAtGroundLevelNotInALargerCellarOrAttic) {
  House house{-3, 0, 3};
  house.furnish(1, -3, 20, 1);
  house.furnish(2, 0, 12, 2);
  house.furnish(3, 3, 12, 1);
  house.add(3, "IfcRoof", {0, 0, 6}, {12, 6, 6.2});
  EXPECT_NEAR(floorOf(house.document()), 0, 1e-4);
}

TEST(FirstStation, IsBehindAnOuterDoorWhereTheHeightZeroIsElsewhere) {
  House house{112, 115, 118};
  house.furnish(1, 112, 20, 3);
  house.furnish(2, 115, 12, 1);
  house.furnish(3, 118, 12, 2);
  house.door(1, 112, "false");
  house.door(2, 115, "true");
  house.door(3, 118, "true");  // onto a balcony
  EXPECT_NEAR(floorOf(house.document()), 115, 1e-4);
}

TEST(FirstStation, FindsTheHeightZeroOfTheFileBehindAGlobalShift) {
  House house{-3, 0};
  house.furnish(1, -3, 20, 4);
  house.furnish(2, 0, 12, 1);
  EXPECT_NEAR(floorOf(house.document(-3)), -3, 1e-4) << "the file says 0 where the local frame says -3";
}

TEST(FirstStation, IsAmongStoreysOfOneLevelWhereMostRoomsAre) {
  House house{0, 0.6};
  house.furnish(1, 0, 6, 1);
  house.add(2, "IfcSlab", {8, 0, 0.3}, {14, 6, 0.6});
  house.add(2, "IfcSlab", {8, 0, 3.2}, {14, 6, 3.5});
  house.add(2, "IfcSpace", {8, 0, 0.6}, {11, 6, 3.2});
  house.add(2, "IfcSpace", {11, 0, 0.6}, {14, 6, 3.2});
  EXPECT_NEAR(floorOf(house.document()), 0.6, 1e-4);
}

TEST(FirstStation, IsNotOnATable) {
  House house{0};
  house.furnish(1, 0, 4, 1);
  house.add(1, "IfcFurniture", {0.2, 0.2, 0}, {2.2, 5.8, 0.75});
  const auto placed = run("station", house.document(), {{"add", "S1"}});
  ASSERT_TRUE(placed) << describe(placed.error());
  EXPECT_NEAR(placed->document.job->stations.front().true_pose.translation.z(), 1.6, 1e-4);
}

TEST(FirstStation, IsNotOnASuspendedCeilingOfAModelWithoutSlabs) {
  House house{0};
  house.furnish(1, 0, 8, 0);
  auto d = house.document();
  auto e = std::make_shared<Environment>(*d.imported);
  e->products[0].excluded = true;  // the slab
  d.imported = e;
  addBox(*e, "panels", "IfcCovering", {0, 0, 2.5}, {8, 6, 2.52});
  EXPECT_NEAR(floorOf(d), 2.52, 1e-4) << "a covering may be a floor's";
  e->products.back().predefined_type = "CEILING";
  EXPECT_NEAR(floorOf(d), 0, 1e-4) << "the walls' feet";
  const auto above = run("station", d, {{"add", "S1"}, {"at", {4, 3, 4.1}}});
  ASSERT_FALSE(above);
  EXPECT_THAT(above.error().message, HasSubstr("a suspended ceiling"));
  EXPECT_FALSE(run("station", d, {{"add", "S1"}, {"on", {4, 3}}}));
}

TEST(FirstStation, IsProposedByThePlanInTheSamePlaces) {
  House house{-3, 0};
  house.furnish(1, -3, 20, 1);
  house.furnish(2, 0, 12, 2);
  const auto plan = run("plan", house.document(), {{"instrument", "leica-rtc360"}, {"samples", 2000}});
  ASSERT_TRUE(plan) << describe(plan.error());
  EXPECT_GT(plan->answer["proposed"]["at"][2].get<double>(), 1);
}

TEST(MissingSlab, IsFoundWhereDoorsOfAStoreyHaveAFloorOnNeitherSide) {
  House house{0, 3};
  house.furnish(1, 0, 8, 0);
  house.door(1, 0, "true");
  house.add(2, "IfcWall", {0, 0, 3}, {8, 0.2, 5.6});
  house.add(2, "IfcDoor", {1, 2, 3}, {2, 2.1, 5.1});
  house.add(2, "IfcDoor", {4, 2, 3}, {5, 2.1, 5.1});
  house.add(2, "IfcCovering", {0, 1, 2.9}, {8, 3, 2.95}).predefined_type = "CEILING";
  const auto collided = run("collide", house.document(100), json::object());
  ASSERT_TRUE(collided) << describe(collided.error());
  EXPECT_THAT(said(collided->report),
              HasSubstr("storey 2: the floor slab at 103.00 m is missing: 2 of 2 doors of storey 'storey 2' have no "
                        "floor on either side; add a model with a floor at that height"));
  EXPECT_THAT(said(collided->report), HasSubstr("has no floor on one side")) << "outside of the entrance";
  EXPECT_THAT(said(collided->report), testing::Not(HasSubstr("storey 1: the floor slab")));
}

}  // namespace
}  // namespace standpoint
