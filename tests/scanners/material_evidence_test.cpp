// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/evidence/material_evidence.h"

#include <cmath>
#include <functional>

#include <gmock/gmock.h>

#include "core/random.h"
#include "scanners/radiometry/intensity_scale.h"
#include "tests/scanners/scenes.h"

namespace standpoint {
namespace {

using ::testing::HasSubstr;
using Vendor = std::function<double(double)>;  // of 10 lg of the power

// Walls of Lambert materials, each at three distances, seen from its foot point up to 60°: power = ρ cos θ / R².
struct MadeUp {
  std::vector<PhysicalMaterial> library;
  std::vector<SurfaceGroup> groups;
  std::vector<MeasuredReturn> returns;

  MadeUp(const std::vector<double>& reflectances, const Vendor& vendor, double noise_db = 0,
         std::uint32_t each = 1500) {
    for (const double r : reflectances) {
      library.push_back(testing::lambert(r));
      library.back().id = std::to_string(r);
    }
    for (std::uint32_t m = 0; m < reflectances.size(); ++m)
      for (const double distance : {2.0, 3.5, 6.0}) {
        const auto group = static_cast<std::uint32_t>(groups.size());
        groups.push_back({group, 0, static_cast<std::int32_t>(m)});
        for (std::uint32_t i = 0; i < each; ++i) {
          const double angle = uniform(philox({1, group}, i, 0, 0)[0]) * M_PI / 3;
          const double range = distance / std::cos(angle);
          const double db = 10 * std::log10(reflectances[m] * std::cos(angle) / (range * range)) +
                            noise_db * normals(philox({2, group}, i, 0, 0))[0];
          returns.push_back(
              {static_cast<float>(vendor(db)), static_cast<float>(range), static_cast<float>(std::cos(angle)), group});
        }
      }
  }
  // What `actual` is said to be in the project.
  void call(std::size_t actual, std::int32_t said) {
    for (std::size_t g = 3 * actual; g < 3 * actual + 3; ++g) groups[g].material = said;
  }
  MaterialComparison compared() const {
    Instrument instrument = testing::instrument("leica-rtc360");
    instrument.near_range_m = 0;
    Progress progress;
    return *compareMaterials(returns, groups, library, instrument, {}, progress);
  }
};

const std::vector<double> kFive = {0.05, 0.15, 0.3, 0.5, 0.8};
double logarithmic(double db) { return (db + 60) / 70; }
double linearRaw(double db) { return std::round(std::pow(10, db / 10) * 4095); }
double gamma(double db) { return std::pow(std::pow(10, db / 10), 0.45); }
double sigmoid(double db) { return 1 / (1 + std::exp(-(db + 20) / 6)); }

TEST(MaterialEvidence, FindsNothingWrongWhereNothingIsWhateverTheVendorsScale) {
  for (const auto& vendor : {Vendor(logarithmic), Vendor(linearRaw), Vendor(gamma), Vendor(sigmoid)})
    for (const double noise_db : {0.0, 1.0}) {
      const auto result = MadeUp(kFive, vendor, noise_db).compared();
      EXPECT_EQ(result.no_verdict, "");
      EXPECT_TRUE(result.proposals.empty());
      ASSERT_EQ(result.materials.size(), 5U);
      for (const auto& m : result.materials) {
        EXPECT_TRUE(m.agrees);
        EXPECT_NEAR(m.off_db.median, 0, 0.25);
      }
      EXPECT_GT(result.scale.explained, 0.98);
      EXPECT_FALSE(result.scale.range_compensated);
    }
}

TEST(MaterialEvidence, NamesTheSwappedMaterialAndTheRightOne) {
  for (const auto& vendor : {Vendor(logarithmic), Vendor(linearRaw), Vendor(gamma), Vendor(sigmoid)})
    for (const std::int32_t said : {0, 1, 3, 4}) {
      MadeUp scan(kFive, vendor, 0.5);
      scan.call(2, said);  // 0.3 in truth
      const auto result = scan.compared();
      ASSERT_EQ(result.proposals.size(), 1U) << said;
      const auto& p = result.proposals[0];
      EXPECT_EQ(p.material, said);
      EXPECT_EQ(p.instead, 2);
      EXPECT_TRUE(p.alike.empty());
      EXPECT_EQ(p.groups, (std::vector<std::uint32_t>{6, 7, 8}));
      EXPECT_NEAR(p.off_db, 10 * std::log10(0.3 / kFive[static_cast<std::size_t>(said)]), 0.4);
      EXPECT_LT(p.misfit_instead_db, 0.3);
    }
}

TEST(MaterialEvidence, ReadsTheVendorsScale) {
  const auto scale = MadeUp(kFive, logarithmic).compared().scale;
  EXPECT_THAT(scale.describe(), HasSubstr("linear in dB: 0.014"));  // 1/70
  EXPECT_NEAR(scale.dbAt(0.7) - scale.dbAt(0.5), 0.2 * 70, 0.1);
  EXPECT_EQ(MadeUp(kFive, gamma).compared().scale.describe(), "power law: measured ~ power^0.45");
}

// 60 dB for the whole scale, exactly; but below 0.5 stand only a few cells, of little weight, that differ by 1.2 dB.
TEST(IntensityScale, GoesOnAsItsNeighboursDoWhereFewCellsHoldIt) {
  std::vector<IntensityCell> cells;
  for (int i = 0; i < 400; ++i) {
    const double m = 0.5 + 0.2 * i / 400;
    cells.push_back({m, 60 * m, static_cast<std::uint32_t>(i % 8), 30});
  }
  for (const double m : {0.35, 0.36, 0.37}) cells.push_back({m, 60 * m, 8, 1});
  const auto scale = fitIntensityScale(cells, false);
  EXPECT_NEAR(scale.dbAt(0.5) - scale.dbAt(0.36), 60 * 0.14, 0.1);
  EXPECT_NEAR(scale.dbAt(0.7) - scale.dbAt(0.5), 60 * 0.2, 0.1);
}

TEST(MaterialEvidence, KnowsAScaleThatDoesNotFallWithTheRange) {
  MadeUp scan(kFive, logarithmic);
  for (auto& r : scan.returns)  // as the vendor's software does it: back to 1 m
    r.intensity += static_cast<float>(20 * std::log10(static_cast<double>(r.range_m)) / 70);
  scan.call(3, 1);
  const auto result = scan.compared();
  EXPECT_TRUE(result.scale.range_compensated);
  ASSERT_EQ(result.proposals.size(), 1U);
  EXPECT_EQ(result.proposals[0].instead, 3);
}

TEST(MaterialEvidence, TellsOneOddProductFromItsMaterial) {
  MadeUp scan(kFive, logarithmic, 0.5);
  scan.groups[4].material = 4;  // one wall of 0.15 is called 0.8
  const auto result = scan.compared();
  ASSERT_EQ(result.proposals.size(), 1U);
  EXPECT_EQ(result.proposals[0].groups, std::vector<std::uint32_t>{4});
  EXPECT_EQ(result.proposals[0].instead, 1);
  EXPECT_FALSE(result.proposals[0].whole_material);
  EXPECT_TRUE(result.materials[4].agrees);
}

TEST(MaterialEvidence, OfTwoMaterialsThatDisagreeAccusesNeither) {
  MadeUp scan({0.1, 0.4}, logarithmic);
  scan.library.push_back(testing::lambert(0.8));
  scan.call(1, 2);
  const auto result = scan.compared();
  EXPECT_TRUE(result.proposals.empty());
  EXPECT_THAT(result.no_verdict, HasSubstr("the wrong ones cannot be identified"));
}

TEST(MaterialEvidence, ProposesNothingWhereTheIntensitiesFollowNoLaw) {
  MadeUp scan(kFive, logarithmic);
  for (std::uint32_t i = 0; i < scan.returns.size(); ++i)
    scan.returns[i].intensity = static_cast<float>(uniform(philox({3, 0}, i, 0, 0)[0]));
  const auto result = scan.compared();
  EXPECT_TRUE(result.proposals.empty());
  EXPECT_THAT(result.no_verdict, HasSubstr("do not follow range and incidence"));
}

TEST(MaterialEvidence, ProposesNothingByAFewPointsOrOneDistanceAndAngle) {
  MadeUp few(kFive, logarithmic, 0, 40);
  few.call(2, 4);
  EXPECT_TRUE(few.compared().proposals.empty());
  MadeUp one(kFive, logarithmic);
  for (auto& r : one.returns) r.range_m = 3, r.cosine = 1;
  const auto result = one.compared();
  EXPECT_TRUE(result.proposals.empty());
  EXPECT_NE(result.no_verdict, "");
  EXPECT_NE(MadeUp({}, logarithmic).compared().no_verdict, "");
}

TEST(MaterialEvidence, SaysWhatAnUnassignedSurfaceBehavesLike) {
  MadeUp scan(kFive, logarithmic);
  scan.call(3, -1);
  const auto result = scan.compared();
  ASSERT_EQ(result.proposals.size(), 1U);
  EXPECT_EQ(result.proposals[0].material, -1);
  EXPECT_EQ(result.proposals[0].instead, 3);
}

TEST(MaterialEvidence, LeavesOutWhatIsAtTheEndOfTheScaleOrGrazing) {
  MadeUp scan(kFive, [](double db) { return std::min(0.7, logarithmic(db)); });
  scan.returns.push_back({0.1F, 30, 0.05F, 0});
  const auto result = scan.compared();
  EXPECT_EQ(result.grazing, 1U);
  EXPECT_GT(result.saturated, 100U);
  for (const auto& m : result.materials) EXPECT_NEAR(m.off_db.median, 0, 0.2);
  EXPECT_TRUE(result.proposals.empty());
}

}  // namespace
}  // namespace standpoint
