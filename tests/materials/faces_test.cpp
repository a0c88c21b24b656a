// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>

#include "core/face_patches.h"
#include "tests/materials/fixtures.h"

namespace standpoint {
namespace {

using testing::ElementsAre;

// Of one triangle of the surface that looks to `normal`.
std::string idOf(const MaterialResult& result, std::uint32_t product, std::uint32_t surface,
                 const Eigen::Vector3d& normal) {
  auto mesh = std::make_shared<Mesh>();
  const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  mesh->positions = {{0, 0, 0}, u.cast<float>(), v.cast<float>()};
  mesh->triangles = {{0, 1, 2}};
  mesh->surface_of_triangle = {surface};
  Environment one;
  one.meshes = {mesh};
  one.instances = {{0, product, Eigen::Affine3d::Identity()}};
  const auto index = AssignedTriangles(one, result.assignment).materialOf(0, 0);
  return index < 0 ? "" : result.assignment.materials[static_cast<std::size_t>(index)].id;
}

// A closed box from the origin; all faces of one surface.
std::shared_ptr<const Mesh> box(float x, float y, float z, std::uint32_t surface) {
  auto mesh = std::make_shared<Mesh>();
  for (int corner = 0; corner < 8; ++corner)
    mesh->positions.emplace_back((corner & 1) != 0 ? x : 0, (corner & 2) != 0 ? y : 0, (corner & 4) != 0 ? z : 0);
  for (const auto& [a, b, c, d] : {std::array{0U, 2U, 3U, 1U},
                                   {4U, 5U, 7U, 6U},
                                   {0U, 1U, 5U, 4U},
                                   {2U, 6U, 7U, 3U},
                                   {0U, 4U, 6U, 2U},
                                   {1U, 3U, 7U, 5U}}) {
    mesh->triangles.push_back({a, b, c});
    mesh->triangles.push_back({a, c, d});
  }
  mesh->surface_of_triangle.assign(mesh->triangles.size(), surface);
  return mesh;
}

struct OneBox : Builder {
  std::uint32_t concrete = surface("Beton");
  OneBox() {
    product("IfcSlab", "Decke", {concrete});
    environment.meshes[0] = box(2, 3, 0.5F, concrete);
  }
};

TEST(Faces, ThatLookOneWayGetAnotherMaterialThanTheRest) {
  OneBox b;
  const auto result = b.assignBy(shippedRules(), {{"#100@0,0,2", "carpet"}});
  EXPECT_EQ(idOf(result, 0, b.concrete, {0, 0, 1}), "carpet");
  EXPECT_EQ(idOf(result, 0, b.concrete, Eigen::Vector3d(0.1, 0, 1).normalized()), "carpet");                 // 5.7°
  EXPECT_EQ(idOf(result, 0, b.concrete, Eigen::Vector3d(0.2, 0, 1).normalized()), "concrete_construction");  // 11.3°
  EXPECT_EQ(idOf(result, 0, b.concrete, {0, 0, -1}), "concrete_construction");
  EXPECT_EQ(idOf(result, 0, b.concrete, {1, 0, 0}), "concrete_construction");
  ASSERT_EQ(result.report.uses.size(), 2U);
  EXPECT_EQ(result.report.uses[0].material, "concrete_construction");
  EXPECT_NEAR(result.report.uses[0].area_m2, 6 + 2 * 0.5 * 5, 1e-5);
  EXPECT_NEAR(result.report.uses[1].area_m2, 6, 1e-5);
  EXPECT_NEAR(result.report.area_m2, 17, 1e-5);
}

TEST(Faces, FollowTheOrderOfWhatTheUserSaid) {
  OneBox b;
  auto result = b.assignBy(shippedRules(), {{"#100@0,0,1", "carpet"}, {"class:IfcSlab@0,0,1", "linoleum"}});
  EXPECT_EQ(idOf(result, 0, b.concrete, {0, 0, 1}), "linoleum");
  result = b.assignBy(shippedRules(), {{"#100@0,0,1", "carpet"}, {"#100", "bark"}});  // the whole, later
  EXPECT_EQ(idOf(result, 0, b.concrete, {0, 0, 1}), "bark");
  EXPECT_TRUE(result.assignment.faces.empty());
  result = b.assignBy(shippedRules(), {{"#100", "bark"}, {"#100&material:Beton@0,0,1", "carpet"}});
  EXPECT_EQ(idOf(result, 0, b.concrete, {0, 0, 1}), "carpet");
  EXPECT_EQ(idOf(result, 0, b.concrete, {0, 0, -1}), "bark");
}

// A floor of 2 by 3 m with a table top of 1 by 1 m above it, one mesh and one surface.
struct FloorAndTable : OneBox {
  FloorAndTable() {
    auto both = std::make_shared<Mesh>(*environment.meshes[0]);
    const auto top = box(1, 1, 0.05F, concrete);
    const auto first = static_cast<std::uint32_t>(both->positions.size());
    for (const auto& p : top->positions) both->positions.emplace_back(p + Eigen::Vector3f(0.5F, 0.5F, 1.2F));
    for (const auto& [i, j, k] : top->triangles) both->triangles.push_back({first + i, first + j, first + k});
    both->surface_of_triangle.assign(both->triangles.size(), concrete);
    environment.meshes[0] = both;
  }
};

TEST(Faces, AtAPointAreToldFromThoseThatLookTheSameWay) {
  FloorAndTable b;
  AssignOptions options;
  options.shift_m = {500000, 5600000, 100};
  const auto area = [&](const std::string& selector) {
    const auto result = b.assignBy(shippedRules(), {{selector, "carpet"}}, options);
    for (const auto& use : result.report.uses)
      if (use.material == "carpet") return use.area_m2;
    EXPECT_EQ(result.report.findings.front().kind, "selector") << selector;
    return 0.0;
  };
  EXPECT_NEAR(area("#100@0,0,1"), 6 + 1, 1e-5);
  EXPECT_NEAR(area("#100@0,0,1@500000.75,5600000.75,101.25"), 1, 1e-5);  // the table's top
  EXPECT_NEAR(area("#100@0,0,1@500000.75,5600000.75,100.5"), 6, 1e-5);   // the floor under it
  EXPECT_NEAR(area("class:IfcSlab&material:Beton@0,0,2@500000.75,5600000.75,100.5"), 6, 1e-5);
  EXPECT_EQ(area("#100@0,0,1@500000.75,5600000.75,100.9"), 0);  // in the air
  EXPECT_EQ(area("#100@0,0,1@0.75,0.75,0.5"), 0);               // of another frame
}

TEST(Faces, OfAnotherSurfaceBesideThePointAreNotMeant) {
  Builder b;
  const auto left = b.surface("Beton"), right = b.surface("Beton, glatt");
  b.product("IfcSlab", "Decke", {left});
  auto mesh = std::make_shared<Mesh>();
  mesh->positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}};
  mesh->triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}};
  mesh->surface_of_triangle = {left, left, right, right};
  b.environment.meshes[0] = mesh;
  const auto result = b.assignBy(shippedRules(), {{"#100@0,0,1@0.98,0.5,0", "carpet"}});  // 2 cm from the other
  ASSERT_EQ(result.assignment.faces.size(), 1U);
  EXPECT_EQ(result.assignment.faces[0].surface, left);
}

