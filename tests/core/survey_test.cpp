// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/survey.h"

#include <numbers>

#include <gtest/gtest.h>

#include "core/physical_material.h"

namespace standpoint {
namespace {

TEST(Trajectory, OfATripodIsConstant) {
  Pose p;
  p.translation = {1, 2, 3};
  EXPECT_EQ(at({{0}, {p}}, 1e6).translation, p.translation);
}

TEST(Trajectory, IsInterpolatedBetweenItsSamples) {
  Pose a;
  Pose b;
  b.translation = {10, 0, 0};
  b.rotation = Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ());
  const Pose middle = at({{0, 4}, {a, b}}, 2);
  EXPECT_DOUBLE_EQ(middle.translation.x(), 5);
  EXPECT_NEAR(middle.rotation.angularDistance(
                  Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 4, Eigen::Vector3d::UnitZ()))),
              0, 1e-12);
}

TEST(Reflectance, IsLinearBetweenTabulatedWavelengthsAndConstantOutside) {
  const std::vector<std::pair<double, double>> table = {{532, 0.2}, {1064, 0.4}};
  EXPECT_DOUBLE_EQ(atWavelength(table, 798), 0.3);
  EXPECT_DOUBLE_EQ(atWavelength(table, 300), 0.2);
  EXPECT_DOUBLE_EQ(atWavelength(table, 1550), 0.4);
  EXPECT_DOUBLE_EQ(atWavelength({}, 905), 0);
}

TEST(MaterialAssignment, AnswersMinusOneForWhatIsNotAssigned) {
  MaterialAssignment a;
  a.surfaces = {{1, 2, 0, "rule"}, {3, 0, 1, "rule"}};
  EXPECT_EQ(materialOf(a, 1, 2), 0);
  EXPECT_EQ(materialOf(a, 3, 0), 1);
  EXPECT_EQ(materialOf(a, 1, 3), -1);
  EXPECT_EQ(materialOf(a, 9, 9), -1);
}

}  // namespace
}  // namespace standpoint
