// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/model/lod_rules.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/data_folder.h"
#include "project/verb.h"
#include "tests/temporary_folder.h"

namespace standpoint {
namespace {

using ::testing::HasSubstr;

void add(Environment& environment, const std::string& ifc_class, const Eigen::Vector3d& at,
         const Eigen::Vector3d& size) {
  auto mesh = std::make_shared<Mesh>();
  mesh->positions = {{0, 0, 0}, size.cast<float>(), {static_cast<float>(size.x()), 0, 0}};
  mesh->triangles = {{0, 1, 2}};
  mesh->surface_of_triangle = {0};
  if (environment.surfaces.empty()) environment.surfaces.emplace_back();
  const auto product = static_cast<std::uint32_t>(environment.products.size());
  environment.meshes.push_back(std::move(mesh));
  environment.instances.push_back({product, product, Eigen::Affine3d(Eigen::Translation3d(at))});
  Product p;
  p.ifc_class = ifc_class;
  p.id = "#" + std::to_string(product + 1);
  environment.products.push_back(p);
}

// A house of two walls, a bolt and a pipe; a wall of the neighbour 30 m away.
Environment street() {
  Environment environment;
  add(environment, "IfcWall", {0, 0, 0}, {10, 0.3, 3});
  add(environment, "IfcWallStandardCase", {10, 0, 0}, {0.3, 8, 3});
  add(environment, "IfcMechanicalFastener", {1, 1, 1}, {0.2, 0.2, 0.2});
  add(environment, "IfcPipeSegment", {2, 1, 1}, {4, 0.04, 0.04});
  add(environment, "IfcWall", {40, 0, 0}, {10, 0.3, 3});
  return environment;
}

std::vector<LodLevel> shipped() {
  auto levels = readLodRules(dataFolder() / "optimizer" / "lod" / "default.json");
  if (!levels) throw std::runtime_error(describe(levels.error()));
  return *levels;
}

TEST(LodRules, ShippedMeanTheNumbersOfTheReference) {
  const auto options = allowances(street(), shipped(), {});
  EXPECT_EQ(options.budget, 30000U);
  EXPECT_EQ(options.products[0].lod, "LoD 300");
  EXPECT_EQ(options.products[0].max_deviation_m, 0.015);
  EXPECT_FALSE(options.products[1].drop);
  EXPECT_TRUE(options.products[2].drop);
  EXPECT_TRUE(options.products[3].drop);
  EXPECT_EQ(options.products[4].lod, "LoD 300");
}

TEST(LodRules, TellSurroundingsByTheAuthorsSelectors) {
  const auto options = allowances(street(), shipped(), {12000, {"#5"}});
  EXPECT_EQ(options.budget, 12000U);
  EXPECT_EQ(options.further_budgets, std::vector<std::uint64_t>{3000});
  EXPECT_EQ(options.products[4].lod, "LoD 200");
  EXPECT_EQ(options.products[4].budget_group, 1U);
  EXPECT_EQ(options.products[4].max_deviation_m, 0.15);
  EXPECT_EQ(options.products[0].budget_group, 0U);
}

TEST(LodRules, DropOfTheSurroundingsWhatNeverSeesTheSky) {
  Environment environment = street();
  auto mesh =
      std::make_shared<Mesh>();  // a tent without a floor's edge to look under: a closed pyramid, and a triangle in it
  mesh->positions = {{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}, {4.5F, 4.5F, 9}};
  mesh->triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {0, 2, 1}, {0, 3, 2}};
  mesh->surface_of_triangle.assign(6, 0);
  add(environment, "IfcRoof", {60, 0, 0}, {1, 1, 1});
  environment.meshes.back() = mesh;
  add(environment, "IfcBuildingElementProxy", {64, 4, 1}, {1, 0.5, 1});
  const auto options = allowances(environment, shipped(), {std::nullopt, {"#6", "#7"}});
  EXPECT_FALSE(options.products[5].drop);
  EXPECT_TRUE(options.products[6].drop);
  EXPECT_EQ(options.products[6].reason, "what never sees the sky");
}

TEST(LodRules, TellSurroundingsByTheGapBetweenBuildings) {
  auto levels = shipped();
  levels[1].farther_than_m = 20;
  const auto options = allowances(street(), levels, {});
  EXPECT_EQ(options.products[0].budget_group, 0U);
  EXPECT_EQ(options.products[1].budget_group, 0U);
  EXPECT_EQ(options.products[4].budget_group, 1U);
}

class LodFile : public ::testing::Test {
 protected:
  Error errorOf(const std::string& from, const std::string& to) {
    std::ifstream stream(dataFolder() / "optimizer" / "lod" / "default.json");
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    const auto place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    text.replace(place, from.size(), to);
    const TemporaryFolder folder;
    const auto levels = readLodRules(folder.write("lod_rules_test.json", text));
    return levels ? Error{ErrorKind::internal, "accepted", ""} : levels.error();
  }
};

TEST_F(LodFile, IsRefusedWithThePlaceOfItsFault) {
  EXPECT_EQ(errorOf("\"smaller_than_m\": 0.10", "\"smaler_than_m\": 0.10").source,
            "lod_rules_test.json /0/rules/2/smaler_than_m");
  EXPECT_EQ(errorOf("\"budget\": 30000", "\"budget\": -1").source, "lod_rules_test.json /0/budget");
  EXPECT_EQ(errorOf("\"weight\": 4", "\"weight\": 0").source, "lod_rules_test.json /0/rules/4/weight");
  EXPECT_EQ(errorOf("\"part\": \"main\"", "\"part\": \"house\"").source, "lod_rules_test.json /0/part");
  EXPECT_THAT(errorOf("\"smaller_than_m\": 0.10, \"drop\": true", "\"drop\": true, \"keep\": true").message,
              HasSubstr("both"));
  EXPECT_EQ(errorOf("[\"class:IfcRailing\"]", "[]").source, "lod_rules_test.json /0/rules/4/products");
}

}  // namespace
}  // namespace standpoint
