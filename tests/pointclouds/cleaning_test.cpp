// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/filters/cleaning.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "core/random.h"
#include "pointclouds/scores/cleaning_scores.h"
#include "tests/pointclouds/same_points.h"

namespace standpoint {
namespace {

using testing::KeptScans;

// A scan whose points are made by a function of the beam; nothing where it says 0.
struct MadeScan {
  std::string name = "S1";
  Eigen::Vector3d at{0.25, 0.5, 1.75};
  std::uint32_t rows = 100, columns = 100;
  double step_rad = 0.001;
  double lowest_rad = -0.05;
  std::function<double(std::uint32_t column, std::uint32_t row, const Eigen::Vector3d& beam)> range_m;
  std::function<std::uint8_t(std::uint32_t column, std::uint32_t row)> flags = [](auto, auto) {
    return std::uint8_t{0};
  };
  double range_off_m = 0;  // of the points; the truth has none of it
  bool grid = true;
};

void writeMade(const std::filesystem::path& file, const std::vector<MadeScan>& scans) {
  auto writer = cloudFormatFor(file)->writer(file);
  ASSERT_OK(writer);
  for (const MadeScan& scan : scans) {
    ScanHeader header;
    header.name = scan.name;
    header.guid = "{" + scan.name + "}";
    header.file_from_scanner.translation = scan.at;
    if (scan.grid) header.rows = scan.rows, header.columns = scan.columns;
    header.has_labels = header.has_truth = true;
    header.products = {{"#1", "", "IfcWall", "wall"}};
    header.materials = {"plaster"};
    PointBlock b;
    for (std::uint32_t column = 0; column < scan.columns; ++column)
      for (std::uint32_t row = 0; row < scan.rows; ++row) {
        const double azimuth = -scan.step_rad * (column - scan.columns / 2.0),
                     elevation = scan.lowest_rad + scan.step_rad * row;
        const Eigen::Vector3d beam(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                   std::sin(elevation));
        const double range = scan.range_m(column, row, beam);
        if (range <= 0) continue;
        const Eigen::Vector3f p = ((range + scan.range_off_m) * beam).cast<float>();
        b.x_m.push_back(p.x()), b.y_m.push_back(p.y()), b.z_m.push_back(p.z());
        b.intensity.push_back(static_cast<float>(row) / static_cast<float>(scan.rows));
        b.row.push_back(row), b.column.push_back(column), b.product.push_back(0), b.material.push_back(0);
        b.truth.x_m.push_back(p.x()), b.truth.y_m.push_back(p.y()), b.truth.z_m.push_back(p.z());
        b.truth.range_m.push_back(static_cast<float>(range)),
            b.truth.incidence_rad.push_back(0.01F * static_cast<float>(column));
        b.truth.received_db.push_back(-20), b.truth.flags.push_back(scan.flags(column, row));
      }
    ASSERT_OK((*writer)->begin(header));
    ASSERT_OK((*writer)->write(b));
    ASSERT_OK((*writer)->end());
  }
  ASSERT_OK((*writer)->close());
}

Result<Cleaning> clean(const std::filesystem::path& in, const std::filesystem::path& out,
                       const std::vector<std::string>& words) {
  std::vector<ChosenFilter> filters;
  for (const auto& text : words) {
    auto chosen = filterFrom(text);
    if (!chosen) return failure(chosen.error());
    filters.push_back(*std::move(chosen));
  }
  Progress progress;
  return cleanCloud(in, out, filters, progress);
}

std::vector<Eigen::Vector3d> places(const std::filesystem::path& file) {
  KeptScans kept;
  EXPECT_TRUE(testing::readAll(file, kept).has_value());
  std::vector<Eigen::Vector3d> all;
  for (const auto& scan : kept.scans)
    for (std::size_t i = 0; i < scan.points.size(); ++i)
      all.push_back(scan.header.file_from_scanner *
                    Eigen::Vector3d(scan.points.x_m[i], scan.points.y_m[i], scan.points.z_m[i]));
  return all;
}

// A wall at 5 m before a wall at 6 m, and between them one or two columns where the beams met both.
MadeScan edge(bool two_columns) {
  MadeScan scan;
  const auto isMixed = [two_columns](std::uint32_t column) { return column == 50 || (two_columns && column == 51); };
  scan.range_m = [isMixed](std::uint32_t column, std::uint32_t row, const Eigen::Vector3d& beam) {
    if (isMixed(column)) return column == 50 ? 5.3 + 0.001 * row : 5.75;
    return (column < 50 ? 5 : 6) / beam.x();
  };
  scan.flags = [isMixed](std::uint32_t column, std::uint32_t) {
    return isMixed(column) ? point_flag::kMixed : std::uint8_t{0};
  };
  return scan;
}

MadeScan wall(const std::string& name, double x_of_station) {
  MadeScan scan;
  scan.name = name;
  scan.at = {x_of_station, 0, 0.125};
  scan.range_m = [x_of_station](auto, auto, const Eigen::Vector3d& beam) { return (5 - x_of_station) / beam.x(); };
  return scan;
}

TEST(Cleaning, FindsTheMixedPointsAtAnEdgeAndNothingElse) {
  const TemporaryFolder folder;
  for (const bool two_columns : {false, true}) {
    writeMade(folder / "in.e57", {edge(two_columns)});
    const auto done = clean(folder / "in.e57", folder / "out.e57", {"mixed"});
    ASSERT_OK(done);
    const FilterFigures& f = done->filters[0];
    EXPECT_EQ(f.flags[0].in, two_columns ? 200u : 100u);
    EXPECT_EQ(f.flags[0].taken, f.flags[0].in);
    EXPECT_EQ(f.good.taken, 0u);
    EXPECT_EQ(f.good.in, two_columns ? 9800u : 9900u);
    EXPECT_EQ(f.good_of_class.at("IfcWall").in, f.good.in);
    EXPECT_EQ(done->points_out, f.good.in);
  }
}

TEST(Cleaning, TakesAsStrayWhatTooFewPointsAroundItAreAsFarAs) {
  const TemporaryFolder folder;
  writeMade(folder / "in.e57", {edge(true)});
  const auto done = clean(folder / "in.e57", folder / "out.e57", {"stray"});
  ASSERT_OK(done);
  EXPECT_EQ(done->filters[0].flags[0].taken, 200u);  // two of eight neighbours agree
  EXPECT_EQ(done->filters[0].good.taken, 0u);        // beside the edge five of eight do
  const auto lenient = clean(folder / "in.e57", folder / "out.e57", {"stray:share=0.25"});
  ASSERT_OK(lenient);
  EXPECT_EQ(lenient->filters[0].points.taken, 4u);  // at each end of the two columns one of five agrees
  const auto coarse = clean(folder / "in.e57", folder / "out.e57", {"stray:distance=1"});
  ASSERT_OK(coarse);
  EXPECT_EQ(coarse->filters[0].points.taken, 0u);
}

TEST(Cleaning, TakesAsStrayThinThingsAndWhatStandsAlone) {
  const TemporaryFolder folder;
  MadeScan scan;  // a wire of one column before a wall, and a point far from all others
  scan.range_m = [](std::uint32_t column, std::uint32_t row, const Eigen::Vector3d& beam) {
    if (column == 20) return 3 / beam.x();
    if (column > 80) return column == 90 && row == 50 ? 4.0 : 0.0;
    return 5 / beam.x();
  };
  writeMade(folder / "in.e57", {scan});
  const auto done = clean(folder / "in.e57", folder / "out.e57", {"stray"});
  ASSERT_OK(done);
  EXPECT_EQ(done->filters[0].points.taken, 101u);
}

// A wall at 5 m with 3 mm of noise and somebody 3 m away before it, from column `from` to `to`.
MadeScan corridor(const std::string& name, std::uint32_t from, std::uint32_t to, std::uint64_t seed) {
  MadeScan scan;
  scan.name = name;
  scan.columns = 300;
  const auto walks = [from, to](std::uint32_t column, std::uint32_t row) {
    return column >= from && column < to && row >= 10 && row < 90;
  };
  scan.range_m = [walks, seed](std::uint32_t column, std::uint32_t row, const Eigen::Vector3d& beam) {
    const auto draw = philox({seed, 0}, column, row, 0);
    const double noise =
        0.003 * (uniform(draw[0]) + uniform(draw[1]) + uniform(draw[2]) + uniform(draw[3]) - 2) * 1.732;
    return (walks(column, row) ? 3.0 : 5 / beam.x()) + noise;
  };
  scan.flags = [walks](std::uint32_t column, std::uint32_t row) {
    return walks(column, row) ? point_flag::kMoving : std::uint8_t{0};
  };
  return scan;
}

TEST(Cleaning, TakesAsMovingWhatAnotherScanSawPast) {
  const TemporaryFolder folder;
  const MadeScan first = corridor("S1", 40, 90, 1), second = corridor("S2", 180, 230, 2);
  writeMade(folder / "a.e57", {first});
  writeMade(folder / "b.e57", {second});
  writeMade(folder / "both.e57", {first, second});
  const auto against = "moving:cell=0.1,against=" + (folder / "b.e57").string();
  const auto done = clean(folder / "a.e57", folder / "out.e57", {against});
  ASSERT_OK(done);
  const Taken moving = done->filters[0].flags[5];
  EXPECT_EQ(moving.in, 4000u);
  EXPECT_EQ(moving.taken, 4000u);
  EXPECT_EQ(done->filters[0].good.taken, 0u);
  const auto together = clean(folder / "both.e57", folder / "out.e57", {"moving:cell=0.1"});
  ASSERT_OK(together);
  EXPECT_EQ(together->filters[0].flags[5].taken, 8000u);
  EXPECT_EQ(together->filters[0].good.taken, 0u);
  // Who stays is in both.
  writeMade(folder / "still.e57", {first, corridor("S2", 40, 90, 3)});
  const auto stays = clean(folder / "still.e57", folder / "out.e57", {"moving:cell=0.1"});
  ASSERT_OK(stays);
  EXPECT_EQ(stays->filters[0].points.taken, 0u);
  const auto alone = clean(folder / "a.e57", folder / "out.e57", {"moving"});
  ASSERT_FALSE(alone);
  EXPECT_NE(describe(alone.error()).find("moving:against=FILE"), std::string::npos);
  EXPECT_FALSE(clean(folder / "a.e57", folder / "out.e57", {"moving:against=" + (folder / "none.e57").string()}));
}

TEST(Cleaning, LeavesAFloorThatIsSeenVeryFlatly) {
  const TemporaryFolder folder;
  MadeScan floor;  // 1.7 m below, from 15 to 68 m: up to 88.6° of incidence
  floor.lowest_rad = -0.113;
  floor.rows = 89;
  floor.range_m = [](auto, auto, const Eigen::Vector3d& beam) { return -1.7 / beam.z(); };
  writeMade(folder / "in.e57", {floor});
  const auto done = clean(folder / "in.e57", folder / "out.e57", {"mixed"});
  ASSERT_OK(done);
  EXPECT_LE(done->filters[0].points.taken, 4u);  // on diagonals across the scan's corners
  EXPECT_EQ(done->filters[0].points.in, 8900u);
}

TEST(Cleaning, FindsMixedPointsWithoutAGridByWhatLiesAroundThem) {
  const TemporaryFolder folder;
  MadeScan scan;
  scan.grid = false;
  scan.range_m = [](std::uint32_t column, std::uint32_t row, const Eigen::Vector3d& beam) {
    return column == 50 ? 5 + 0.01 * row : (column < 50 ? 5 : 6) / beam.x();
  };
  scan.flags = [](std::uint32_t column, std::uint32_t row) {
    return column == 50 && row > 5 && row < 95 ? point_flag::kMixed : std::uint8_t{0};
  };
  writeMade(folder / "in.e57", {scan});
  const auto done = clean(folder / "in.e57", folder / "out.e57", {"mixed"});
  ASSERT_OK(done);
  EXPECT_GT(done->filters[0].flags[0].taken, 70u);  // of 89
  EXPECT_LT(done->filters[0].good.taken, 20u);
  const auto refused = clean(folder / "in.e57", folder / "out.e57", {"mixed:by=grid"});
  ASSERT_FALSE(refused);
  EXPECT_NE(describe(refused.error()).find("no grid of rows"), std::string::npos) << describe(refused.error());
}

TEST(Cleaning, KeepsOfDuplicatesTheOneWithTheSmallerRange) {
  const TemporaryFolder folder;
  writeMade(folder / "in.e57", {wall("far", 0.5), wall("near", 3.5)});
  const auto done = clean(folder / "in.e57", folder / "out.e57", {"duplicates:distance=0.004"});
  ASSERT_OK(done);
  const auto kept = places(folder / "out.e57");
  ASSERT_EQ(kept.size(), done->points_out);
  for (std::size_t i = 0; i < kept.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) ASSERT_GE((kept[i] - kept[k]).norm(), 0.004 - 1e-6);
  // The near station sees 15 cm by 15 cm of the wall, and there no point of the far one stays.
  KeptScans scans;
  ASSERT_OK(testing::readAll(folder / "out.e57", scans));
  ASSERT_EQ(scans.scans.size(), 2u);
  const PointBlock& far = scans.scans[0].points;
  EXPECT_GT(far.size(), 5000u);
  for (std::size_t i = 0; i < far.size(); ++i) EXPECT_FALSE(std::abs(far.y_m[i]) < 0.07 && std::abs(far.z_m[i]) < 0.07);
}

TEST(Cleaning, FindsPointsThatStandAlone) {
  const TemporaryFolder folder;
  MadeScan scan = wall("S1", 0.5);
  const auto alone = [](std::uint32_t column, std::uint32_t row) { return column % 30 == 10 && row % 30 == 10; };
  scan.flags = [alone](auto column, auto row) { return alone(column, row) ? point_flag::kWeather : std::uint8_t{0}; };
  scan.range_m = [alone](auto column, auto row, const Eigen::Vector3d& beam) {
    return alone(column, row) ? 2.0 : 4.5 / beam.x();
  };
  writeMade(folder / "in.e57", {scan});
  const auto done = clean(folder / "in.e57", folder / "out.e57", {"outliers"});
  ASSERT_OK(done);
  EXPECT_EQ(done->filters[0].flags[3].in, 9u);
  EXPECT_EQ(done->filters[0].flags[3].taken, 9u);
  EXPECT_LE(done->filters[0].good.taken, 4u);  // the corners of the scan have their neighbours on one side
}

TEST(Cleaning, KeepsTheNearestToTheCentreOfEachCell) {
  const TemporaryFolder folder;
  writeMade(folder / "in.e57", {wall("S1", 0.5), wall("S2", 1.5)});
  ASSERT_OK(clean(folder / "in.e57", folder / "out.e57", {"voxel:cell=0.03"}));
  const auto cellOf = [](const Eigen::Vector3d& p) {
    return std::array<double, 3>{std::floor(p.x() / 0.03), std::floor(p.y() / 0.03), std::floor(p.z() / 0.03)};
  };
  const auto off = [&](const Eigen::Vector3d& p) {
    const auto c = cellOf(p);
    return (p - 0.03 * Eigen::Vector3d(c[0] + 0.5, c[1] + 0.5, c[2] + 0.5)).norm();
  };
  std::map<std::array<double, 3>, double> nearest;
  for (const auto& p : places(folder / "in.e57")) {
    const auto [at, fresh] = nearest.try_emplace(cellOf(p), off(p));
    at->second = std::min(at->second, off(p));
  }
  const auto kept = places(folder / "out.e57");
  ASSERT_EQ(kept.size(), nearest.size());
  for (const auto& p : kept) EXPECT_EQ(nearest.at(cellOf(p)), off(p));
}

TEST(Cleaning, ThinsByChanceAndByCount) {
  const TemporaryFolder folder;
  writeMade(folder / "in.e57", {wall("S1", 0.5)});
  const auto some = clean(folder / "in.e57", folder / "a.e57", {"share:keep=0.25", "every:n=10"});
  ASSERT_OK(some);
  EXPECT_NEAR(static_cast<double>(some->filters[1].points.in), 2500, 4 * std::sqrt(10000 * 0.25 * 0.75));
  EXPECT_EQ(some->points_out, (some->filters[1].points.in + 9) / 10);
  ASSERT_OK(clean(folder / "in.e57", folder / "b.e57", {"share:keep=0.25", "every:n=10"}));
  EXPECT_EQ(testing::bytesOf(folder / "a.e57"), testing::bytesOf(folder / "b.e57"));
  ASSERT_OK(clean(folder / "in.e57", folder / "b.e57", {"share:keep=0.25,seed=2", "every:n=10"}));
  EXPECT_NE(places(folder / "a.e57"), places(folder / "b.e57"));
}

TEST(Cleaning, CropsToEitherSide) {
  const TemporaryFolder folder;
  writeMade(folder / "in.e57", {wall("S1", 0.5), wall("S2", 1.5)});
  for (const std::string crop :
       {"box:from=0/0/0.1,to=9/9/9", "sphere:station=S2,radius=3.502", "sphere:at=5/0/0,radius=0.1"}) {
    const auto in = clean(folder / "in.e57", folder / "a.e57", {crop});
    const auto out = clean(folder / "in.e57", folder / "b.e57", {crop + ",keep=outside"});
    ASSERT_OK(in);
    ASSERT_OK(out);
    EXPECT_GT(in->points_out, 500u) << crop;
    EXPECT_GT(out->points_out, 500u) << crop;
    EXPECT_EQ(in->points_out + out->points_out, 20000u);
  }
  ASSERT_OK(clean(folder / "in.e57", folder / "a.e57", {"sphere:at=5/0/0,radius=0.1"}));
  for (const auto& p : places(folder / "a.e57")) EXPECT_LE((p - Eigen::Vector3d(5, 0, 0)).norm(), 0.1);
}

TEST(Cleaning, GatesByRangeIntensityAndIncidence) {
  const TemporaryFolder folder;
  writeMade(folder / "in.e57", {edge(false)});
  const auto done =
      clean(folder / "in.e57", folder / "out.e57", {"range:to=5.2", "intensity:from=0.5", "incidence:to=10"});
  ASSERT_OK(done);
  EXPECT_EQ(done->filters[0].points.in - done->filters[0].points.taken, 5000u);  // the near wall
  EXPECT_EQ(done->filters[1].points.in - done->filters[1].points.taken, 2500u);  // its upper half
  EXPECT_EQ(done->points_out, 18u * 50);                                         // columns 0 to 17: 0.01 rad each
}

TEST(Cleaning, CarriesEveryChannelOfEveryScan) {
  const TemporaryFolder folder;
  const std::vector<ScanHeader> headers = {
      testing::madeUpHeader({.name = "S1", .all_channels = true}),
      testing::madeUpHeader({.colour = false, .name = "S2", .all_channels = true})};
  testing::writeFile(folder / "in.e57", headers);
  const auto done = clean(folder / "in.e57", folder / "out.e57", {"range:from=0,to=8"});
  ASSERT_OK(done);
  KeptScans before, after;
  ASSERT_OK(testing::readAll(folder / "in.e57", before));
  ASSERT_OK(testing::readAll(folder / "out.e57", after));
  ASSERT_EQ(after.scans.size(), 2u);
  std::uint64_t left = 0;
  for (std::size_t s = 0; s < 2; ++s) {
    const PointBlock &all = before.scans[s].points, &some = after.scans[s].points;
    EXPECT_NE(after.scans[s].header.guid, before.scans[s].header.guid);
    std::size_t k = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (Eigen::Vector3d(all.x_m[i], all.y_m[i], all.z_m[i]).norm() > 8) continue;
      ASSERT_LT(k, some.size());
      EXPECT_EQ(all.x_m[i], some.x_m[k]);
      EXPECT_EQ(all.time_s[i], some.time_s[k]);
      EXPECT_EQ(all.product[i], some.product[k]);
      EXPECT_EQ(all.material[i], some.material[k]);
      EXPECT_EQ(all.return_number[i], some.return_number[k]);
      EXPECT_EQ(all.truth.z_m[i], some.truth.z_m[k]);
      EXPECT_EQ(all.truth.flags[i], some.truth.flags[k]);
      if (s == 0) {
        EXPECT_EQ(all.green[i], some.green[k]);
      }
      ++k;
    }
    EXPECT_EQ(k, some.size());
    left += k;
  }
  EXPECT_EQ(left, done->points_out);
  EXPECT_LT(left, done->points_in);
}

// Points of a scan along a trajectory are about no scanner: how far they are from where they begin says nothing.
TEST(Cleaning, KnowsWhatIsPlainlyMixedOnlyWhereAScannerStood) {
  const TemporaryFolder folder;
  for (const bool carried : {false, true}) {
    MadeScan scan = edge(false);
    scan.range_off_m = 0.02;
    if (carried) scan.at = {3, 4, 1}, scan.grid = false;
    const auto file = folder / (carried ? "carried.e57" : "stood.e57");
    writeMade(file, {scan});
    const std::uint64_t expected = carried ? 0 : 100;
    const auto done = clean(file, folder / "out.e57", {"intensity:from=0,to=1"});
    ASSERT_OK(done);
    EXPECT_EQ(done->filters[0].flags[0].in, 100U);
    EXPECT_EQ(done->filters[0].plainly_mixed.in, expected);
    Progress progress;
    const auto scores = cleaningScores(file, std::vector<std::uint8_t>(done->points_in, 1), progress);
    ASSERT_OK(scores);
    EXPECT_EQ(scores->flags[0].in, 100U);
    EXPECT_EQ(scores->plainly_mixed.in, expected);
  }
}

TEST(Cleaning, SaysWhatCannotBe) {
  const TemporaryFolder folder;
  writeMade(folder / "in.e57", {wall("S1", 0.5)});
  testing::putBytes(folder / "plain.xyz", "1 2 3\n2 3 4\n3 4 5\n");
  const std::vector<std::pair<std::string, std::string>> words = {
      {"polish", "unknown filter 'polish'"},
      {"range", "requires 'from' or 'to'"},
      {"range:from=3,to=2", "larger than 'to'"},
      {"range:from=-1", "must be from 0"},
      {"range:from=nan", "must be a number"},
      {"range:from=1,from=2", "given twice"},
      {"range:far=3", "valid keys: from, to"},
      {"range:", "valid keys: from, to"},
      {"voxel", "'cell' is missing"},
      {"voxel:cell=0", "must be from 1e-04"},
      {"every:n=1.5", "whole number"},
      {"share:keep=2", "must be from 0 to 1"},
      {"box:from=1/2,to=3/4/5", "three numbers"},
      {"box:from=3/0/0,to=1/1/1", "the box is empty"},
      {"sphere:radius=1", "requires 'station' or 'at'"},
      {"sphere:radius=1,station=S9", "unknown station 'S9'; available: S1"},
      {"mixed:by=eye", "grid or distance"},
      {"stray:window=4", "'window' must be odd"},
      {"duplicates:distance=", "must be a number"}};
  for (const auto& [word, why] : words) {
    const auto refused = clean(folder / "in.e57", folder / "out.e57", {word});
    ASSERT_FALSE(refused) << word;
    EXPECT_NE(describe(refused.error()).find(why), std::string::npos) << describe(refused.error());
    EXPECT_FALSE(std::filesystem::exists(folder / "out.e57"));
  }
  for (const std::string word : {"range:to=3", "mixed", "stray", "incidence:to=60", "intensity:to=1"})
    EXPECT_FALSE(clean(folder / "plain.xyz", folder / "out.e57", {word})) << word;
}

TEST(Cleaning, OfAnEmptyCloudIsAnEmptyCloud) {
  const TemporaryFolder folder;
  MadeScan nothing = wall("S1", 0.5);
  nothing.range_m = [](auto, auto, const auto&) { return 0.0; };
  writeMade(folder / "in.e57", {nothing});
  const auto done =
      clean(folder / "in.e57", folder / "out.e57", {"mixed", "outliers", "duplicates", "voxel:cell=1", "every:n=2"});
  ASSERT_OK(done);
  EXPECT_EQ(done->points_out, 0u);
}

}  // namespace
}  // namespace standpoint
