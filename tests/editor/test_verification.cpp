// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "editor/model/verification_view.h"
#include "tests/editor/demo_document.h"

namespace standpoint {
namespace {

using nlohmann::json;

json row(const json& material, bool judged, bool agrees, double median, const json& products) {
  return {{"material", material},
          {"points", 1000},
          {"judged", judged},
          {"agrees", agrees},
          {"products", products},
          {"off_db",
           {{"p5", median - 1}, {"q1", median - 0.5}, {"median", median}, {"q3", median + 0.5}, {"p95", median + 1}}}};
}

Document verified(const json& answer) {
  Document d = demoHouse();
  Verification v;
  v.answer = answer;
  d.verification = std::make_shared<const Verification>(v);
  return d;
}

TEST(VerificationView, PutsWhatDisagreesFirstAndWhatCannotBeJudgedLast) {
  const std::string id = demoHouse().environment()->products[2].id;
  const auto view = verificationView(
      verified({{"underlay", "scan"},
                {"instrument", "leica-rtc360"},
                {"compared", 3000},
                {"no_verdict", nullptr},
                {"placement", {{"moved_m", 0.001}}},
                {"scale", {{"reads", "linear in dB: 0.014 per dB"}}},
                {"materials",
                 {row("glass", false, false, 30, json::array()), row("plaster", true, true, 0, json::array()),
                  row("brick", true, false, -6.2, {id, "gone"})}},
                {"proposals", json::array()}}));
  ASSERT_TRUE(view.there);
  EXPECT_FALSE(view.current) << "its basis is none of this document's";
  ASSERT_EQ(view.materials.size(), 3U);
  EXPECT_EQ(view.materials[0].material, "brick");
  EXPECT_EQ(view.materials[0].products, std::vector<std::uint32_t>{2});
  EXPECT_EQ(view.materials[2].material, "glass");
  EXPECT_EQ(view.reach_db, 8) << "what is judged fits into the picture";
  EXPECT_NEAR(view.moved_m, 0.001, 1e-12);
}

TEST(VerificationView, OfAnAnswerThatSomebodyBrokeIsNone) {
  EXPECT_FALSE(verificationView(verified({{"underlay", 7}})).there);
  EXPECT_FALSE(verificationView(demoHouse()).there);
}

}  // namespace
}  // namespace standpoint
