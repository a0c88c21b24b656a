// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/scores/kept_points.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "core/random.h"
#include "pointclouds/filters/cleaning.h"
#include "pointclouds/scores/cleaning_scores.h"
#include "tests/pointclouds/same_points.h"

namespace standpoint {
namespace {

struct KeptTruth {
  Eigen::Vector3d at;
  std::uint8_t flags = 0;
  std::uint32_t product = 0;
};

// A scan whose scanner stands at (512, 1024, 8).
void writeKeptTruth(const std::filesystem::path& file, const std::vector<KeptTruth>& points) {
  ScanHeader h;
  h.name = "S1";
  h.guid = "{00000000-0000-4000-8000-000000000007}";
  h.file_from_scanner.translation = {512.25, 1024, 8};
  h.has_labels = h.has_truth = true;
  h.products = {{"#1", "", "IfcWall", "wall"}, {"#2", "", "Pedestrian", "Ada"}, {"#3", "", "IfcSlab", "floor"}};
  h.materials = {"brick"};
  PointBlock b;
  for (const auto& point : points) {
    const Eigen::Vector3f p = (point.at - h.file_from_scanner.translation).cast<float>();
    b.x_m.push_back(p.x()), b.y_m.push_back(p.y()), b.z_m.push_back(p.z()), b.intensity.push_back(0.5F);
    b.row.push_back(0), b.column.push_back(0);
    b.product.push_back(point.product), b.material.push_back(0);
    b.truth.x_m.push_back(p.x()), b.truth.y_m.push_back(p.y()), b.truth.z_m.push_back(p.z());
    b.truth.range_m.push_back(p.norm()), b.truth.incidence_rad.push_back(0), b.truth.received_db.push_back(-20);
    b.truth.flags.push_back(point.flags);
  }
  auto writer = *cloudFormatFor(file)->writer(file);
  ASSERT_TRUE(writer->begin(h) && writer->write(b) && writer->end() && writer->close());
}

void writeKeptText(const std::filesystem::path& file, const std::vector<Eigen::Vector3d>& places, int digits = 6) {
  std::string text;
  char line[128];
  for (const auto& p : places) {
    std::snprintf(line, sizeof line, "%.*f %.*f %.*f\n", digits, p.x(), digits, p.y(), digits, p.z());
    text += line;
  }
  testing::putBytes(file, text);
}

Result<KeptPoints> keptIn(const TemporaryFolder& folder, const KeptOptions& options = {}) {
  Progress progress;
  return keptPoints(folder / "truth.e57", folder / "cleaned.xyz", options, progress);
}

// Points in a room about the scanner, on multiples of 1/1024 m so that the files hold them exactly, 5 mm apart at
// least.
std::vector<KeptTruth> roomOf(std::size_t count) {
  std::vector<KeptTruth> points;
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto draw = philox({11, 0}, i, 0, 0);
    const std::array at = {i % 200, i / 200 % 200, i / 40000};
    KeptTruth point;
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      point.at[axis] = 508 + std::round(1024 * (at[k] * 0.02 + 0.01 * uniform(draw[k]))) / 1024;
    }
    point.at.y() += 512;
    points.push_back(point);
  }
  return points;
}

