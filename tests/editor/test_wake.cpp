// SPDX-License-Identifier: GPL-3.0-or-later
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include <gtest/gtest.h>

#include "demo_verbs.h"
#include "editor/desktop/frame_pacer.h"
#include "editor/instrument/ticker.h"
#include "editor/widgets/time_left.h"
#include "item_probe.h"

namespace standpoint {
namespace {

using namespace std::chrono_literals;

// As GLFW: what was posted ends one wait, and a poll swallows it.
class PostedEvents : public EventSource {
 public:
  void post() {
    const std::lock_guard lock(mutex_);
    posted_ = true;
    arrived_.notify_all();
  }
  void poll() override {
    const std::lock_guard lock(mutex_);
    posted_ = false;
  }
  void wait() override { sleep(10s); }
  void waitAtMost(double seconds) override {
    ++ticks;
    sleep(std::chrono::duration<double>(seconds));
  }
  int ticks = 0, blocked = 0;  // a wait that nothing ended

 private:
  void sleep(std::chrono::duration<double> longest) {
    std::unique_lock lock(mutex_);
    if (!arrived_.wait_for(lock, longest, [&] { return posted_; }) && longest > 1s) ++blocked;
    posted_ = false;
  }
  std::mutex mutex_;
  std::condition_variable arrived_;
  bool posted_ = false;
};

// Who leaves the device's workspace with the mouse presses a button while its panel is drawn for the last time.
TEST(Ticker, WakesOnceForEachTimeItIsAskedSoThatNothingGoesOnWhereNobodyAsks) {
  std::atomic<int> wakes = 0;
  std::mutex mutex;
  std::condition_variable woken;
  Ticker ticker([&] {
    const std::lock_guard lock(mutex);
    ++wakes;
    woken.notify_all();
  });
  const auto wokenTimes = [&](int times) {
    std::unique_lock lock(mutex);
    return woken.wait_for(lock, 10s, [&] { return wakes == times; });
  };
  ticker.askFor(true);
  EXPECT_TRUE(wokenTimes(1));
  std::this_thread::sleep_for(120ms);
  EXPECT_EQ(wakes, 1);
  ticker.askFor(true);
  EXPECT_TRUE(wokenTimes(2));
}

TEST(Device, IsKnownToBeDrawnOnlyWhereItsPanelIsInFront) {
  Editor editor(verbsWithDemo(), [] {});
  GuiDriver gui(editor);
  editor.draw_instrument = [](Editor&) {};
  editor.workspace = Workspace::instrument;
  gui.frames(3);
  EXPECT_TRUE(editor.device_drawn);
  editor.workspace = Workspace::survey;
  gui.frames(2);
  EXPECT_FALSE(editor.device_drawn);
}

// The window's loop without a window.
class Wake : public ::testing::Test {
 protected:
  void turn(bool job_counts) {
    pacer.waitForWork(events,
                      [&] { return FramePacer::Reasons{.job_runs = job_counts && !editor.session.running().empty()}; });
    pacer.drawn();
    gui.frame();
    ++drawn;
  }
  void rest(bool job_counts) {
    while (pacer.wanted() > 0) turn(job_counts);
  }
  PostedEvents events;
  FramePacer pacer;
  Editor editor{verbsWithDemo(), [this] {
                  pacer.wake();
                  events.post();
                }};
  GuiDriver gui{editor};
  int drawn = 0;
};

TEST_F(Wake, AJobThatEndsWhileAFrameIsDrawnIsShownWithoutInput) {
  rest(false);
  ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
  while (!editor.session.running().front()->done()) std::this_thread::sleep_for(1ms);
  std::this_thread::sleep_for(20ms);  // its last event is posted: the loop's own poll is what swallows it
  pacer.drawn(), pacer.drawn(), pacer.drawn();
  const auto before = std::chrono::steady_clock::now();
  turn(false);
  EXPECT_LT(std::chrono::steady_clock::now() - before, 300ms);
  EXPECT_EQ(events.blocked, 0);
  EXPECT_TRUE(editor.session.running().empty());
  EXPECT_TRUE(editor.environment()) << "and what it made is there";
  EXPECT_EQ(pacer.wanted(), 2) << "three frames, of which one is drawn";
}

TEST_F(Wake, AJobThatEndsWhileTheLoopSleepsEndsTheSleep) {
  rest(false);
  std::thread worker([&] {
    std::this_thread::sleep_for(50ms);
    pacer.wake();
    events.post();
  });
  const auto before = std::chrono::steady_clock::now();
  turn(false);
  worker.join();
  EXPECT_LT(std::chrono::steady_clock::now() - before, 300ms);
  EXPECT_EQ(pacer.wanted(), 2);
}

TEST_F(Wake, TicksWhileAJobRunsAndNeverWhenIdle) {
  rest(true);
  EXPECT_EQ(events.ticks, 0);
  std::thread later([&] {
    std::this_thread::sleep_for(300ms);
    events.post();
  });
  const int before = drawn;
  turn(true);
  later.join();
  EXPECT_EQ(drawn, before + 1) << "one frame for one event in 300 ms";
  EXPECT_EQ(events.ticks, 0);
  pacer.waitForWork(events, [] { return FramePacer::Reasons{.job_runs = true}; });
  EXPECT_EQ(events.ticks, 1);
}

TEST(TimeLeft, IsSaidWhenEnoughIsDoneToTell) {
  const auto first = [](double fraction, double seconds) { return TimeLeft().after(fraction, seconds); };
  EXPECT_FALSE(first(0.3, 1)) << "too early";
  EXPECT_FALSE(first(0.05, 3)) << "too little";
  ASSERT_TRUE(first(0.1, 2));
  EXPECT_DOUBLE_EQ(*first(0.1, 2), 18);
  ASSERT_TRUE(first(0.02, 10)) << "of a long one a fiftieth is enough";
  EXPECT_DOUBLE_EQ(*first(0.02, 10), 490);
  EXPECT_FALSE(first(0, 60)) << "nothing is known";
  EXPECT_FALSE(first(0.5, 0)) << "nor how long it took";
  EXPECT_FALSE(first(1, 60)) << "only the end is missing";
  EXPECT_EQ(timeLeftText(30), "30 s left");
  EXPECT_EQ(timeLeftText(124.2), "2:05 min left");
  EXPECT_EQ(timeLeftText({}), "");
}

TEST(TimeLeft, NeverRises) {
  TimeLeft steady;
  ASSERT_EQ(steady.after(0.25, 4), 12);
  EXPECT_EQ(steady.after(0.3, 6), 12) << "a little slower: it waits";
  EXPECT_EQ(steady.after(0.5, 8), 8);
  TimeLeft late;
  ASSERT_EQ(late.after(0.25, 4), 12);
  EXPECT_FALSE(late.after(0.25, 15)) << "it would be 45 s";
  EXPECT_FALSE(late.after(0.5, 30));
  EXPECT_EQ(late.after(0.75, 36), 12);
  double before = 1e9;
  TimeLeft slowing;
  for (double done = 0.01; done < 1; done += 0.01)  // each hundredth takes longer
    if (const auto left = slowing.after(done, 40 * done * done)) {
      EXPECT_LE(*left, before);
      before = *left;
    }
  EXPECT_LT(before, 1);
}

}  // namespace
}  // namespace standpoint
