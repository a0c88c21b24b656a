// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/progress.h"

#include <gtest/gtest.h>

#include "core/progress_part.h"

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

TEST(ProgressPart, GoesThroughStagesOfItsOwnWhileTheWholeNeverGoesBack) {
  Progress whole;
  whole.stage("both", 0.2, 1);
  double before = whole.fraction();
  for (const double from : {0.0, 0.5}) {
    ProgressPart part(whole, from, from + 0.5);
    for (const double stage : {0.0, 0.6}) {
      part.stage("reading", stage, stage == 0 ? 0.6 : 1);
      for (int i = 0; i <= 10; ++i) {
        part.advance(i / 10.0);
        EXPECT_GE(whole.fraction(), before);
        before = whole.fraction();
      }
    }
    EXPECT_NEAR(whole.fraction(), 0.2 + 0.8 * (from + 0.5), 1e-9);
  }
  EXPECT_EQ(whole.stageName(), "both");
}

TEST(ProgressPart, IsCancelledWithTheWhole) {
  Progress whole;
  ProgressPart part(whole, 0, 1);
  part.advance(0.5);
  EXPECT_FALSE(part.cancelled());
  whole.cancel();
  part.advance(0.6);
  EXPECT_TRUE(part.cancelled());
  EXPECT_TRUE(ProgressPart(whole, 0, 1).cancelled());
}

}  // namespace
}  // namespace standpoint
