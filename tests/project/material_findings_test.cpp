// SPDX-License-Identifier: GPL-3.0-or-later
// What a verification proposes stands among the findings, as long as it holds.
#include "project/materials/material_findings.h"

#include <gmock/gmock.h>

#include "project/materials/verification.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;

json proposal(const json& material, const char* instead, const json& words, const json& alike = json::array()) {
  return {{"material", material},
          {"behaves_like", instead},
          {"alike", alike},
          {"evidence", "900 points are -4.0 dB off"},
          {"assign", words}};
}

Document withProposals(Document d, const json& proposals) {
  d.verification =
      std::make_shared<const Verification>(verificationOf(d, {{"underlay", "scan"}, {"proposals", proposals}}));
  return d;
}

Document assigned(const Document& d, const json& words) { return run("materials", d, {{"assign", words}})->document; }

// Two proposals, one of them for two walls.
Document measuredHouse() {
  const Document d = assigned(twoStoreyDocument(), {"south0=rubber_black", "north0=rubber_black", "table=bark"});
  return withProposals(d, {proposal("rubber_black", "plaster_gypsum",
                                    {"south0=plaster_gypsum", "north0=plaster_gypsum"}, {"paper_white_cotton_bond"}),
                           proposal("bark", "wood_hardwood", {"table=wood_hardwood"})});
}

std::vector<MaterialFinding> measured(const Document& d) {
  auto all = materialFindings(d);
  std::erase_if(all, [](const MaterialFinding& f) { return f.kind != "measured-otherwise"; });
  return all;
}

TEST(MaterialFindings, GiveOneRemedyToAllSurfacesThatWereMeasuredOtherwise) {
  const Document d = measuredHouse();
  const auto findings = measured(d);
  ASSERT_EQ(findings.size(), 2U);
  EXPECT_EQ(findings[0].products.size(), 2U);
  EXPECT_GT(findings[0].area_m2, findings[1].area_m2);
  EXPECT_THAT(findings[0].message,
              ::testing::MatchesRegex(
                  "measurements contradict 'rubber_black' on IfcWall .* and 1 more: behaves like 'plaster_gypsum' .*"));
  EXPECT_EQ(findings[0].why, "By the cloud 'scan': 900 points are -4.0 dB off. Equally good: paper_white_cotton_bond.");
  ASSERT_EQ(findings[0].remedies.size(), 2U);
  EXPECT_THAT(assignWords(findings[0].remedies[0], "plaster_gypsum"),
              ElementsAre("south0=plaster_gypsum", "north0=plaster_gypsum"));
  EXPECT_EQ(findings[0].remedies[1].material, "paper_white_cotton_bond");
}

TEST(MaterialFindings, StayWhenAnotherOneWasFollowed) {
  const Document followed = assigned(measuredHouse(), {"table=wood_hardwood"});
  EXPECT_FALSE(isCurrent(*followed.verification, followed));
  ASSERT_EQ(measured(followed).size(), 1U);
  const Document half = assigned(followed, {"north0=plaster_gypsum"});
  ASSERT_EQ(measured(half).size(), 1U);
  EXPECT_EQ(measured(half)[0].products.size(), 1U) << "the other wall is mended";
  EXPECT_TRUE(measured(assigned(half, {"south0=plaster_gypsum"})).empty());
}

TEST(MaterialFindings, AreGoneWhenAnotherSurfaceIsNotWhatItWasMeasuredAs) {
  EXPECT_TRUE(measured(assigned(measuredHouse(), {"west0=bark"})).empty());
  Document unmeasured = measuredHouse();
  unmeasured.verification = nullptr;
  EXPECT_TRUE(measured(unmeasured).empty());
}

TEST(MaterialFindings, OfOneThatWasAcceptedKeepTheReasonUntilItsSurfacesChange) {
  const auto id = measured(measuredHouse())[0].id;
  const auto done = run("materials", measuredHouse(), {{"accept", {id}}, {"because", "a curtain hung there"}});
  ASSERT_TRUE(done) << describe(done.error());
  const auto findings = measured(done->document);
  ASSERT_EQ(findings.size(), 2U);
  EXPECT_EQ(findings[1].because, "a curtain hung there") << "what is open stands first";
  EXPECT_EQ(measured(assigned(done->document, {"south0=plaster_gypsum"}))[0].because, "") << "another cause";
}

TEST(MaterialFindings, OfAVerificationThatSomebodyBrokeAreTheOthers) {
  Document d = measuredHouse();
  const auto others = materialFindings(d).size() - 2;
  for (const json& broken :
       {json({{"underlay", "scan"}}), json({{"underlay", "scan"}, {"proposals", {7}}}),
        json({{"underlay", "scan"}, {"proposals", {proposal("bark", "x", {"", "=", "a", "table=@"})}}})}) {
    d.verification = std::make_shared<const Verification>(Verification{0, d.verification->rest, broken});
    EXPECT_EQ(materialFindings(d).size(), others) << broken;
  }
}

}  // namespace
}  // namespace standpoint
