// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/measuring/measurement.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "core/units.h"

namespace standpoint {
namespace {

using ::testing::HasSubstr;
using Corners = std::vector<Eigen::Vector3d>;

double figure(const Measurement& m, const std::string& key) {
  for (const auto& f : figuresOf(m))
    if (f.key == key) return f.value;
  ADD_FAILURE() << "no figure " << key;
  return 0;
}

Measurement made(MeasurementKind kind, Corners points) { return {"M1", kind, std::move(points), {}}; }

TEST(Measurement, OfADistanceHasItsPartsAndItsSlope) {
  const auto m = made(MeasurementKind::distance, {{1, 1, 1}, {4, 5, 1 + 5 * std::sqrt(3.0)}});
  EXPECT_NEAR(figure(m, "distance"), 10, 1e-12);
  EXPECT_NEAR(figure(m, "horizontal"), 5, 1e-12);
  EXPECT_NEAR(figure(m, "vertical"), 5 * std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(figure(m, "slope"), 60 * kRadPerDeg, 1e-12);
}

TEST(Measurement, OfAHeightIsNegativeWhereTheSecondPointIsLower) {
  EXPECT_NEAR(figure(made(MeasurementKind::height, {{0, 0, 2}, {3, 4, 0.5}}), "height"), -1.5, 1e-12);
}

TEST(Measurement, OfAnAngleIsThatAtTheSecondPointAlsoOfAStraightLine) {
  EXPECT_NEAR(figure(made(MeasurementKind::angle, {{2, 0, 0}, {0, 0, 0}, {0, 0, 5}}), "angle"), std::numbers::pi / 2,
              1e-12);
  EXPECT_NEAR(figure(made(MeasurementKind::angle, {{-1, 0, 0}, {0, 0, 0}, {3, 0, 0}}), "angle"), std::numbers::pi,
              1e-7);
}

// An L of 3 by 2 with 1 by 1 missing, far from the origin and standing up.
TEST(Measurement, OfAnAreaIsExactForAPolygonWithAnInwardCornerInAnyPlane) {
  Corners points = {{0, 0, 0}, {3, 0, 0}, {3, 0, 1}, {2, 0, 1}, {2, 0, 2}, {0, 0, 2}};
  const double turn = 0.4;
  for (auto& p : points) p = Eigen::Vector3d(1000 + std::cos(turn) * p.x(), 2000 + std::sin(turn) * p.x(), 50 + p.z());
  const auto m = made(MeasurementKind::area, points);
  ASSERT_TRUE(checkMeasurement(m));
  EXPECT_NEAR(figure(m, "area"), 5, 1e-9);
  EXPECT_NEAR(figure(m, "plan_area"), 0, 1e-9);
  EXPECT_NEAR(figure(m, "perimeter"), 10, 1e-9);
  EXPECT_NEAR(figure(m, "out_of_plane"), 0, 1e-9);
}

TEST(Measurement, OfAPlaneHasTheTiltThatItWasGiven) {
  const double lean = 2 * kRadPerDeg;
  const Eigen::Vector3d along(0, 1, 0), up(std::sin(lean), 0, std::cos(lean)), normal = along.cross(up);
  Corners points;
  for (int i = 0; i < 5; ++i)
    for (int k = 0; k < 4; ++k) points.emplace_back(i * along + k * up + ((i + k) % 2 == 0 ? 0.001 : -0.001) * normal);
  const auto m = made(MeasurementKind::plane, points);
  EXPECT_NEAR(figure(m, "tilt"), lean, 2e-4);
  EXPECT_NEAR(figure(m, "sigma"), 0.001 * std::sqrt(20.0 / 17), 2e-5);
  EXPECT_NEAR(figure(m, "max"), 0.001, 2e-4);
}

TEST(Measurement, IsRefusedWithTheReason) {
  const auto why = [](MeasurementKind kind, Corners points) {
    const auto checked = checkMeasurement(made(kind, std::move(points)));
    return checked ? std::string() : checked.error().message;
  };
  EXPECT_THAT(why(MeasurementKind::distance, {{0, 0, 0}}), HasSubstr("distance needs 2 points; 1 given"));
  EXPECT_THAT(why(MeasurementKind::distance, {{0, 0, 0}, {0, 0, 0}}), HasSubstr("points 1 and 2 are the same"));
  EXPECT_THAT(why(MeasurementKind::area, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}), HasSubstr("on one line"));
  EXPECT_THAT(why(MeasurementKind::area, {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}), HasSubstr("cross"));
  EXPECT_THAT(why(MeasurementKind::plane, {{0, 0, 0}, {NAN, 1, 0}, {1, 0, 0}}), HasSubstr("no number"));
  EXPECT_EQ(why(MeasurementKind::area, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}), "");
}

TEST(Measurement, IsWrittenToTheMillimetreAndResidualsToItsTenth) {
  EXPECT_EQ(figureText({"", "", 3.25049}), "3.250 m");
  EXPECT_EQ(figureText({"", "", -0.0002}), "0.000 m") << "never -0.000";
  EXPECT_EQ(figureText({"", "", 0.00044, MeasuredUnit::millimetre}), "0.4 mm");
  EXPECT_EQ(figureText({"", "", std::numbers::pi / 2, MeasuredUnit::radian}), "90.00°");
  EXPECT_EQ(figureText({"", "", 12.504, MeasuredUnit::square_metre}), "12.50 m²");
}

TEST(Measurement, IsCopiedAsTextInTheFrameOfTheFile) {
  const auto text = measurementText(made(MeasurementKind::distance, {{1, 2, 3}, {1, 2, 4}}), {100, 0, 0});
  EXPECT_THAT(text, HasSubstr("Distance\t1.000 m"));
  EXPECT_THAT(text, HasSubstr("Point 1\t101.000\t2.000\t3.000"));
}

}  // namespace
}  // namespace standpoint
