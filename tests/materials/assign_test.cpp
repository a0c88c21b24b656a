// SPDX-License-Identifier: GPL-3.0-or-later

#include <gmock/gmock.h>

#include "tests/core/own_seconds.h"
#include "tests/materials/fixtures.h"

namespace standpoint {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::Not;
using testing::UnorderedElementsAre;

const std::vector<AssignmentRule> kConcreteOnly = {{"", "*beton*", "", "", "concrete_construction"}};

auto finding(const std::string& severity, const std::string& source, const std::string& part) {
  return AllOf(Field(&MaterialFinding::severity, severity), Field(&MaterialFinding::source, source),
               Field(&MaterialFinding::message, HasSubstr(part)));
}

std::vector<MaterialFinding> warningsOf(const MaterialResult& result) {
  std::vector<MaterialFinding> warnings;
  for (const auto& f : result.report.findings)
    if (f.severity == "warning") warnings.push_back(f);
  return warnings;
}

TEST(Coverage, IsTheShareOfPlacedArea) {
  Builder b;
  const auto known = b.surface("Beton");
  const auto other = b.surface("Unobtainium");
  b.product("IfcWall", "A", {known, other});                                           // 1 + 1
  b.product("IfcWall", "B", {known}, Eigen::Affine3d(Eigen::Scaling(2.0, 3.0, 1.0)));  // 6, uneven
  b.product("IfcWall", "C", {other}, Eigen::Affine3d(Eigen::Scaling(-2.0)));           // 4, mirrored
  Eigen::Affine3d turned(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  turned.pretranslate(Eigen::Vector3d(1000, -2000, 30));
  b.product("IfcWall", "D", {known}, turned);  // 1
  const auto result = b.assign(kConcreteOnly);
  EXPECT_NEAR(result.report.area_m2, 13, 1e-9);
  EXPECT_NEAR(result.report.coverage, 8.0 / 13, 1e-9);
  ASSERT_EQ(result.report.uses.size(), 2U);
  EXPECT_EQ(result.report.uses[0].material, "concrete_construction");
  EXPECT_NEAR(result.report.uses[0].area_m2, 8, 1e-9);
  EXPECT_THAT(result.report.uses[0].products, ElementsAre(0U, 1U, 3U));
  EXPECT_EQ(result.report.uses[1].material, "");
  EXPECT_NEAR(result.report.uses[1].area_m2, 5, 1e-9);
  EXPECT_THAT(result.report.uses[1].products, ElementsAre(0U, 2U));
}

TEST(Coverage, CountsEveryInstanceOfASharedMesh) {
  Builder b;
  b.product("IfcColumn", "", {b.surface("Beton")});
  for (int i = 0; i < 4; ++i) b.environment.instances.push_back({0, 0, Eigen::Affine3d(Eigen::Translation3d(i, 0, 0))});
  EXPECT_NEAR(b.assign().report.area_m2, 5, 1e-9);
  EXPECT_EQ(b.assign().assignment.surfaces.size(), 1U);
}

TEST(Coverage, LeavesOutWhatNoBeamMeets) {
  Builder b;
  const auto known = b.surface("Beton");
  const auto other = b.surface("");
  b.product("IfcWall", "", {known});
  b.product("IfcSpace", "", {other}).tangible = false;
  const auto result = b.assign();
  EXPECT_DOUBLE_EQ(result.report.coverage, 1);
  EXPECT_NEAR(result.report.area_m2, 1, 1e-9);
  EXPECT_TRUE(result.report.findings.empty());
  ASSERT_EQ(result.assignment.surfaces.size(), 2U);  // one entry for each pair, assigned or not
  EXPECT_EQ(materialOf(result.assignment, 1, other), -1);
}

TEST(Coverage, OfNothingIsNone) {
  const Builder b;
  EXPECT_EQ(b.assign().report.coverage, 0);
  EXPECT_TRUE(b.assign().assignment.surfaces.empty());
}

TEST(Assignment, KeepsOnlyTheMaterialsInUseAndItsOrder) {
  Builder b;
  const auto wood = b.surface("Holz");
  const auto concrete = b.surface("Beton");
  b.product("IfcWall", "", {wood, concrete});
  b.product("IfcWall", "", {concrete});
  const auto result = b.assign();
  ASSERT_EQ(result.assignment.materials.size(), 2U);
  EXPECT_EQ(result.assignment.materials[0].id, "concrete_construction");
  EXPECT_EQ(result.assignment.materials[1].id, "wood_pine_new_beam");
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const auto& s : result.assignment.surfaces) pairs.emplace_back(s.product, s.surface);
  EXPECT_THAT(pairs, ElementsAre(std::pair(0U, wood), std::pair(0U, concrete), std::pair(1U, concrete)));
}

TEST(Findings, SayWhatNothingFitsOnceForEachCause) {
  Builder b;
  const auto odd = b.surface("Unobtainium");
  for (int i = 0; i < 3; ++i) b.product("IfcChimney", "Schlot", {odd});
  const auto result = b.assign(kConcreteOnly);
  ASSERT_EQ(result.report.findings.size(), 1U);
  EXPECT_THAT(
      result.report.findings[0],
      finding("warning", "#100", "no rule matches surface 'Unobtainium' of IfcChimney 'Schlot' and 2 more (3.00 m²)"));
}

TEST(Assignment, OfASurfaceThatTransmitsLightIsGlassAndSaysWhy) {
  Builder b;
  const auto pane = b.surface("Material.001", {0.9F, 0.95F, 1, 1});
  b.environment.surfaces[pane].transmission = 0.9F;
  b.environment.surfaces[pane].index_of_refraction = 1.52F;
  b.product("", "Fenster", {pane});
  const auto result = b.assign();
  EXPECT_EQ(materialId(result, 0, pane), "glass_float_clear_6mm");
  EXPECT_THAT(result.assignment.surfaces[0].reason,
              HasSubstr("colour transparent (transmission 0.90, index of refraction 1.52)"));
  for (const auto& f : result.report.findings)
    EXPECT_EQ(f.severity, "note");  // no contradiction between colour and material
}

TEST(Findings, NoteWhatOnlyClassOrColourDecided) {
  Builder b;
  b.product("IfcWall", "W", {b.surface("Style 17")}).materials = {"Default Wall"};
  b.product("IfcWall", "V", {b.surface("Beton")});
  const auto result = b.assign();
  ASSERT_EQ(result.report.findings.size(), 1U);
  EXPECT_THAT(result.report.findings[0],
              finding("note", "#100", "only class and colour matched: surface 'Style 17' of IfcWall 'W'"));
  EXPECT_THAT(result.report.findings[0].message, HasSubstr("Render, cement and lime"));
}

TEST(Findings, NameContradictionsOfTransparency) {
  Builder b;
  b.product("IfcWall", "", {b.surface("Beton", {0.5F, 0.5F, 0.5F, 0.3F})});
  b.product("IfcWall", "", {b.surface("Glas", {0.2F, 0.3F, 0.9F, 1})});
  b.product("IfcWall", "", {b.surface("Glas")});  // the file gives no colour: no contradiction
  b.product("IfcWall", "", {b.surface("Glas", {0.2F, 0.3F, 0.9F, 0.3F})});
  const auto findings = warningsOf(b.assign());
  EXPECT_THAT(findings, UnorderedElementsAre(finding("warning", "#100", "transparent surface 'Beton'"),
                                             finding("warning", "#101", "opaque surface 'Glas'")));
}

TEST(Findings, NameWindowsWithoutAPane) {
  Builder b;
  const auto frame = b.surface("Holz");
  b.product("IfcWindow", "blind", {frame});
  b.product("IfcWindow", "seeing", {frame, b.surface("Glas", {0.5F, 0.7F, 0.9F, 0.2F})});
  b.product("IfcWindow", "blind too", {frame});
  EXPECT_THAT(warningsOf(b.assign()),
              ElementsAre(finding("warning", "#100", "no glass surface in IfcWindow 'blind' and 1 more")));
}

TEST(Overrides, WinOverRulesAndLaterOverEarlier) {
  Builder b;
  const auto concrete = b.surface("Beton");
  const auto wood = b.surface("Holz");
  b.product("IfcWall", "Nord", {concrete, wood});
  b.product("IfcSlab", "Decke", {concrete});
  auto result = b.assignBy(shippedRules(), {{"class:IfcWall", "marble_white_weathered"}});
  EXPECT_EQ(materialId(result, 0, concrete), "marble_white_weathered");
  EXPECT_EQ(materialId(result, 0, wood), "marble_white_weathered");
  EXPECT_EQ(materialId(result, 1, concrete), "concrete_construction");
  EXPECT_EQ(result.assignment.surfaces[0].reason, "override class:IfcWall");
  result = b.assignBy(shippedRules(), {{"class:IfcWall", "bark"}, {"material:*BETON*", "basalt"}});
  EXPECT_EQ(materialId(result, 0, concrete), "basalt");
  EXPECT_EQ(materialId(result, 0, wood), "bark");
  EXPECT_EQ(materialId(result, 1, concrete), "basalt");
  result = b.assignBy(shippedRules(), {{"material:*beton*", "basalt"}, {"#100", "bark"}});
  EXPECT_EQ(materialId(result, 0, concrete), "bark");
  EXPECT_EQ(materialId(result, 1, concrete), "basalt");
}

TEST(Overrides, ThatMeanNothingAreNamed) {
  Builder b;
  b.product("IfcWall", "", {b.surface("Beton")});
  const auto result =
      b.assignBy(shippedRules(), {{"class:IfcRoof", "bark"}, {"material:*zink*", "bark"}, {"colour:red", "bark"}});
  EXPECT_THAT(result.report.findings, UnorderedElementsAre(finding("warning", "class:IfcRoof", "matches no surface"),
                                                           finding("warning", "material:*zink*", "matches no surface"),
                                                           finding("warning", "colour:red", "matches no surface")));
}

TEST(Overrides, WithAnUnknownMaterialAreRefused) {
  Builder b;
  b.product("IfcWall", "", {b.surface("Beton")});
  Progress progress;
  const auto result =
      assignMaterials(b.environment, shippedLibrary(), shippedRules(), {{"#100", "adamantium"}}, {}, progress);
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().kind, ErrorKind::usage);
  EXPECT_EQ(result.error().source, "#100");
  EXPECT_THAT(result.error().message, HasSubstr("adamantium"));
}

