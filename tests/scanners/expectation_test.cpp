// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/forecast/expectation.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/units.h"
#include "tests/scanners/scenes.h"

namespace standpoint {
namespace {

using namespace testing;

const Eigen::Vector3d kStation = Eigen::Vector3d::Zero();

// A wall across +X, seen from the origin.
struct Wall {
  SceneBuilder scene;
  SurfacePlace place;
  Wall(double distance, double half_width) {
    const auto product =
        scene.quad({distance, -half_width, -half_width}, {0, 2 * half_width, 0}, {0, 0, 2 * half_width});
    place = {{distance, 0, 0}, -Eigen::Vector3d::UnitX(), product, 0};
  }
};

Expectation expectation(const SceneBuilder& scene, MaterialAssignment assignment, const Instrument& instrument) {
  return {scene.build(), std::make_shared<const MaterialAssignment>(std::move(assignment)),
          ReturnLaw(instrument, window(instrument, -1, 1, -1, 1, 10, 10))};
}

TEST(Expectation, IsTheMeanOfWhatAScanYields) {
  for (const auto& sheet : instruments()) {
    const auto instrument = withoutBias(sheet);
    const double distance = std::max(5.0, 2 * instrument.min_range_m);
    const Wall wall(distance, 0.2 * distance);
    const auto assignment = allOf(*wall.scene.environment(), 0.4);
    const auto expected = expectation(wall.scene, assignment, instrument).from(kStation, wall.place);
    const auto result =
        scanned(*wall.scene.build(), assignment, instrument, window(instrument, -0.5, 0.5, -0.5, 0.5, 100, 100), {});
    ASSERT_EQ(result.points.size(), 10000U) << instrument.id;
    double sum = 0, square = 0;
    for (std::size_t i = 0; i < result.points.size(); ++i) {
      const double off = result.points.x_m[i] - distance;
      sum += static_cast<double>(result.points.intensity[i]);
      square += off * off;
    }
    EXPECT_EQ(expected.fate, ReturnFate::returned) << instrument.id;
    EXPECT_NEAR(sum / 10000, expected.intensity, 0.5 / (instrument.intensity_levels - 1) + 1e-4) << instrument.id;
    EXPECT_NEAR(std::sqrt(square / 10000) / expected.sigma_m, 1, 0.04) << instrument.id;
  }
}

TEST(Expectation, FadesWhereAScanFades) {
  auto instrument = testing::instrument("leica-rtc360");
  instrument.near_range_m = 0;
  const double limit = instrument.max_range_m * std::sqrt(0.2 / instrument.reference_reflectivity);
  for (const double relative : {0.95, 1.0, 1.05}) {
    const Wall wall(relative * limit, 5);
    const auto assignment = allOf(*wall.scene.environment(), 0.2);
    const auto expected = expectation(wall.scene, assignment, instrument).from(kStation, wall.place);
    const auto result =
        scanned(*wall.scene.build(), assignment, instrument, window(instrument, -1, 1, -1, 1, 100, 100), {});
    EXPECT_NEAR(expected.probability, static_cast<double>(result.points.size()) / 10000, 0.02) << relative;
    EXPECT_EQ(expected.fate, expected.probability < 0.5 ? ReturnFate::too_weak : ReturnFate::returned) << relative;
  }
}

TEST(Expectation, KnowsWhatStandsInTheWayAndWhatIsTurnedAway) {
  const auto instrument = testing::instrument("leica-rtc360");
  Wall wall(8, 3);
  wall.scene.box({4, -0.5, -0.5}, {5, 0.5, 0.5}, false);
  const auto law = expectation(wall.scene, allOf(*wall.scene.environment(), 0.5), instrument);
  EXPECT_EQ(law.from(kStation, wall.place).fate, ReturnFate::hidden);
  wall.place.position.y() = 2;
  const auto beside = law.from(kStation, wall.place);
  EXPECT_EQ(beside.fate, ReturnFate::returned);
  EXPECT_NEAR(beside.range_m, std::hypot(8, 2), 1e-9);
  EXPECT_NEAR(beside.incidence_rad, std::atan2(2, 8), 1e-9);
  wall.place.normal = Eigen::Vector3d::UnitX();  // its other side
  EXPECT_EQ(law.from(kStation, wall.place).fate, ReturnFate::hidden);
}

TEST(Expectation, KeepsToTheRangesOfTheInstrument) {
  const auto instrument = testing::instrument("leica-rtc360");
  for (const auto& [distance, fate] : {std::pair{0.9 * instrument.min_range_m, ReturnFate::too_near},
                                       {1.1 * instrument.max_range_m, ReturnFate::too_far}}) {
    const Wall wall(distance, 1);
    const auto expected =
        expectation(wall.scene, allOf(*wall.scene.environment(), 0.9), instrument).from(kStation, wall.place);
    EXPECT_EQ(expected.fate, fate);
    EXPECT_EQ(expected.probability, 0);
  }
}

// A sheet of clear glass (T = 0.81 at 1550 nm, n = 1.507) leaves T² of the power behind it.
TEST(Expectation, LooksThroughPanesAndTakesTheirTollTwice) {
  auto instrument = testing::instrument("leica-rtc360");
  instrument.near_range_m = 0;
  Wall wall(8, 3);
  const auto pane = wall.scene.quad({5, -2, -2}, {0, 4, 0}, {0, 0, 4});
  PhysicalMaterial glass = lambert(0.005);
  glass.id = "glass";
  glass.index_of_refraction = 1.507;
  glass.thickness_m = 0.004;
  glass.transmittance = {{1550, 0.81}};
  MaterialAssignment assignment;
  assignment.materials = {lambert(0.6), glass};
  assignment.surfaces = {{wall.place.instance, 0, 0, "test"}, {pane, 0, 1, "test"}};
  const auto law = expectation(wall.scene, assignment, instrument);
  const auto behind = law.from(kStation, wall.place);
  EXPECT_EQ(behind.fate, ReturnFate::returned);
  EXPECT_NEAR(behind.power, 0.6 / 64 * 0.81 * 0.81, 1e-5);
  SurfacePlace on_pane{{5, 1, 0}, -Eigen::Vector3d::UnitX(), pane, 0};
  EXPECT_EQ(law.from(kStation, on_pane).fate, ReturnFate::seen_through);
  on_pane.position.y() = 0;  // head-on it glints
  EXPECT_EQ(law.from(kStation, on_pane).fate, ReturnFate::returned);
}

}  // namespace
}  // namespace standpoint
