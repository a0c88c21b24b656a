// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <gmock/gmock.h>

#include "tests/materials/fixtures.h"

namespace standpoint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

const MaterialFinding* findingOf(const MaterialResult& result, const std::string& kind) {
  for (const auto& f : result.report.findings)
    if (f.kind == kind) return &f;
  return nullptr;
}

// FNV-1a of "surface 'Mirror' of", " has the material mirror_household" and "#100", each ended by 0xFF: a project that
// was saved when messages named ids keeps what was accepted in it.
TEST(Worklist, KeepsAnAcceptanceByTheIdOfTheMaterialNotByItsLabel) {
  Builder b;
  b.product("IfcSlab", "S", {b.surface("Mirror")});
  const auto result = b.assign();
  const auto* const finding = findingOf(result, "implausible");
  ASSERT_NE(finding, nullptr);
  EXPECT_EQ(finding->cause, "cf6196ae");
}

TEST(Worklist, FindsWhatNoBuildingHas) {
  Builder b;
  b.product("IfcWindow", "W", {b.surface("Concrete C30/37"), b.surface("Glass", {0.5F, 0.7F, 0.9F, 0.2F})});
  b.product("IfcSlab", "S", {b.surface("Mirror")});
  const auto result = b.assign();
  std::vector<std::string> subjects;
  for (const auto& f : result.report.findings)
    if (f.kind == "implausible") subjects.push_back(f.message);
  EXPECT_THAT(subjects, UnorderedElementsAre(HasSubstr("IfcWindow 'W' has the material Concrete, cast"),
                                             HasSubstr("IfcSlab 'S' has the material Mirror, silvered")));
}

TEST(Worklist, FindsANameThatMeansTwoMaterialsAndOffersEach) {
  Builder b;
  const auto style = b.surface("Glass", {0.5F, 0.7F, 0.9F, 0.2F});
  b.product("IfcWindow", "", {style});
  b.product("IfcDoor", "", {style});
  const auto result = b.assign();
  const auto* finding = findingOf(result, "two-ways");
  ASSERT_NE(finding, nullptr);
  EXPECT_THAT(finding->products, ElementsAre(0U, 1U));
  ASSERT_EQ(finding->remedies.size(), 2U);
  EXPECT_EQ(finding->remedies[0].selector, "material:Glass");
  const auto mended = b.assignBy(shippedRules(), {{finding->remedies[0].selector, finding->remedies[0].material}});
  EXPECT_EQ(findingOf(mended, "two-ways"), nullptr);
}

TEST(Worklist, FindsMaterialsWithoutDataAtTheInstrumentsWavelength) {
  Builder b;
  b.product("IfcWall", "", {b.surface("Beton")});
  auto library = shippedLibrary();
  for (auto& m : library)
    if (m.id == "concrete_construction") m.reflectance = {{900, 0.3}, {1100, 0.4}};
  Progress progress;
  AssignOptions options;
  options.wavelengths_nm = {905, 1550};
  const auto result = assignMaterials(b.environment, library, shippedRules(), {}, options, progress).value();
  ASSERT_EQ(result.report.findings.size(), 1U);
  EXPECT_EQ(result.report.findings[0].kind, "no-data");
  EXPECT_THAT(result.report.findings[0].message, HasSubstr("no data at 1550 nm"));
}

TEST(Worklist, NamesGapsOfTheLibraryAndLeavesTheSurfaceWithoutAMaterial) {
  Builder b;
  b.product("IfcSign", "", {b.surface("Retroreflective sheet")});
  const auto result = b.assign();
  EXPECT_EQ(materialId(result, 0, 0), "");
  EXPECT_EQ(result.report.coverage, 0);
  const auto* finding = findingOf(result, "gap");
  ASSERT_NE(finding, nullptr);
  EXPECT_EQ(finding->severity, "warning");
  EXPECT_THAT(finding->why, HasSubstr("gain"));
  EXPECT_THAT(result.assignment.surfaces[0].reason, HasSubstr("Retroreflective sheet"));
}

TEST(Worklist, ShrinksToZeroByItsOwnRemedies) {
  Builder b;
  b.product("IfcWall", "", {b.surface("Style 17")});
  b.product("IfcSlab", "", {b.surface("", {0.5F, 0.5F, 0.5F, 1})});
  b.product("IfcSlab", "", {b.surface("Style 4", {0.5F, 0.7F, 0.9F, 0.2F})}).name = "glass floor";
  std::vector<MaterialOverride> said;
  auto findings = b.assign().report.findings;
  EXPECT_GE(findings.size(), 3U);
  for (int round = 0; round < 10; ++round) {
    const auto next =
        std::find_if(findings.begin(), findings.end(), [](const MaterialFinding& f) { return !f.remedies.empty(); });
    if (next == findings.end()) break;
    const auto remedy = next->remedies[0];
    said.push_back({remedy.selector, remedy.material.empty() ? "concrete_construction" : remedy.material});
    findings = b.assignBy(shippedRules(), said).report.findings;
  }
  for (const auto& f : findings) EXPECT_EQ(f.kind, "flat-glass") << f.message;  // that one can only be accepted
}

