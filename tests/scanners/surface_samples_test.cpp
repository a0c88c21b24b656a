// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/forecast/surface_samples.h"

#include <fstream>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scanners/instruments/stand.h"
#include "tests/scanners/scenes.h"
#include "tests/temporary_folder.h"

namespace standpoint {
namespace {

using ::testing::HasSubstr;
using testing::SceneBuilder;

SurfaceSamples samplesOf(const SceneBuilder& scene, std::size_t count, std::uint64_t seed = 1) {
  Progress progress;
  const auto samples = sampleSurfaces(*scene.build(), count, seed, progress);
  EXPECT_TRUE(samples);
  return *samples;
}

TEST(SurfaceSamples, StandForEqualAreasOnEveryFace) {
  SceneBuilder scene;
  scene.box({0, 0, 0}, {1, 2, 4}, false);  // faces of 2, 4 and 8 m², two of each
  const auto s = samplesOf(scene, 28000);
  EXPECT_NEAR(s.area_m2, 28, 1e-9);
  ASSERT_EQ(s.samples.size(), 28000U);
  std::map<int, int> by_axis;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& sample : s.samples) {
    int axis = 0;
    sample.place.normal.cwiseAbs().maxCoeff(&axis);
    by_axis[axis] += 1;
    mean += sample.place.position;
    EXPECT_TRUE(sample.exposed);
  }
  EXPECT_NEAR(by_axis[2], 4000, 3);
  EXPECT_NEAR(by_axis[1], 8000, 3);
  EXPECT_NEAR(by_axis[0], 16000, 3);
  EXPECT_LT((mean / 28000 - Eigen::Vector3d(0.5, 1, 2)).norm(), 0.002) << "evenly: by chance it would be 0.01 off";
}

TEST(SurfaceSamples, LeaveOutWhereBodiesTouchAndCountASharedFaceOnce) {
  SceneBuilder scene;
  scene.box({0, 0, 0}, {1, 1, 1}, false);
  scene.box({0, 0, 1}, {1, 1, 2}, false);  // stands on the first: 2 of 12 m² touch
  const auto stacked = samplesOf(scene, 12000);
  const auto exposed = [](const SurfaceSamples& s) {
    return std::count_if(s.samples.begin(), s.samples.end(), [](const auto& x) { return x.exposed; });
  };
  EXPECT_NEAR(static_cast<double>(exposed(stacked)) / 12000, 10.0 / 12, 0.004);
  SceneBuilder flush;
  flush.box({0, 0, 0}, {1, 1, 1}, false);
  flush.box({0.25, 0.25, 0.5}, {0.75, 0.75, 1}, false);  // inside of the first, up to its top: 0.25 m² are of both
  const auto s = samplesOf(flush, 15000);
  EXPECT_NEAR(s.area_m2, 7.5, 1e-6);
  EXPECT_NEAR(static_cast<double>(exposed(s)) * s.each_m2(), 6, 0.06);
}

TEST(SurfaceSamples, AreTheSameAgainAndOthersForAnotherSeed) {
  SceneBuilder scene;
  scene.sphere({0, 0, 0}, 1, 20);
  const auto a = samplesOf(scene, 500), b = samplesOf(scene, 500), c = samplesOf(scene, 500, 2);
  EXPECT_EQ(a.samples[77].place.position, b.samples[77].place.position);
  EXPECT_NE(a.samples[77].place.position, c.samples[77].place.position);
}

TEST(SurfaceSamples, OfNothingAreNone) {
  SceneBuilder scene;
  scene.hide(scene.box({0, 0, 0}, {1, 1, 1}, false));
  EXPECT_TRUE(samplesOf(scene, 100).samples.empty());
}

TEST(Stand, IsReadWithItsSourcesAndRefusedWithItsPlace) {
  const std::filesystem::path shipped = SOURCE_DIR "/scanners/stands/tripod.json";
  const auto stand = readTripodStand(shipped);
  ASSERT_TRUE(stand) << describe(stand.error());
  EXPECT_EQ(stand->clearance_m, 0.2) << "of the seed";
  EXPECT_DOUBLE_EQ(stand->lowest_m(0.2), 0.8);
  EXPECT_DOUBLE_EQ(stand->highest_m(0.2), 2.2);
  std::ifstream stream(shipped);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const TemporaryFolder folder;
  const auto changed = [&](const std::string& from, const std::string& to) {
    auto other = text;
    other.replace(other.find(from), from.size(), to);
    const auto file = folder / "changed-tripod.json";
    std::ofstream(file) << other;
    const auto read = readTripodStand(file);
    return read ? "" : describe(read.error());
  };
  EXPECT_THAT(changed("\"lowest_m\": 0.6", "\"lowest_m\": 6"), HasSubstr("/plate/highest_m"));
  EXPECT_THAT(changed("\"steepest_deg\"", "\"steep_deg\""), HasSubstr("/steep"));
  EXPECT_THAT(changed("\"radius_m\": 0.4", "\"radius_m\": -1"), HasSubstr("/feet/radius_m"));
  EXPECT_THAT(changed("{", "["), HasSubstr("is not JSON"));
  EXPECT_THAT(changed("\"lowest_m\": 0.6", "\"lowest_m\": 0.6, \"lowest_m\": 0.7"), HasSubstr("more than once"));
}

}  // namespace
}  // namespace standpoint
