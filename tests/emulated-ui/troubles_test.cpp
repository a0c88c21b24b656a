// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/emulated-ui/working.h"

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

TEST(Troubles, WhoTurnsTheFootScrewsUnderAScanMovesTheInstrument) {
  for (const auto& row : emulatedDevices()) {
    const auto type = loadDevice(row);
    ASSERT_TRUE(type);
    for (const auto& phase : (*type)->definition.phases) {
      if (!phase.laser) continue;
      for (const auto& [hand, value] :
           {std::pair{"level", ""}, std::pair{"tilt", "0.01,0"}, std::pair{"tripod_moved", ""}}) {
        Device d = working(*type, phase, phase.screen);
        ASSERT_TRUE(d.hand(hand, value));
        EXPECT_TRUE(d.state().dialog == "tripod_moved" || d.state().phase != phase.id)
            << row.id << ", " << phase.id << ", " << hand;
      }
    }
  }
}

}  // namespace
}  // namespace standpoint
