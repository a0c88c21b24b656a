// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/emulated-ui/support.h"

namespace standpoint {

// A scanner that is carried: on, with an open project, with somebody at (0, 0).
inline TestDevice withWalker(const std::string& device, const std::string& instrument = {}) {
  TestDevice d(device, instrument);
  EXPECT_TRUE(d.press({"key"}));
  d->tick(70);
  EXPECT_TRUE(d.press({"project", "new_project", "name=House", "create"}));
  EXPECT_TRUE(d->hand("walk_to", "0,0"));
  return d;
}

// From there on it records.
inline void beginToRecord(TestDevice& d) {
  ASSERT_TRUE(d.press({"start"}));
  const auto order = d->takeOrder();
  ASSERT_TRUE(order && std::holds_alternative<SceneOrder>(*order));
  d->sceneDone();
  d->tick(20);
  ASSERT_EQ(d.phase(), "recording");
}

}  // namespace standpoint
