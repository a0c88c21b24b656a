// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/scanning/field_fault.h"

#include <cmath>

#include <gtest/gtest.h>

#include "pointclouds/formats.h"
#include "project/survey/survey_verbs.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

struct Points final : PointSink {
  PointBlock all;
  std::string guid;
  std::string description;
  std::vector<LabelledProduct> products;
  Result<void> begin(const ScanHeader& header) override {
    products = header.products;
    guid = header.guid;
    description = header.description;
    return {};
  }
  Result<void> write(const PointBlock& block) override {
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    append(all.x_m, block.x_m), append(all.y_m, block.y_m), append(all.z_m, block.z_m);
    append(all.row, block.row), append(all.column, block.column), append(all.truth.flags, block.truth.flags);
    append(all.product, block.product);
    return {};
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }
};

// A sector about -X in the lower room, whose west wall is 2.5 m away, with the floor under it.
class AWalkerInTheScan : public testing::Test {
 protected:
  AWalkerInTheScan()
      : document_(run("station", twoStoreyDocument(), {{"add", "S1"}, {"at", {500002.5, 5600002, 1.6}}})->document) {}

  Points scanned(const json& more,
                 const json& settings = {"resolution=1/20", "quality=4x", "horizontal_from=150", "horizontal_to=210",
                                         "vertical_from=-40", "vertical_to=10"},
                 const std::string& instrument = "faro-focus-s350") {
    const auto file = folder_.path() / "scan.e57";
    json options = {
        {"instrument", instrument}, {"set", settings}, {"seed", 3}, {"truth", true}, {"output", file.string()}};
    if (!more.is_null()) options.update(more);
    const auto outcome = run("scan", document_, options);
    EXPECT_TRUE(outcome) << describe(outcome.error());
    Points points;
    Progress progress;
    EXPECT_TRUE(cloudFormatFor(file)->read(file, points, progress));
    return points;
  }

  TemporaryFolder folder_;
  Document document_;
};

TEST_F(AWalkerInTheScan, StandsTwoMetresAwayWhereTheLaserLooksAtThatShareOfTheTurn) {
  const auto empty = scanned({}), walked = scanned({{"field-fault", {"passer_by=0.5"}}});
  ASSERT_EQ(empty.all.size(), walked.all.size()) << "what it hides comes back from it";
  std::size_t moving = 0;
  double lowest = 1e9, highest = -1e9, widest = 0;
  for (std::size_t i = 0; i < walked.all.size(); ++i) {
    const double x = walked.all.x_m[i], y = walked.all.y_m[i], z = walked.all.z_m[i];
    if ((walked.all.truth.flags[i] & point_flag::kMoving) == 0) {
      EXPECT_EQ(walked.all.x_m[i], empty.all.x_m[i]);
      EXPECT_EQ(walked.all.z_m[i], empty.all.z_m[i]);
      continue;
    }
    ++moving;
    EXPECT_NEAR(std::hypot(x + 2, y), 0.25, 0.001) << "on the cylinder";
    EXPECT_LT(std::hypot(x, y), std::hypot(empty.all.x_m[i], empty.all.y_m[i])) << "in front of what was there";
    lowest = std::min(lowest, z), highest = std::max(highest, z), widest = std::max(widest, std::abs(y));
  }
  EXPECT_GT(moving, 1000U);
  EXPECT_NEAR(widest, 0.25, 0.02);
  EXPECT_NEAR(highest, 1.75 - 1.6, 0.03);
  EXPECT_LT(lowest, -1.2);
  EXPECT_EQ(std::count_if(empty.all.truth.flags.begin(), empty.all.truth.flags.end(),
                          [](std::uint8_t f) { return (f & point_flag::kMoving) != 0; }),
            0);
}

TEST_F(AWalkerInTheScan, IsLabelledAsAPersonAndNothingElseIs) {
  const auto walked = scanned({{"field-fault", {"passer_by=0.5"}}}), empty = scanned({});
  EXPECT_EQ(walked.products.back().ifc_class, "Person");
  EXPECT_NE(empty.products.back().ifc_class, "Person") << "a scan without one is as it was";
  for (std::size_t i = 0; i < walked.all.size(); ++i)
    ASSERT_EQ(walked.products[walked.all.product[i]].ifc_class == "Person",
              (walked.all.truth.flags[i] & point_flag::kMoving) != 0);
}