TEST(Faces, OfAMirroredOrTurnedPlacementAreThoseThatLookThatWayInTheScene) {
  OneBox b;
  b.environment.instances[0].world_from_mesh = Eigen::Affine3d(Eigen::Scaling(1.0, 1.0, -1.0));
  auto result = b.assignBy(shippedRules(), {{"#100@0,0,1", "carpet"}});
  EXPECT_NEAR(result.report.uses[1].area_m2, 6, 1e-5);
  b.environment.instances[0].world_from_mesh =
      Eigen::Affine3d(Eigen::AngleAxisd(1.5707963267948966, Eigen::Vector3d::UnitX()));
  result = b.assignBy(shippedRules(), {{"#100@0,0,1", "carpet"}});
  EXPECT_NEAR(result.report.uses[1].area_m2, 1, 1e-5);  // 2 by 0.5
}

TEST(WiderSelectors, JoinConditionsAndAskForColours) {
  Builder b;
  const auto red = b.surface("Style", {0.8F, 0.1F, 0.1F, 1});
  const auto white = b.surface("Style", {1, 1, 1, 1});
  b.product("IfcWall", "A", {red, white}).storey = "EG";
  b.product("IfcWall", "B", {red}).storey = "OG";
  b.environment.products[1].type_name = "Wall 300";
  b.environment.products[1].groups = {"IfcZone Flat 3"};
  EXPECT_THAT(select(b.environment, "class:IfcWall&storey:EG"), ElementsAre(0U));
  EXPECT_THAT(select(b.environment, "type:wall*"), ElementsAre(1U));
  EXPECT_THAT(select(b.environment, "group:*flat*"), ElementsAre(1U));
  EXPECT_THAT(select(b.environment, "colour:white"), ElementsAre(0U));
  EXPECT_THAT(select(b.environment, "colour:red&storey:OG"), ElementsAre(1U));
  const auto result = b.assignBy(shippedRules(), {{"storey:EG&colour:red", "bark"}});
  EXPECT_EQ(materialId(result, 0, red), "bark");
  EXPECT_NE(materialId(result, 0, white), "bark");
  EXPECT_NE(materialId(result, 1, red), "bark");
  EXPECT_EQ(selectedProduct("#12&material:x@0,0,1"), "#12");
  EXPECT_EQ(selectedProduct("class:IfcWall"), "");
  EXPECT_EQ(selectedProduct("o a&b@home"), "o a&b@home");  // an OBJ's name may hold anything
  EXPECT_EQ(selectedProduct("#12@0,0,1@500000.25,-3,1e1"), "#12");
  EXPECT_EQ(selectedProduct("o a@1,2,3,4"), "o a@1,2,3,4");
  EXPECT_EQ(selectedProduct("o a@0,0,0"), "o a@0,0,0");  // no direction
  EXPECT_EQ(selectedProduct("o a@0,0,0@1,2,3"), "o a@0,0,0@1,2,3");
}

