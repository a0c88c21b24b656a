// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "project/storage/project_files.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

// A wall of two blocks with a way of 0.9 m between them, on a floor, and a door in it.
Document doorway() {
  Document d = twoStoreyDocument();
  auto e = std::make_shared<Environment>();
  e->surfaces = d.imported->surfaces;
  addBox(*e, "floor", "IfcSlab", {0, 0, -0.2}, {5, 4, 0});
  addBox(*e, "left", "IfcWall", {0, 2, 0}, {2, 2.2, 2.8});
  addBox(*e, "right", "IfcWall", {2.9, 2, 0}, {5, 2.2, 2.8});
  addBox(*e, "door", "IfcDoor", {2, 2.07, 0}, {2.9, 2.13, 2.1});
  d.imported = e;
  return d;
}

TEST(CollideVerb, ClosesTheDoorsThatItIsTold) {
  const auto door = [](const Result<Outcome>& outcome) { return outcome->answer.at("doors").at(0); };
  const auto open = run("collide", doorway(), nlohmann::json::object());
  ASSERT_TRUE(open) << describe(open.error());
  EXPECT_TRUE(door(open).at("passable"));
  EXPECT_NEAR(door(open).at("clear_width_m"), 0.9, 0.01);
  EXPECT_NEAR(door(open).at("at").at(0), 500002.45, 1e-5) << "in the file's frame";
  EXPECT_FALSE(door(run("collide", doorway(), {{"doors", "closed"}})).at("passable"));
  EXPECT_TRUE(door(run("collide", doorway(), {{"doors", "as-set"}})).at("passable"));
  const auto set = run("collide", doorway(), {{"doors", "as-set"}, {"closed", {"name:door"}}});
  ASSERT_TRUE(set) << describe(set.error());
  EXPECT_FALSE(door(set).at("passable"));
  EXPECT_FALSE(door(run("collide", set->document, {{"doors", "as-set"}})).at("passable")) << "as it was set";
  EXPECT_TRUE(door(run("collide", set->document, {{"doors", "open"}})).at("passable"));
}

TEST(CollideVerb, RefusesToCloseWhatIsNoDoor) {
  EXPECT_EQ(run("collide", doorway(), {{"doors", "as-set"}, {"closed", {"name:left"}}}).error().kind, ErrorKind::usage);
  EXPECT_EQ(run("collide", doorway(), {{"closed", {"name:door"}}}).error().kind, ErrorKind::usage);
}

TEST(CollideVerb, KeepsDoorsAndRoomsInTheProject) {
  Document d = doorway();
  auto e = std::make_shared<Environment>(*d.imported);
  addBox(*e, "room", "IfcSpace", {0, 0, 0}, {5, 2, 2.8});
  e->products.back().tangible = false;
  d.imported = e;
  const auto outcome = run("collide", d, {{"doors", "as-set"}, {"closed", {"class:IfcDoor"}}});
  ASSERT_TRUE(outcome) << describe(outcome.error());
  TemporaryFolder folder;
  Progress progress;
  ASSERT_TRUE(saveProject(outcome->document, folder.path() / "p", progress));
  const auto loaded = loadProject(folder.path() / "p", progress);
  ASSERT_TRUE(loaded) << describe(loaded.error());
  ASSERT_EQ(loaded->collision->doors.size(), 1);
  EXPECT_TRUE(loaded->collision->doors[0].closed);
  EXPECT_NEAR((loaded->collision->doors[0].position - Eigen::Vector3d(2.45, 2.1, 0)).norm(), 0, 1e-5);
  ASSERT_EQ(loaded->collision->rooms.size(), 1);
  EXPECT_TRUE(loaded->collision->rooms[0].reached);
  EXPECT_GT(loaded->collision->rooms[0].walkable_m2, 4);
}

}  // namespace
}  // namespace standpoint