TEST_F(AWalkerInTheScan, StandsAsFarAwayAndAsLongAsIsSaid) {
  const auto stood = scanned({{"field-fault", {"operator_in_view=0.5", "operator_distance=1.5", "operator_from=0.5"}}});
  const auto columns = *std::max_element(stood.all.column.begin(), stood.all.column.end()) + 1;
  std::size_t moving = 0;
  for (std::size_t i = 0; i < stood.all.size(); ++i) {
    if ((stood.all.truth.flags[i] & point_flag::kMoving) == 0) continue;
    ++moving;
    EXPECT_NEAR(std::hypot(stood.all.x_m[i] + 1.5, stood.all.y_m[i]), 0.25, 0.02);
    EXPECT_GE(stood.all.column[i] + 1, columns / 2) << "came when the laser was half round";
  }
  EXPECT_GT(moving, 500U);
}

TEST_F(AWalkerInTheScan, IsNotSeenWhereAWallIsNearer) {
  document_ = run("station", twoStoreyDocument(), {{"add", "S1"}, {"at", {500001.0, 5600002, 1.6}}})
                  ->document;  // the wall is 1 m away
  const auto walked = scanned({{"field-fault", {"passer_by=0.5"}}});
  EXPECT_EQ(std::count_if(walked.all.truth.flags.begin(), walked.all.truth.flags.end(),
                          [](std::uint8_t f) { return (f & point_flag::kMoving) != 0; }),
            0);
}

TEST_F(AWalkerInTheScan, IsTakenOutByASecondPassOfTheLaser) {
  const auto twice = scanned({{"field-fault", {"passer_by=0.5"}}},
                             {"resolution=12mm", "double_scan=on", "images=off", "field_of_view=target_area",
                              "horizontal_from=176", "horizontal_to=184", "vertical_from=-20", "vertical_to=0"},
                             "leica-rtc360");
  ASSERT_GT(twice.all.size(), 1000U);
  for (std::size_t i = 0; i < twice.all.size(); ++i) EXPECT_EQ(twice.all.truth.flags[i] & point_flag::kMoving, 0);
}

TEST_F(AWalkerInTheScan, IsStillThereInASecondPassWhenHeStaysBesideTheScanner) {
  const auto twice = scanned({{"field-fault", {"operator_in_view=0.5"}}},
                             {"resolution=12mm", "double_scan=on", "images=off", "field_of_view=target_area",
                              "horizontal_from=176", "horizontal_to=184", "vertical_from=-20", "vertical_to=0"},
                             "leica-rtc360");
  ASSERT_GT(twice.all.size(), 1000U);
  for (std::size_t i = 0; i < twice.all.size(); ++i) {
    EXPECT_NE(twice.all.truth.flags[i] & point_flag::kMoving, 0);
    EXPECT_NEAR(std::hypot(twice.all.x_m[i] + 0.9, twice.all.y_m[i]), 0.25, 0.02) << "0.9 m away";
  }
}

TEST_F(AWalkerInTheScan, MakesAnotherScanOfIt) {
  const auto guid = [&](const json& more) { return scanned(more).guid; };
  EXPECT_EQ(guid({}), guid({}));
  EXPECT_NE(guid({}), guid({{"field-fault", {"passer_by=0.5"}}}));
  EXPECT_NE(guid({{"field-fault", {"operator_in_view=0.5"}}}), guid({{"field-fault", {"passer_by=0.5"}}}));
  EXPECT_NE(guid({{"field-fault", {"passer_by=0.4"}}}), guid({{"field-fault", {"passer_by=0.5"}}}));
}

TEST_F(AWalkerInTheScan, NotesGoIntoTheFilesRecord) {
  const auto plain = scanned({}), noted = scanned({{"note", {"operator=Ada", "compass=12.5° ± 5°"}}});
  EXPECT_TRUE(noted.description.ends_with("; operator=Ada; compass=12.5° ± 5°")) << noted.description;
  EXPECT_EQ(noted.all.x_m, plain.all.x_m);
  EXPECT_NE(noted.guid, plain.guid);
}

TEST(FieldFault, IsReadAndWhatItIsNotIsRefused) {
  const auto read =
      FieldValue<FieldFault>::read({"passer_by=0.25", "operator_in_view=0.75", "until=0.5", "tripod_moved=0", "noise=2",
                                    "operator_distance=2.5", "operator_until=0.25"});
  ASSERT_TRUE(read);
  EXPECT_EQ(read->passer_by_at_fraction, 0.25);
  EXPECT_EQ(read->operator_at_fraction, 0.75);
  EXPECT_EQ(read->until_fraction, 0.5);
  EXPECT_EQ(read->tripod_moved_at_fraction, 0);
  EXPECT_EQ(read->noise_factor, 2);
  for (const char* wrong : {"passer_by=1.1", "passer_by=-0.1", "passer_by=", "passer_by", "passer_by=x",
                            "passer_by=0.5s", "run=0.5", "noise=0.5", "tripod_moved=nan"})
    EXPECT_FALSE(FieldValue<FieldFault>::read(json::array({wrong}))) << wrong;
}

}  // namespace
}  // namespace standpoint
