// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/walk.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace standpoint {
namespace {

// Steps of time end anywhere, now and then where a leg does but for rounding. Then they stand for 8 s before they go
// on: what is recorded must not take that for a slow leg.
TEST(Walk, RecordsWhenEachLegEndsHoweverTimeIsDivided) {
  const PaceLimits most;
  for (int k = 1; k <= 4000; ++k) {
    WalkState walk;
    walk.at = {12.0, -3.0};
    walk.ahead_of = {1 / std::sqrt(50.0), 7 / std::sqrt(50.0)};  // as the leg goes: no turn takes time
    walk.recording = true;
    walk.way.push_back({12.0, -3.0, 0.0});
    const double speed_mps = std::hypot(1, 7) / 7.9, step_s = 7.9 / k;
    walk.legs = {{13, 4, speed_mps}};
    for (int i = 0; i < k + 2 && !walk.legs.empty(); ++i) walkOn(walk, most, step_s);
    ASSERT_TRUE(walk.legs.empty()) << k;
    walkOn(walk, most, 8);
    walk.legs = {{13, 10, speed_mps}};
    walkOn(walk, most, 1);
    const auto arrived =
        std::find_if(walk.way.begin(), walk.way.end(), [](const auto& place) { return place[1] > 3.9; });
    ASSERT_NE(arrived, walk.way.end()) << k;
    EXPECT_NEAR((*arrived)[2], 7.9, 1e-6) << "steps of 1/" << k << " of the leg";
  }
}

}  // namespace
}  // namespace standpoint
