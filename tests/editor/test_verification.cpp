// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "editor/model/verification_view.h"
#include "tests/editor/demo_document.h"

namespace standpoint {
namespace {

VerifyMaterial row(const char* material, bool judged, bool agrees, double median, std::vector<std::string> products) {
  return {.material = material,
          .points = 1000,
          .judged = judged,
          .agrees = agrees,
          .off_db = {1000, median - 1, median - 0.5, median, median + 0.5, median + 1},
          .products = std::move(products)};
}

Document verified(VerifyAnswer answer) {
  Document d = demoHouse();
  d.verification = std::make_shared<const Verification>(Verification{0, 0, std::move(answer)});
  return d;
}

TEST(VerificationView, PutsWhatDisagreesFirstAndWhatCannotBeJudgedLast) {
  const std::string id = demoHouse().environment()->products[2].id;
  VerifyAnswer answer;
  answer.placement.emplace().moved_m = 0.001;
  answer.materials = {row("glass", false, false, 30, {}), row("plaster", true, true, 0, {}),
                      row("brick", true, false, -6.2, {id, "gone"})};
  const auto view = verificationView(verified(std::move(answer)));
  ASSERT_TRUE(view.there);
  EXPECT_FALSE(view.current) << "its basis is none of this document's";
  ASSERT_EQ(view.materials.size(), 3U);
  EXPECT_EQ(view.materials[0].material, "brick");
  EXPECT_EQ(view.materials[0].products, std::vector<std::uint32_t>{2});
  EXPECT_EQ(view.materials[2].material, "glass");
  EXPECT_EQ(view.reach_db, 8) << "what is judged fits into the picture";
  EXPECT_NEAR(view.moved_m, 0.001, 1e-12);
}

TEST(VerificationView, IsNoneWhereNothingWasVerified) { EXPECT_FALSE(verificationView(demoHouse()).there); }

}  // namespace
}  // namespace standpoint
