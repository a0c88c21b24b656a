// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;

// Two walks in the lower room, whose inner faces are at x = 0 and 6, y = 0 and 4, z = 0 and 2.8: a short one, and a
// loop past the table.
Document withWalks() {
  auto outcome =
      run("trajectory", twoStoreyDocument(), {{"add", "short"}, {"through", {"500001,5600001", "500002,5600001"}}});
  EXPECT_TRUE(outcome) << describe(outcome.error());
  outcome =
      run("trajectory", outcome->document,
          {{"add", "loop"}, {"through", {"500001,5600001", "500005,5600001", "500005.5,5600003.6", "500001,5600003"}}});
  EXPECT_TRUE(outcome) << describe(outcome.error());
  return outcome->document;
}

const json& rowOf(const json& answer, const char* name) {
  for (const json& row : answer["trajectories"])
    if (row["trajectory"] == name) return row;
  ADD_FAILURE() << name;
  return answer;
}

double blindSum(const json& share) {
  return share["passed_by_m2"].get<double>() + share["sparse_m2"].get<double>() + share["grazing_m2"].get<double>() +
         share["out_of_view_m2"].get<double>() + share["out_of_range_m2"].get<double>() +
         share["occluded_m2"].get<double>() + share["unreachable_m2"].get<double>();
}

TEST(CoverageVerb, ComparesTrajectoriesInOneTable) {
  const auto outcome = run("coverage", withWalks(), {{"instrument", "leica-blk2go"}, {"samples", 8000}});
  ASSERT_TRUE(outcome) << describe(outcome.error());
  const json& answer = outcome->answer;
  const json &brief = rowOf(answer, "short"), &loop = rowOf(answer, "loop");
  EXPECT_NEAR(brief["length_m"].get<double>(), 1, 0.1);
  EXPECT_GT(loop["length_m"].get<double>(), 9);
  EXPECT_GT(loop["fastest_turn_degps"].get<double>(), 20);
  EXPECT_LE(loop["fastest_mps"].get<double>(), 0.91);
  EXPECT_GT(loop["covered_m2"].get<double>(), brief["covered_m2"].get<double>());
  EXPECT_GT(loop["alone_m2"].get<double>(), 0);
  EXPECT_LE(answer["common_m2"].get<double>(), brief["covered_m2"].get<double>() + 1e-9);
  EXPECT_GE(answer["covered_m2"].get<double>(), loop["covered_m2"].get<double>());
  EXPECT_NEAR(answer["covered_m2"].get<double>() + blindSum(answer), answer["exposed_m2"].get<double>(), 1e-6);
  // Nothing of the room above can be seen from below; but it can be walked in.
  for (const json& row : answer["classes"])
    EXPECT_NEAR(row["covered_m2"].get<double>() + blindSum(row), row["exposed_m2"].get<double>(), 1e-6);
  EXPECT_GT(answer["occluded_m2"].get<double>(), 50);
  ASSERT_FALSE(answer["blind"].empty());
  EXPECT_GE(answer["blind"][0]["area_m2"].get<double>(), answer["blind"].back()["area_m2"].get<double>());
  EXPECT_NE(outcome->text.find("together"), std::string::npos);
}

// Nothing is walked yet; what the instrument's kind errs by is expected, and less where closures hold it.
TEST(CoverageVerb, ExpectsHowWellTheTrajectoryWillBeKnown) {
  std::vector<std::string> through;
  for (int lap = 0; lap < 4; ++lap)
    for (const char* place : {"500001,5600001", "500005,5600001", "500005.5,5600003.4", "500001,5600003"})
      through.push_back(place);
  const auto laps = run("trajectory", twoStoreyDocument(), {{"add", "laps"}, {"through", through}});
  ASSERT_TRUE(laps) << describe(laps.error());
  const auto most = [&](json options) {
    options["instrument"] = "leica-blk2go", options["samples"] = 1000;
    const auto outcome = run("coverage", laps->document, options);
    EXPECT_TRUE(outcome) << describe(outcome.error());
    return outcome ? outcome->answer["trajectories"][0]["expected_most_m"].get<double>() : 0;
  };
  const double open = most({{"closures", "off"}}), closed = most({});
  EXPECT_GT(open, 0.0014 * std::sqrt(40.0));  // 1.4 mm by the root of metres, along each axis
  EXPECT_LT(closed, 0.8 * open);
  EXPECT_EQ(most({{"trajectory-error", "none"}}), 0);
}

