// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/task.h"

#include <atomic>
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "tests/project/support.h"

namespace standpoint {
namespace {

const Verb kEndless{"endless",
                    "Runs until it is cancelled",
                    VerbScope::files,
                    {},
                    [](const Document& d, const nlohmann::json&, Progress& progress) -> Result<Outcome> {
                      for (double fraction = 0; progress.check(); fraction += 0.001) progress.advance(fraction);
                      if (auto ok = progress.check(); !ok) return failure(ok.error());
                      return Outcome{d, {}, {}, {}};
                    }};

void waitFor(const Task& task) {
  for (int i = 0; i < 2000 && !task.done(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  ASSERT_TRUE(task.done());
}

TEST(Task, IsCancelledAtOnceAndSaysSo) {
  Task task("endless", kEndless, {}, nlohmann::json::object(), nullptr);
  EXPECT_FALSE(task.done());
  task.progress().cancel();
  waitFor(task);
  const auto result = task.take();
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::cancelled);
}

TEST(Task, ThatIsDroppedCancelsItself) {
  const auto started = std::chrono::steady_clock::now();
  { const Task task("endless", kEndless, {}, nlohmann::json::object(), nullptr); }
  EXPECT_LT(std::chrono::steady_clock::now() - started, std::chrono::seconds(5));
}

TEST(Task, WakesItsWatcherWhileItMovesAndAtTheEnd) {
  std::atomic<int> woken{0};
  Task task("endless", kEndless, {}, nlohmann::json::object(), [&] { ++woken; });
  for (int i = 0; i < 2000 && woken < 50; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_GE(woken, 50);
  task.progress().cancel();
  waitFor(task);
}

TEST(Task, WorksOnASnapshotAndGivesTheVerbsOutcome) {
  const Verb* station = findVerb(verbs(), "station");
  Task task("Add S1", *station, twoStoreyDocument(), {{"add", "S1"}, {"at", {500002, 5600002, 1.5}}}, nullptr);
  waitFor(task);
  const auto outcome = task.take();
  ASSERT_TRUE(outcome) << describe(outcome.error());
  EXPECT_EQ(outcome->document.job->stations.size(), 1U);
  EXPECT_TRUE(task.snapshot().job->stations.empty());
}

}  // namespace
}  // namespace standpoint
