// SPDX-License-Identifier: GPL-3.0-or-later
// What a verification proposes stands among the findings, as long as it holds.
#include "project/materials/material_findings.h"

#include <gmock/gmock.h>

#include "project/materials/verification_json.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;

VerifyProposal proposal(const char* material, const char* instead, std::vector<std::string> words,
                        std::vector<std::string> alike = {}) {
  return {.material = material,
          .behaves_like = instead,
          .alike = std::move(alike),
          .evidence = "900 points are -4.0 dB off",
          .assign = std::move(words)};
}

VerifyAnswer answerWith(std::vector<VerifyProposal> proposals) {
  VerifyAnswer answer;
  answer.underlay = "scan";
  answer.proposals = std::move(proposals);
  return answer;
}

Document withProposals(Document d, std::vector<VerifyProposal> proposals) {
  d.verification = std::make_shared<const Verification>(verificationOf(d, answerWith(std::move(proposals))));
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

TEST(MaterialFindings, OfProposalsThatMeanNothingAreTheOthers) {
  Document d = measuredHouse();
  const auto others = materialFindings(d).size() - 2;
  d.verification = std::make_shared<const Verification>(
      Verification{0, d.verification->rest, answerWith({proposal("bark", "x", {"", "=", "a", "table=@"})})});
  EXPECT_EQ(materialFindings(d).size(), others);
}

TEST(Verification, ComesBackFromTheProjectUnlessSomebodyBrokeItsAnswer) {
  auto answer = answerWith({proposal("bark", "wood_hardwood", {"table=wood_hardwood"}, {"x"})});
  auto& fit = answer.placement.emplace();
  fit.moved_m = 0.2;
  fit.sigma_shift_m = {1, 2, 3};
  fit.free.emplace_back().shift = {0, 0, 1};
  answer.scale = {"linear", true, 0.75, 0.5, 3, {{1, 2}, {3, 4}}};
  answer.no_verdict = "none";
  const VerifySpread spread{9, -2, -1, 0, 1, 2};
  answer.materials = {{{}, 9, 1.5, true, false, spread, {{spread, 1, 2}}, {{spread, 3, 4}}, {"#1"}, {{"#1", "a"}}}};
  answer.passed = {{{"#2", "g", "IfcDoor", "door"}, 7, 2}};
  const json part = verificationToJson({1, 2, answer});
  const auto back = verificationFrom(part);
  ASSERT_TRUE(back);
  EXPECT_EQ(verificationToJson(*back), part);
  for (const json& broken : {json({{"underlay", "scan"}}), json({{"underlay", "scan"}, {"proposals", {7}}})})
    EXPECT_EQ(verificationFrom({{"basis", "1"}, {"rest", "2"}, {"answer", broken}}), nullptr) << broken;
}

}  // namespace
}  // namespace standpoint
