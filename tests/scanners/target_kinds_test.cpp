// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/instruments/target_kinds.h"

#include <fstream>

#include <gmock/gmock.h>

#include "tests/scanners/scenes.h"
#include "tests/temporary_folder.h"

namespace standpoint {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

TEST(TargetKinds, AreReadWithASourceForEveryFigure) {
  const auto kinds = readTargetKinds(fs::path(SOURCE_DIR) / "scanners" / "targets" / "kinds.json");
  ASSERT_TRUE(kinds) << describe(kinds.error());
  EXPECT_EQ(kinds->articles.front().id, "sphere-145");
  EXPECT_DOUBLE_EQ(kinds->articles.front().size_m, 0.145);
  EXPECT_EQ(kinds->evidence.size(), kinds->articles.size() + 3);
  for (const auto& [pointer, evidence] : kinds->evidence) EXPECT_FALSE(evidence.source.empty()) << pointer;
}

// The table of instrument-facts.md §4.3: metres at which 60 points (100) are on the target, by a FARO's resolution. Its
// discs are square here.
TEST(TargetKinds, AreMeasuredAsFarAsTheTableOfTheReferenceHasIt) {
  struct Row {
    TargetKind kind;
    double size_m, points, whole, quarter, tenth;
  };
  for (const auto& row :
       {Row{TargetKind::sphere, 0.145, 60, 108.1, 27, 10.8}, Row{TargetKind::sphere, 0.145, 100, 83.8, 20.9, 8.4},
        Row{TargetKind::sphere, 0.2, 60, 149.2, 37.3, 14.9}, Row{TargetKind::checkerboard, 0.15, 60, 126.2, 31.6, 12.6},
        Row{TargetKind::checkerboard, 0.15, 100, 97.8, 24.4, 9.8}}) {
    Target target;
    target.kind = row.kind, target.size_m = row.size_m;
    for (const auto& [resolution, metres] :
         {std::pair{"1/1", row.whole}, std::pair{"1/4", row.quarter}, std::pair{"1/10", row.tenth}}) {
      const auto settings =
          resolveSettings(testing::instrument("faro-focus-s350"), {{"resolution", resolution}, {"quality", "4x"}});
      ASSERT_TRUE(settings) << settings.error().message;
      EXPECT_NEAR(distanceFor(target, row.points, *settings), metres, 0.001 * metres + 0.05);
      EXPECT_NEAR(pointsOn(target, metres, 0, *settings), row.points, 0.02 * row.points);
    }
  }
}

TEST(TargetKinds, SayWhatIsWrongWithTheirFileAndWhere) {
  const TemporaryFolder folder;
  const fs::path file = folder / "kinds.json";
  const auto refused = [&](const std::string& kinds) {
    std::ofstream(file)
        << R"({"sources": {"S1": "a paper"}, "rules": {"source": "S1", "least_points": 60, "most_distance_m": 100, )"
        << R"("most_incidence_deg": 60}, "kinds": )" << kinds << "}";
    const auto read = readTargetKinds(file);
    return read ? std::string("read") : describe(read.error());
  };
  const std::string one = R"({"id": "a", "label": "A", "shape": "sphere", "size_mm": {"value": 145, "source": "S1"}})";
  EXPECT_EQ(refused("[" + one + "]"), "read");
  EXPECT_THAT(refused("[" + one + "," + one + "]"), HasSubstr("/kinds/1/id: \"a\" is duplicated"));
  EXPECT_THAT(refused(R"([{"id": "a", "label": "A", "shape": "cube", "size_mm": {"value": 145, "source": "S1"}}])"),
              HasSubstr("/kinds/0/shape"));
  EXPECT_THAT(refused(R"([{"id": "a", "label": "A", "shape": "sphere", "size_mm": {"value": 145, "source": "S9"}}])"),
              HasSubstr("S9"));
  EXPECT_THAT(refused(R"([{"id": "a", "label": "A", "shape": "sphere", "size_mm": {"value": -3, "source": "S1"}}])"),
              HasSubstr("a number from 10 to 2000, not the number -3"));
  EXPECT_THAT(refused("[]"), HasSubstr("/kinds"));
}

}  // namespace
}  // namespace standpoint