TEST(Assignment, StopsWhenCancelled) {
  Builder b;
  b.product("IfcWall", "", {b.surface("Beton")});
  Progress progress;
  progress.cancel();
  const auto result = assignMaterials(b.environment, shippedLibrary(), shippedRules(), {}, {}, progress);
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().kind, ErrorKind::cancelled);
}

// The whole test took 0.04 to 0.17 s on two busy cores; the bound is for a change of order, not for a busy machine.
TEST(Assignment, OfTenThousandProductsIsQuick) {
  Builder b;
  for (int i = 0; i < 40; ++i)
    b.surface(i % 3 == 0 ? "Beton " + std::to_string(i) : "Style " + std::to_string(i), {0.1F, 0.5F, 0.2F, 1});
  for (std::uint32_t i = 0; i < 10'000; ++i)
    b.product(i % 2 == 0 ? "IfcWall" : "IfcBuildingElementProxy", "Element " + std::to_string(i),
              {i % 40, (i + 7) % 40});
  const double start = test::ownSeconds();
  const auto result = b.assign();
  const double seconds = test::ownSeconds() - start;
  EXPECT_DOUBLE_EQ(result.report.coverage, 1);
  EXPECT_NEAR(result.report.area_m2, 20'000, 1e-6);
  EXPECT_LT(seconds, 2.0);
  RecordProperty("seconds", std::to_string(seconds));
}

}  // namespace
}  // namespace standpoint
