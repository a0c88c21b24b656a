// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/motion/rotation_vector.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace standpoint {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

TEST(RotationVector, ComesBackFromItsRotation) {
  for (const double angle : {0.0, 1e-160, 1e-9, 9.9e-5, 1.01e-4, 0.3, 1.6, 3.0, 3.1415}) {
    const Vector3d vector = angle * Vector3d(1, -2, 3).normalized();
    const Quaterniond q = rotationBy(vector);
    EXPECT_NEAR(q.norm(), 1, 1e-15);
    EXPECT_LT((rotationVector(q) - vector).norm(), 1e-11 * angle + 1e-300) << angle;
    EXPECT_LT((rotationVector(Quaterniond(-q.w(), -q.x(), -q.y(), -q.z())) - vector).norm(), 1e-11 * angle + 1e-300);
    const Quaterniond expected(Eigen::AngleAxisd(angle, Vector3d(1, -2, 3).normalized()));
    EXPECT_LT((q.coeffs() - expected.coeffs()).norm(), 1e-15);
  }
}

TEST(EulerAngles, AreTurnsAboutZThenYThenX) {
  const EulerAngles angles{0.3, -0.4, 2.5};
  const Quaterniond expected = Eigen::AngleAxisd(2.5, Vector3d::UnitZ()) * Eigen::AngleAxisd(-0.4, Vector3d::UnitY()) *
                               Eigen::AngleAxisd(0.3, Vector3d::UnitX());
  const Quaterniond q = rotationOf(angles);
  EXPECT_LT((q.toRotationMatrix() - expected.toRotationMatrix()).norm(), 1e-15);
  const EulerAngles back = eulerAngles(q);
  EXPECT_NEAR(back.roll_rad, 0.3, 1e-11);
  EXPECT_NEAR(back.pitch_rad, -0.4, 1e-11);
  EXPECT_NEAR(back.yaw_rad, 2.5, 1e-11);
}

TEST(EulerAngles, GiveTheSameRotationWhereTheNosePointsUpOrDown) {
  for (const double pitch : {-std::numbers::pi / 2, std::numbers::pi / 2}) {
    const Quaterniond q = rotationOf({0.2, pitch, 0.9});
    const EulerAngles angles = eulerAngles(q);
    EXPECT_EQ(angles.roll_rad, 0);
    EXPECT_LT((rotationOf(angles).toRotationMatrix() - q.toRotationMatrix()).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace standpoint