TEST(Worklist, KeepsWhatIsAcceptedUntilItsCauseChanges) {
  Builder b;
  const auto style = b.surface("Style 17");
  b.product("IfcWall", "A", {style}).global_id = "0aaaaaaaaaaaaaaaaaaaaa";
  auto finding = b.assign().report.findings.at(0);
  EXPECT_EQ(finding.kind, "weak-rule");
  AssignOptions options;
  options.accepted = {{finding.id, finding.cause, "it is a stage set"}};
  auto result = b.assignBy(shippedRules(), {}, options);
  EXPECT_EQ(result.report.findings.at(0).because, "it is a stage set");
  b.environment.products[0].id = "#4711";  // another export of the same model
  EXPECT_EQ(b.assignBy(shippedRules(), {}, options).report.findings.at(0).because, "it is a stage set");
  b.product("IfcWall", "B", {style}).global_id = "0bbbbbbbbbbbbbbbbbbbbb";
  result = b.assignBy(shippedRules(), {}, options);
  ASSERT_EQ(result.report.findings.size(), 1U);
  EXPECT_EQ(result.report.findings[0].id, finding.id);
  EXPECT_EQ(result.report.findings[0].because, "");  // one more wall: look again
}

TEST(Worklist, HasTheSameIdsInEveryRun) {
  Builder b;
  b.product("IfcWall", "A", {b.surface("Style 17")});
  b.product("IfcBeam", "B", {b.surface("Unobtainium")});
  const auto first = b.assign().report.findings, second = b.assign().report.findings;
  ASSERT_EQ(first.size(), 2U);
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].id, second[i].id);
  EXPECT_NE(first[0].id, first[1].id);
}

TEST(CoverageRows, TellClassesAndStoreysApart) {
  Builder b;
  const auto known = b.surface("Beton"), other = b.surface("Unobtainium");
  b.product("IfcWall", "", {known}).storey = "EG";
  b.product("IfcWall", "", {other}).storey = "OG";  // by its class: weak
  b.product("IfcBuildingElementProxy", "", {other}).storey = "OG";
  const auto report = b.assign().report;
  ASSERT_EQ(report.by_class.size(), 2U);
  EXPECT_EQ(report.by_class[0].name, "IfcWall");
  EXPECT_NEAR(report.by_class[0].area_m2, 2, 1e-9);
  EXPECT_NEAR(report.by_class[0].assigned_m2, 2, 1e-9);
  EXPECT_NEAR(report.by_class[0].weak_m2, 1, 1e-9);
  EXPECT_NEAR(report.by_class[1].assigned_m2, 0, 1e-9);
  ASSERT_EQ(report.by_storey.size(), 2U);
  EXPECT_EQ(report.by_storey[0].name, "OG");
  EXPECT_NEAR(report.by_storey[0].assigned_m2, 1, 1e-9);
}

TEST(Confidence, StandsInEveryDefaultRuleAndFallsFromNamesToColours) {
  double by_name = 0, by_class = 0, by_colour = 0;
  for (const auto& rule : shippedRules().rules) {
    EXPECT_GT(rule.confidence, 0) << rule.place;
    EXPECT_LT(rule.confidence, 1) << rule.place;  // 1 would be the reader's default: the figure is missing
    auto& most = !rule.material.empty()                                    ? by_name
                 : !rule.ifc_class.empty() && rule.colour != "transparent" ? by_class
                                                                           : by_colour;
    if (rule.colour != "transparent") most = std::max(most, rule.confidence);
  }
  EXPECT_GE(by_name, 0.9);
  EXPECT_LT(by_class, kWeakConfidence);
  EXPECT_LT(by_colour, kWeakConfidence);
}

TEST(Metals, OfARendererAreToldByGlossAndColour) {
  Builder b;
  const auto polished = b.surface("Material.003", {0.8F, 0.8F, 0.8F, 1}),
             copper = b.surface("Material.004", {0.8F, 0.4F, 0.2F, 1});
  for (const auto s : {polished, copper}) b.environment.surfaces[s].metallic = 1.0F;
  b.environment.surfaces[polished].roughness = 0.05F;
  b.product("", "thing", {polished, copper});
  const auto result = b.assign();
  EXPECT_EQ(materialId(result, 0, polished), "chromium_polished");
  EXPECT_EQ(materialId(result, 0, copper), "copper_slightly_weathered");
  EXPECT_THAT(result.assignment.surfaces[0].reason, HasSubstr("metallic 1.00, roughness 0.05"));
}

TEST(Names, OfTypesAndProductsAreTheLastThingToGoBy) {
  Builder b;
  b.product("IfcWall", "", {b.surface("")}).type_name = "Basic wall: brick 240";
  b.product("IfcBuildingElementProxy", "Baum", {0});
  b.product("IfcDoor", "", {0}).type_name = "Full glass door";  // its frame is not of glass
  const auto result = b.assign();
  EXPECT_EQ(materialId(result, 0, 0), "brick_red_bare");
  EXPECT_EQ(materialId(result, 1, 0), "leaf_tree_broad_and_needle");
  EXPECT_EQ(materialId(result, 2, 0), "paint_white");
  for (const auto& s : result.assignment.surfaces) EXPECT_LT(s.confidence, kWeakConfidence);
  EXPECT_EQ(result.assignment.surfaces[0].reason.substr(0, 36), "type 'Basic wall: brick 240' (brick)");
}

}  // namespace
}  // namespace standpoint