TEST(CoverageVerb, PredictsWhatTheScanThenHas) {
  const TemporaryFolder folder;
  const Document walks = withWalks();
  const auto scanned = run("scan", walks,
                           {{"trajectory", "loop"},
                            {"instrument", "velodyne-vlp-16"},
                            {"ideal", true},
                            {"output", (folder.path() / "loop.e57").string()}});
  ASSERT_TRUE(scanned) << describe(scanned.error());
  const json asked = {{"trajectories", {"loop"}}, {"samples", 6000}};
  const auto predicted = run("coverage", scanned->document, asked);
  ASSERT_TRUE(predicted) << describe(predicted.error());
  EXPECT_EQ(predicted->answer["trajectories"][0]["instrument"], "velodyne-vlp-16") << "that of the scan";
  json measuring = asked;
  measuring["measured"] = true;
  const auto measured = run("coverage", scanned->document, measuring);
  ASSERT_TRUE(measured) << describe(measured.error());
  EXPECT_TRUE(measured->answer["measured"].get<bool>());
  EXPECT_NEAR(measured->answer["coverage"].get<double>(), predicted->answer["coverage"].get<double>(), 0.03);
  EXPECT_GT(measured->answer["coverage"].get<double>(), 0.15);
}

// Somebody who stands on the scanner's way all the time; with the movers off nobody is there.
TEST(CoverageVerb, CountsWhatMoversHide) {
  auto crowded = run("mover", withWalks(),
                     {{"add", "guard"}, {"kind", "person"}, {"through", {"500003,5600002:3600", "500003.3,5600002"}}});
  ASSERT_TRUE(crowded) << describe(crowded.error());
  json asked = {{"instrument", "leica-blk2go"}, {"samples", 40000}, {"trajectories", {"short"}}, {"density", 2000}};
  const auto hidden = run("coverage", crowded->document, asked);
  ASSERT_TRUE(hidden) << describe(hidden.error());
  EXPECT_GT(hidden->answer["passed_by_m2"].get<double>(), 0.5);
  const auto& blind = hidden->answer["blind"];
  EXPECT_TRUE(
      std::any_of(blind.begin(), blind.end(), [](const json& p) { return p["reason"] == "hidden by a mover"; }));
  asked["movers"] = "off";
  const auto open = run("coverage", crowded->document, asked);
  ASSERT_TRUE(open) << describe(open.error());
  EXPECT_EQ(open->answer["passed_by_m2"], 0);
  EXPECT_NEAR(open->answer["covered_m2"].get<double>(),
              hidden->answer["covered_m2"].get<double>() + hidden->answer["passed_by_m2"].get<double>(), 1e-6);
}

TEST(CoverageVerb, HasTheSameFiguresInEachRun) {
  const Document walks = withWalks();
  const json asked = {{"instrument", "hesai-xt32"}, {"samples", 2000}};
  EXPECT_EQ(run("coverage", walks, asked)->answer, run("coverage", walks, asked)->answer);
}

TEST(CoverageVerb, RefusesWhatCannotBeComparedWithARemedy) {
  const auto refused = [](const Document& document, const json& options, const char* words) {
    const auto outcome = run("coverage", document, options);
    ASSERT_FALSE(outcome) << options;
    EXPECT_NE(describe(outcome.error()).find(words), std::string::npos) << describe(outcome.error());
  };
  refused(twoStoreyDocument(), {{"instrument", "leica-blk2go"}}, "no trajectory yet");
  const Document walks = withWalks();
  refused(walks, json::object(), "specify the instrument");
  refused(walks, {{"instrument", "leica-rtc360"}}, "stands on a tripod");
  refused(walks, {{"measured", true}}, "has not been scanned yet");
  refused(walks, {{"trajectories", {"x"}}, {"instrument", "leica-blk2go"}}, "unknown trajectory 'x'");
}

}  // namespace
}  // namespace standpoint
