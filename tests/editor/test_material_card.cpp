// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <gtest/gtest.h>

#include "core/data_folder.h"
#include "core/units.h"
#include "editor/model/material_card.h"
#include "project/verb.h"

namespace standpoint {
namespace {

std::vector<Instrument> instruments() {
  return *readInstruments(std::filesystem::path(dataFolder()) / "scanners" / "instruments");
}

PhysicalMaterial lambert(double reflectance) {
  PhysicalMaterial m;
  m.id = "grey";
  m.reflectance = {{1550, reflectance}};
  return m;
}

TEST(MaterialCard, HasARowForEachOfItsInstruments) {
  const auto rows = reportedOf(lambert(0.5), instruments(), 0);
  ASSERT_EQ(rows.size(), kCardInstruments.size());
  EXPECT_EQ(rows[0].instrument, "RTC360");
  EXPECT_TRUE(reportedOf(lambert(0.5), {}, 0).empty());
}

// RTC360's sheet: 0.4 mm at 10 m and 0.5 mm at 20 m on 89 %; at 30 m on 10 % a point still comes back, at 60 m none
// does.
TEST(MaterialCard, ReportsLessIntensityAndMoreNoiseFartherAwayUntilNothingComesBack) {
  const auto rows = reportedOf(lambert(0.1), instruments(), 0);
  const auto& rtc = rows[0];
  ASSERT_EQ(rtc.at[0].fate, ReturnFate::returned);
  EXPECT_GT(rtc.at[0].intensity, rtc.at[1].intensity);
  EXPECT_LT(rtc.at[0].sigma_m, rtc.at[1].sigma_m);
  EXPECT_EQ(rtc.at[2].fate, ReturnFate::too_weak);
}

TEST(MaterialCard, FadesWithLambertsCosine) {
  const auto response = angularResponse(lambert(0.4), 1550);
  for (const std::size_t degrees : {0U, 30U, 60U, 80U})
    EXPECT_NEAR(response[degrees], 40 * std::cos(static_cast<double>(degrees) * kRadPerDeg), 1e-3);
}

}  // namespace
}  // namespace standpoint
