// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/emulated-ui/support.h"

namespace standpoint {
namespace {

TEST(Troubles, ATripodSinksOutOfWhatIsCompensatedAndThenOutOfWhatIsBorne) {
  for (const auto& row : emulatedDevices()) {
    TestDevice d(row.id);
    const auto& body = d->type().definition.body;
    ASSERT_TRUE(d->trouble("tilted"));
    EXPECT_GT(d->tilt(), body.tilt_full_deg) << row.id;
    EXPECT_LE(d->tilt(), std::max(15.0, body.tilt_full_deg * 1.3)) << row.id << ": a tripod that stands";
    ASSERT_TRUE(d->trouble("tilted"));
    EXPECT_GT(d->tilt(), body.tilt_limit_deg) << row.id;
    EXPECT_TRUE(d->hand("level", ""));
    EXPECT_LT(d->tilt(), body.tilt_full_deg) << row.id << ": the way on";
  }
}

}  // namespace
}  // namespace standpoint
