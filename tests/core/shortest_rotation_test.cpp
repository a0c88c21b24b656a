// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/shortest_rotation.h"

#include <numbers>

#include <gtest/gtest.h>

namespace standpoint {
namespace {

TEST(ShortestRotation, TakesOneDirectionToTheOtherByTheAngleBetweenThem) {
  for (const double angle : {0.0, 1e-9, 0.3, 1.5, 3.0, std::numbers::pi - 1e-7, std::numbers::pi}) {
    const Eigen::Vector3d axis = Eigen::Vector3d(1, -2, 0.5).normalized();
    const Eigen::Vector3d from = 3 * axis.unitOrthogonal();
    const Eigen::Vector3d to = 0.2 * (Eigen::AngleAxisd(angle, axis) * from);
    const auto q = shortestRotation(from, to);
    EXPECT_LT((q * from.normalized() - to.normalized()).norm(), 1e-8) << angle;
    EXPECT_NEAR(Eigen::AngleAxisd(q).angle(), angle, 1e-8);
    EXPECT_NEAR(q.norm(), 1, 1e-15);
  }
}

}  // namespace
}  // namespace standpoint