TEST(KeptPoints, AreFoundWhateverTheOrderTheRoundingAndTheShift) {
  const TemporaryFolder folder;
  const auto truth = roomOf(30'000);
  writeKeptTruth(folder / "truth.e57", truth);
  std::vector<std::size_t> order(truth.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [](auto a, auto b) { return a * 7919 % 30'011 < b * 7919 % 30'011; });
  std::vector<std::uint8_t> expected(truth.size(), 0);
  std::vector<Eigen::Vector3d> left;
  for (const auto i : order)
    if (i % 3 != 1) {
      expected[i] = 1;
      left.push_back(truth[i].at - Eigen::Vector3d(500, 1000, 0));
    }
  writeKeptText(folder / "cleaned.xyz", left, 3);
  const auto found = keptIn(folder);
  ASSERT_OK(found);
  EXPECT_EQ(found->shift_m, Eigen::Vector3d(500, 1000, 0));
  EXPECT_EQ(found->kept, expected);
  EXPECT_EQ(found->doubled + found->unknown, 0u);
  const auto stated = keptIn(folder, {.shift_m = Eigen::Vector3d(500, 1000, 0)});
  ASSERT_OK(stated);
  EXPECT_EQ(stated->kept, expected);
}

TEST(KeptPoints, AreAsManyInAPlaceAsTheCleanedCloudHas) {
  const TemporaryFolder folder;
  std::vector<KeptTruth> truth = {{{510, 1020, 8}}, {{510, 1020, 8}}, {{510, 1020, 8}}, {{511, 1020, 8}}};
  writeKeptTruth(folder / "truth.e57", truth);
  writeKeptText(folder / "cleaned.xyz",
                {{511, 1020, 8}, {510, 1020, 8}, {511, 1020, 8}, {510, 1020, 8}, {512, 1020, 8}});
  const auto found = keptIn(folder);
  ASSERT_OK(found);
  EXPECT_EQ(found->kept, (std::vector<std::uint8_t>{1, 1, 0, 1}));
  EXPECT_EQ(found->doubled, 1u);
  EXPECT_EQ(found->unknown, 1u);
  ASSERT_TRUE(found->first_unknown);
  EXPECT_EQ(*found->first_unknown, Eigen::Vector3d(512, 1020, 8));
}

// Of a row with steps of 0.75 mm the cleaned cloud has all but the first, 0.25 mm off: each is nearer to its own than
// to the one beside it, though both are within the tolerance.
TEST(KeptPoints, AreTheNearestOnes) {
  const TemporaryFolder folder;
  std::vector<KeptTruth> truth;
  std::vector<Eigen::Vector3d> left;
  for (int i = 0; i < 100; ++i) {
    truth.push_back({Eigen::Vector3d(510 + i * 0.75 / 1024, 1020, 8)});
    if (i > 0) left.emplace_back(truth.back().at - Eigen::Vector3d(0.25 / 1024, 0, 0));
  }
  writeKeptTruth(folder / "truth.e57", truth);
  writeKeptText(folder / "cleaned.xyz", left, 9);
  const auto found = keptIn(folder);
  ASSERT_OK(found);
  EXPECT_EQ(found->kept[0], 0);
  EXPECT_EQ(std::count(found->kept.begin(), found->kept.end(), 1), 99);
}

TEST(KeptPoints, OfAnotherPlaceAreAnErrorWithARemedy) {
  const TemporaryFolder folder;
  const auto truth = roomOf(2000);
  writeKeptTruth(folder / "truth.e57", truth);
  std::vector<Eigen::Vector3d> left;
  for (const auto& point : truth) left.push_back(point.at + Eigen::Vector3d(0.3, 0.2, 0.004));
  writeKeptText(folder / "cleaned.xyz", left);
  const auto refused = keptIn(folder);
  ASSERT_FALSE(refused);
  EXPECT_NE(describe(refused.error()).find("--shift"), std::string::npos) << describe(refused.error());
  EXPECT_TRUE(keptIn(folder, {.shift_m = Eigen::Vector3d(-0.3, -0.2, -0.004)}));
  testing::putBytes(folder / "cleaned.xyz", "");
  if (const auto empty = keptIn(folder)) {
    EXPECT_EQ(std::count(empty->kept.begin(), empty->kept.end(), 1), 0);
  }
}

TEST(KeptPoints, StandForTheirNeighboursOfTheSameKindInAThinnedCloud) {
  const TemporaryFolder folder;
  auto truth = roomOf(4000);  // 200 by 20, about 2 cm apart
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (i % 200 < 20) truth[i].flags = point_flag::kMoving, truth[i].product = 1;
  }
  writeKeptTruth(folder / "truth.e57", truth);
  std::vector<Eigen::Vector3d> left;  // all of the walker removed, every fifth of the rest kept
  for (std::size_t i = 0; i < truth.size(); ++i)
    if (truth[i].flags == 0 && i % 5 == 0) left.push_back(truth[i].at);
  writeKeptText(folder / "cleaned.xyz", left);
  auto found = keptIn(folder);
  ASSERT_OK(found);
  Progress progress;
  const auto plain = cleaningScores(folder / "truth.e57", found->kept, progress);
  ASSERT_OK(plain);
  EXPECT_EQ(plain->good.in, 3600u);
  EXPECT_EQ(plain->good.taken, 3600u - left.size());
  const auto stood_for = keepThinned(folder / "truth.e57", 0.1, *found, progress);
  ASSERT_OK(stood_for);
  EXPECT_EQ(*stood_for, plain->good.taken);
  const auto scores = cleaningScores(folder / "truth.e57", found->kept, progress);
  ASSERT_OK(scores);
  EXPECT_EQ(scores->good.taken, 0u);
  EXPECT_EQ(scores->flawed.taken, 400u) << "none of the good ones beside it stands for a walker";
}

TEST(CleaningScores, CountByFlagClassAndMover) {
  const TemporaryFolder folder;
  writeKeptTruth(folder / "truth.e57", {{{510, 1020, 8}},
                                        {{511, 1020, 8}},
                                        {{512, 1020, 8}, 0, 2},
                                        {{513, 1020, 8}, point_flag::kMoving, 1},
                                        {{514, 1020, 8}, point_flag::kMoving | point_flag::kMixed, 1},
                                        {{515, 1020, 8}, point_flag::kMixed, 2},
                                        {{516, 1020, 8}, point_flag::kThroughPane, 0}});
  Progress progress;
  const auto scores = cleaningScores(folder / "truth.e57", {1, 0, 1, 0, 1, 0, 1}, progress);
  ASSERT_OK(scores);
  const auto is = [](const Taken& taken, std::uint64_t in, std::uint64_t removed) {
    EXPECT_EQ(taken.in, in);
    EXPECT_EQ(taken.taken, removed);
  };
  is(scores->points, 7, 3);
  is(scores->good, 4, 1);
  is(scores->flawed, 3, 2);
  is(scores->flags[0], 2, 1);
  is(scores->flags[5], 2, 1);
  ASSERT_EQ(scores->movers.size(), 1u);
  EXPECT_EQ(scores->movers[0].name, "Ada");
  is(scores->movers[0].points, 2, 1);
  ASSERT_EQ(scores->classes.size(), 3u);
  EXPECT_EQ(scores->classes[1].name, "IfcWall");
  is(scores->classes[1].good, 3, 1);
  is(scores->classes[0].flawed, 1, 1);
  EXPECT_FALSE(cleaningScores(folder / "truth.e57", {1, 0}, progress));
}

}  // namespace
}  // namespace standpoint
