// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/progress.h"

#include <gtest/gtest.h>

namespace standpoint {
namespace {

TEST(Progress, OfAStageIsAPartOfTheWhole) {
  Progress p;
  p.stage("second half", 0.5, 1);
  p.advance(0.5);
  EXPECT_DOUBLE_EQ(p.fraction(), 0.75);
  p.advance(7);
  EXPECT_DOUBLE_EQ(p.fraction(), 1);
  EXPECT_EQ(p.stageName(), "second half");
}

TEST(Progress, IsAnErrorOfKindCancelledOnceCancelled) {
  Progress p;
  EXPECT_TRUE(p.check());
  p.cancel();
  ASSERT_FALSE(p.check());
  EXPECT_EQ(p.check().error().kind, ErrorKind::cancelled);
}

TEST(Progress, TellsItsWatcherOncePerHundredth) {
  Progress p;
  int told = 0;
  p.onChange([&] { ++told; });
  for (int i = 0; i < 100000; ++i) p.advance(i / 100000.0);
  EXPECT_EQ(told, 100);
}

}  // namespace
}  // namespace standpoint
