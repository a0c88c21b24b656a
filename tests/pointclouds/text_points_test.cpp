// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/text/text_points.h"

#include "tests/pointclouds/kept_scans.h"
#include "tests/pointclouds/made_up_scan.h"

namespace standpoint {
namespace {

using ::testing::HasSubstr;
using testing::KeptScans;

TEST(TextPoints, HaveTheColumnsThatTheirNumberSays) {
  const TemporaryFolder folder;
  struct Case {
    const char* line;
    bool intensity, colour;
  };
  for (const Case& c : {Case{"1 2 3", false, false}, Case{"1,2,3,-77", true, false},
                        Case{"1;2;3;10;20;30", false, true}, Case{"1\t2\t3\t-77\t10\t20\t30", true, true}}) {
    SCOPED_TRACE(c.line);
    testing::putBytes(folder / "a.xyz", std::string("//X Y Z\n") + c.line + "\r\n" + c.line + "\n");
    KeptScans kept;
    ASSERT_OK(readAll(folder / "a.xyz", kept));
    const auto& [header, points, ended] = kept.scans.at(0);
    ASSERT_EQ(points.size(), 2u);
    EXPECT_EQ(points.z_m[1], 3);
    EXPECT_EQ(header.intensity_max > header.intensity_min, c.intensity);
    if (c.intensity) {
      EXPECT_EQ(points.intensity[1], -77);
    }
    EXPECT_EQ(header.has_colour, c.colour);
    if (c.colour) {
      EXPECT_EQ(points.blue[1], 30);
    }
  }
}

TEST(TextPoints, OfSeveralBlocksWithCountsAreReadThrough) {
  const TemporaryFolder folder;
  testing::putBytes(folder / "a.pts", "1\n1 2 3 4\n2\n5 6 7 8\n9 10 11 12\n\n");
  KeptScans kept;
  ASSERT_OK(readAll(folder / "a.pts", kept));
  EXPECT_EQ(kept.scans.at(0).points.size(), 3u);
  EXPECT_EQ(kept.scans.at(0).header.intensity_min, 4);
  EXPECT_EQ(kept.scans.at(0).header.intensity_max, 12);
}

TEST(TextPoints, BehindTheStatedNumberAreLostAloud) {
  const TemporaryFolder folder;
  testing::putBytes(folder / "a.pts", "1\n1 2 3\n4 5 6\n");
  KeptScans kept;
  const auto report = readAll(folder / "a.pts", kept);
  ASSERT_OK(report);
  EXPECT_EQ(kept.scans.at(0).points.size(), 1u);
  EXPECT_EQ(report->losses(), 1u);
  EXPECT_THAT(testing::said(*report), HasSubstr("1 points exceed the specified count"));
}

TEST(HostileTextPoints, AreRefusedWithLineAndReason) {
  const TemporaryFolder folder;
  const std::tuple<const char*, const char*, const char*> bad[] = {
      {"a.pts", "1000000000000\n1 2 3\n", "no space for 1000000000000"},
      {"a.pts", "-1\n1 2 3\n", "must start with its point count"},
      {"a.pts", "3\n1 2 3\n1 2 3 \n", "truncated"},
      {"a.pts", "2\n1 2 3\n1 2 x\n", "a line of numbers"},
      {"a.xyz", "1 2 3\n1 2 3 4\n", "previous points have 3"},
      {"a.xyz", "1 2\n", "at least x y z"},
      {"a.xyz", "1 2 3 300 0 0\n", "outside 0 to 255"},
      {"a.xyz", "words\n", "contains no points"}};
  for (const auto& [name, text, says] : bad) {
    testing::putBytes(folder / name, text);
    KeptScans kept;
    const auto read = readAll(folder / name, kept);
    ASSERT_FALSE(read.has_value()) << says;
    EXPECT_THAT(read.error().message, HasSubstr(says));
    EXPECT_THAT(read.error().source, HasSubstr(" line "));
  }
}

// Its limits are those of the intensities wherever their column stands; points of a second block count, blanks do not.
TEST(TextPoints, HaveTheLimitsOfTheirIntensitiesInAnyColumn) {
  const TemporaryFolder folder;
  const auto limits = [&](const char* name, const std::string& text) {
    testing::putBytes(folder / name, text);
    KeptScans kept;
    EXPECT_TRUE(readAll(folder / name, kept).has_value());
    return std::pair(kept.scans.at(0).header.intensity_min, kept.scans.at(0).header.intensity_max);
  };
  EXPECT_EQ(limits("first.csv", "Intensity,X,Y,Z\n5,1,2,3\n\n-7,100,2,3\n"), std::pair(-7.0, 5.0));
  EXPECT_EQ(limits("last.csv", "X,Y,Z,Intensity\n1,2,3,5\n  \n1,200,3,9\n"), std::pair(5.0, 9.0));
  EXPECT_EQ(limits("blocks.pts", "2\n1 2 3 5\n\n1 2 3 6\n1\n1 2 3 -40\n"), std::pair(-40.0, 6.0));
  EXPECT_EQ(limits("nan.xyz", "1 2 3 5\n1 2 3 nan\n1 2 3 inf\n1 2 3 1e300\n1 2 3 8\n"), std::pair(5.0, 8.0));
  EXPECT_EQ(limits("none.xyz", "1 2 3\n1 2 3\n"), std::pair(0.0, 0.0));
}

}  // namespace
}  // namespace standpoint
