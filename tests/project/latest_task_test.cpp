// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/latest_task.h"

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace standpoint {
namespace {

using Follower = LatestTask<int, int>;
using Older = Follower::Older;

// Each work squares its wish once it is let go.
class Squares {
 public:
  Follower::Work of(int wish) {
    return [this, wish](Progress& progress) -> Result<int> {
      ++begun_;
      while (!released) {
        if (auto asked = progress.check(); !asked) {
          ++cancelled;
          return failure(std::move(asked).error());
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      return wish * wish;
    };
  }
  void untilBegun(int works) const {
    while (begun_ < works) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  int begun() const { return begun_; }

  std::atomic<bool> released{false};
  std::atomic<int> cancelled{0};

 private:
  std::atomic<int> begun_{0};
};

TEST(LatestTask, AnswersTheNewestWishAndNoneBetweenItAndTheRunningOne) {
  Squares squares;
  Follower follower("Square", {});
  follower.want(2, squares.of(2), Older::ends);
  squares.untilBegun(1);
  for (int wish = 3; wish <= 7; ++wish) follower.want(wish, squares.of(wish), Older::ends);
  EXPECT_EQ(follower.answer(), nullptr);
  EXPECT_TRUE(follower.busy());
  squares.released = true;
  follower.wait();
  ASSERT_NE(follower.answer(), nullptr);
  EXPECT_EQ(**follower.answer(), 49);
  EXPECT_EQ(squares.begun(), 2);
  EXPECT_FALSE(follower.busy());
}

TEST(LatestTask, AsksTheOlderWorkToStop) {
  Squares squares;
  Follower follower("Square", {});
  follower.want(2, squares.of(2));
  squares.untilBegun(1);
  follower.want(3, [](Progress&) -> Result<int> { return 9; });
  follower.wait();
  EXPECT_EQ(squares.cancelled, 1);
  ASSERT_NE(follower.answer(), nullptr);
  EXPECT_EQ(**follower.answer(), 9);
}

TEST(LatestTask, ShowsWhatOlderWorkMadeWhereItIsLetEnd) {
  Squares squares;
  Follower follower("Square", {});
  follower.want(2, squares.of(2), Older::ends);
  squares.untilBegun(1);
  Squares later;
  follower.want(3, later.of(3), Older::ends);
  squares.released = true;
  while (!follower.latest()) follower.poll();
  EXPECT_EQ(follower.latest()->wish, 2);
  EXPECT_EQ(*follower.latest()->result, 4);
  EXPECT_EQ(follower.answer(), nullptr) << "of the newest wish there is none yet";
  later.released = true;
  follower.wait();
  EXPECT_EQ(follower.latest()->wish, 3);
}

TEST(LatestTask, KeepsAnErrorAsTheAnswer) {
  Follower follower("Fail", {});
  follower.want(1, [](Progress&) -> Result<int> { return failure(ErrorKind::unusable, "broken"); });
  follower.wait();
  ASSERT_NE(follower.answer(), nullptr);
  EXPECT_EQ(follower.answer()->error().message, "broken");
}

TEST(LatestTask, KnowsNothingOnceItIsDroppedAndCanBeAskedAgain) {
  Squares squares;
  Follower follower("Square", {});
  follower.want(2, squares.of(2));
  squares.untilBegun(1);
  follower.drop();
  EXPECT_FALSE(follower.wants(2));
  follower.wait();
  EXPECT_EQ(squares.cancelled, 1);
  EXPECT_FALSE(follower.latest());
  squares.released = true;
  follower.want(2, squares.of(2));
  follower.wait();
  EXPECT_EQ(**follower.answer(), 4);
}

TEST(LatestTask, IsOverBeforeWhatItsWorkWritesIsGone) {
  Squares squares;
  std::atomic<bool> over{false};
  {
    Follower follower("Square", {});
    follower.want(2, [&, work = squares.of(2)](Progress& progress) {
      auto result = work(progress);
      over = true;
      return result;
    });
    squares.untilBegun(1);
  }
  EXPECT_TRUE(over);
  EXPECT_EQ(squares.cancelled, 1);
}

TEST(LatestTask, WakesItsWatcherWhenThereIsAnAnswer) {
  std::atomic<int> woken{0};
  Follower follower("Square", [&] { ++woken; });
  follower.want(2, [](Progress&) -> Result<int> { return 4; });
  follower.wait();
  EXPECT_EQ(woken, 1);
}

}  // namespace
}  // namespace standpoint