TEST(WiderSelectors, OfANameThatHoldsTheSignsOfPatternsFitIt) {
  Builder b;
  b.product("IfcWall", "", {b.surface("Wand {a|b} #3 * <x> & !")});
  const auto result = b.assignBy(shippedRules(), {{"material:" + literalPattern("Wand {a|b} #3 * <x> & !"), "bark"}});
  EXPECT_EQ(materialId(result, 0, 0), "bark");
}

TEST(Glass, DrawnAsABlockOrInAnotherThicknessIsAFinding) {
  const auto kinds = [](float thickness) {
    Builder b;
    const auto glass = b.surface("Glass");
    b.product("IfcWindow", "", {glass});
    b.environment.meshes[0] = box(1, thickness, 2, glass);
    std::vector<std::string> found;
    for (const auto& f : b.assign().report.findings) found.push_back(f.kind);
    return found;
  };
  EXPECT_THAT(kinds(0.024F), ElementsAre());  // two panes of 4 mm, 16 mm apart
  EXPECT_THAT(kinds(0.006F), ElementsAre("pane-thickness"));
  EXPECT_THAT(kinds(0.3F), ElementsAre("thick-glass"));
  Builder b;
  b.product("IfcWindow", "", {b.surface("Glass")});  // a square without a back
  EXPECT_EQ(b.assign().report.findings.at(0).kind, "flat-glass");
}

TEST(Glass, OfTheRightThicknessIsProposed) {
  Builder b;
  const auto glass = b.surface("Glass");
  b.product("IfcWindow", "", {glass});
  b.environment.meshes[0] = box(1, 0.0101F, 2, glass);
  const auto findings = b.assign().report.findings;
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].remedies.at(0).material, "glass_float_clear_10mm");
}

}  // namespace
}  // namespace standpoint
