// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/orientation.h"

#include <gtest/gtest.h>

#include "core/units.h"

namespace standpoint {
namespace {

using Eigen::Vector3d;

// A station at a known place, turned by 40 degrees, that measures places without error.
class Orientation : public testing::Test {
 protected:
  Orientation() {
    truth.rotation = Eigen::AngleAxisd(40 * kRadPerDeg, Vector3d::UnitZ());
    truth.translation = {100, 200, 51.7};
    for (const auto& [name, place] : {std::pair<const char*, Vector3d>{"T1", {110, 200, 52}},
                                      {"T2", {95, 215, 50}},
                                      {"T3", {90, 190, 55}},
                                      {"T4", {120, 220, 51}}}) {
      known.push_back({name, place});
      sighted.push_back({name, truth.rotation.conjugate() * (place - truth.translation), 0, 0.001, 80, true});
    }
  }
  Result<StationOrientation> solved(const std::string& method, std::size_t targets, bool compensator = true) {
    OrientationTask task{method,     "S1", {sighted.begin(), sighted.begin() + static_cast<long>(targets)},
                         known,      axis, azimuth,
                         compensator};
    return solveOrientation(task);
  }
  void expectTruth(const Result<StationOrientation>& got) {
    ASSERT_TRUE(got) << got.error().message;
    EXPECT_LT((got->pose.translation - truth.translation).norm(), 1e-9);
    EXPECT_LT(got->pose.rotation.angularDistance(truth.rotation), 1e-7);
  }

  Pose truth;
  std::vector<ControlPlace> known;
  std::vector<SightedTarget> sighted;
  std::optional<Vector3d> axis;
  double azimuth = 0;
};

TEST_F(Orientation, EachResectionFindsTheStationAgain) {
  expectTruth(solved("resection_4", 2));
  expectTruth(solved("resection_4", 4));
  expectTruth(solved("resection_6", 3));
  expectTruth(solved("traverse", 2));
}

TEST_F(Orientation, AutoResectionNeedsNoNames) {
  for (auto& s : sighted) s.id = std::string(1, '?');
  expectTruth(solved("auto", 4));
  EXPECT_FALSE(solved("resection_6", 4));
}

TEST_F(Orientation, OverAMarkTheDirectionComesFromTheTypedAzimuthOrTheBacksight) {
  axis = truth.translation;
  azimuth = 90;  // T1 lies due east
  expectTruth(solved("azimuth", 1));
  expectTruth(solved("backsight", 1));
  azimuth = 90 - 40;  // of the scanner's zero
  expectTruth(solved("quick", 0));
  azimuth = 91;
  const auto wrong = solved("azimuth", 4);
  EXPECT_NEAR(wrong->pose.rotation.angularDistance(truth.rotation) / kRadPerDeg, 1, 1e-6);
  EXPECT_GT(wrong->rms_m, 0.2) << "the other targets tell";
  axis.reset();
  EXPECT_EQ(solved("backsight", 1).error().message, "no_known_mark");
}

TEST_F(Orientation, TooFewTargetsAreRefusedByTheMethodsRule) {
  EXPECT_FALSE(solved("resection_4", 1));
  EXPECT_FALSE(solved("resection_6", 2));
  EXPECT_FALSE(solved("resection_6", 3, false)) << "four with the compensator off";
  EXPECT_TRUE(solved("resection_6", 4, false));
  EXPECT_TRUE(solved("standard", 0)->local);
}

TEST_F(Orientation, SwappedNamesShowInTheResiduals) {
  EXPECT_LT(solved("resection_6", 4)->rms_m, 1e-9);
  std::swap(sighted[0].id, sighted[1].id);
  EXPECT_GT(solved("resection_6", 4)->rms_m, 1);
}

TEST_F(Orientation, AWrongTargetHeightShowsAndAnExcludedTargetDoesNot) {
  sighted[3].height_m = 0.1;
  EXPECT_GT(solved("resection_4", 4)->rms_m, 0.04);
  sighted[3].used = false;
  EXPECT_LT(solved("resection_4", 4)->rms_m, 1e-9);
}

TEST_F(Orientation, ArrangementsThatGiveNoDirectionAreRefused) {
  sighted[1] = sighted[0];
  known[1] = known[0];
  sighted[1].id = known[1].name = "T2";
  EXPECT_EQ(solved("resection_4", 2).error().message, "targets_in_one_place");
  for (int i = 0; i < 4; ++i) known[i].place_m = sighted[i].place_m = Vector3d(i, 2 * i, 0);
  EXPECT_EQ(solved("resection_6", 4).error().message, "targets_on_a_line");
}

}  // namespace
}  // namespace standpoint
