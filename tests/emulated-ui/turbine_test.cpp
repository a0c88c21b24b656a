// SPDX-License-Identifier: GPL-3.0-or-later
// What a student gets out of E31, by the reduction that its goal asks for.
#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "core/units.h"
#include "emulated-ui/rehearsal/rehearsal.h"
#include "tests/pointclouds/kept_scans.h"
#include "tests/temporary_folder.h"

namespace standpoint {
namespace {

constexpr double kRate_radps = 1.2, kRadius_m = 40, kAbout_m = 2, kHalfChord_m = 0.9;
const Eigen::Vector3d kTurbineHub(0, 0, 120);

struct Torsion {
  double angle_deg = 0;
  std::size_t points = 0, lines = 0;  // about the radius, on blades that pass
};

// Turned back by the rotor's rate times its own time, a point is on the blade where that stood at 0 s: depth over
// chord.
Torsion torsionIn(const PointBlock& points, const Pose& file_from_scanner) {
  double sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0, count = 0;
  std::set<std::uint32_t> columns;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d place =
        file_from_scanner * Eigen::Vector3d(points.x_m[i], points.y_m[i], points.z_m[i]) - kTurbineHub;
    if (std::abs(place.y()) > 2) continue;  // the tower
    Eigen::Vector3d back = Eigen::AngleAxisd(-kRate_radps * points.time_s[i], Eigen::Vector3d::UnitY()) * place;
    const double third = 2 * std::numbers::pi / 3, blade = std::round(std::atan2(back.x(), back.z()) / third);
    back = Eigen::AngleAxisd(-third * blade, Eigen::Vector3d::UnitY()) * back;
    if (std::abs(back.z() - kRadius_m) > kAbout_m || std::abs(back.x()) > kHalfChord_m) continue;
    columns.insert(points.column[i]);
    sum_x += back.x(), sum_y += back.y(), sum_xx += back.x() * back.x(), sum_xy += back.x() * back.y(), ++count;
  }
  const double slope = (count * sum_xy - sum_x * sum_y) / (count * sum_xx - sum_x * sum_x);
  return {std::atan(slope) / kRadPerDeg, static_cast<std::size_t>(count), columns.size()};
}

Torsion carriedOut(const std::vector<RehearsalAction>& actions, const Exercise& exercise) {
  const TemporaryFolder folder;
  Progress quiet;
  auto rehearsal = Rehearsal::start(exercise, {}, folder.path(), {}, quiet);
  EXPECT_TRUE(rehearsal) << describe(rehearsal.error());
  if (!rehearsal) return {};
  for (const auto& action : actions) EXPECT_TRUE((*rehearsal)->act(action, quiet)) << toJson(action);
  const auto* setup = (*rehearsal)->device().newestSetup();
  EXPECT_NE(setup, nullptr);
  if (setup == nullptr) return {};
  testing::KeptScans kept;
  EXPECT_TRUE(testing::readAll(setup->file, kept));
  if (kept.scans.empty()) return {};
  return torsionIn(kept.scans[0].points, (*rehearsal)->document().job->stations[0].true_pose);
}

// The blade is made with 4° at its tip and none at the axis: 2.667° at 40 m of 60 m. A line is 0.24 m from the next.
TEST(Turbine, GivesTheTorsionOfItsBladesToWhoTurnsThemBack) {
  const auto known = findExercise("E31");
  ASSERT_TRUE(known) << describe(known.error());
  const auto right = carriedOut(known->exercise.solution, known->exercise);
  RecordProperty("torsion_deg", std::to_string(right.angle_deg));
  RecordProperty("points", std::to_string(right.points));
  EXPECT_NEAR(right.angle_deg, 4.0 * kRadius_m / 60, 0.15);
  EXPECT_GT(right.points, 100U);
  const auto too_slow = carriedOut(known->exercise.mistakes.front().actions, known->exercise);
  EXPECT_NEAR(static_cast<double>(right.lines) / static_cast<double>(too_slow.lines), 4, 1.2) << "200 lines/s for 50";
}

}  // namespace
}  // namespace standpoint
