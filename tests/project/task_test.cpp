// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/task.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <sys/resource.h>
#include <thread>

#include <gtest/gtest.h>

#include "project/survey/survey_verbs.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

Result<int> endless(Progress& progress) {
  for (double fraction = 0; progress.check(); fraction += 0.001) progress.advance(fraction);
  if (auto ok = progress.check(); !ok) return failure(ok.error());
  return 1;
}

template <class T>
void waitFor(const Task<T>& task) {
  for (int i = 0; i < 2000 && !task.done(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  ASSERT_TRUE(task.done());
}

TEST(Task, IsCancelledAtOnceAndSaysSo) {
  Task<int> task("endless", endless);
  EXPECT_FALSE(task.done());
  task.progress().cancel();
  waitFor(task);
  const auto result = task.take();
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::cancelled);
}

TEST(Task, GivesWayToTheThreadThatStartedItAsDoWhatItStarts) {
  const auto niceness = [] { return getpriority(PRIO_PROCESS, 0); };  // on Linux of the calling thread
  const int before = niceness();
  Task<std::pair<int, int>> task("nice", [&](Progress&) -> Result<std::pair<int, int>> {
    int of_helper = 0;
    std::thread([&] { of_helper = niceness(); }).join();
    return std::pair(niceness(), of_helper);
  });
  const auto result = task.take();
  ASSERT_TRUE(result);
  const int nicest = std::min(19, before + 10);
  EXPECT_EQ(result->first, nicest);
  EXPECT_EQ(result->second, nicest);
  EXPECT_EQ(niceness(), before);
}

TEST(Task, ThatIsDroppedCancelsItself) {
  const auto started = std::chrono::steady_clock::now();
  { const Task<int> task("endless", endless); }
  EXPECT_LT(std::chrono::steady_clock::now() - started, std::chrono::seconds(5));
}

TEST(Task, WakesItsWatcherWhileItMovesAndAtTheEnd) {
  std::atomic<int> woken{0};
  Task<int> task("endless", endless, [&] { ++woken; });
  for (int i = 0; i < 2000 && woken < 50; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_GE(woken, 50);
  task.progress().cancel();
  waitFor(task);
}

TEST(Task, IsOverBeforeWhatIsDeclaredBeforeItIsGone) {
  std::atomic<bool> over{false};
  {
    const Task<int> task("endless", [&](Progress& progress) {
      const auto result = endless(progress);
      over = true;
      return result;
    });
  }
  EXPECT_TRUE(over);
}

TEST(Task, TurnsAnExceptionIntoAnError) {
  Task<int> task("throws", [](Progress&) -> Result<int> { throw std::runtime_error("broken"); });
  const auto result = task.take();
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("broken"), std::string::npos);
}

TEST(Task, GivesTheOutcomeOfAVerbOnASnapshot) {
  const auto document = twoStoreyDocument();
  Task<Answered<StationAnswer>> task("Add S1", [document](Progress& progress) {
    StationOptions options;
    options.add = "S1";
    options.at = {500002, 5600002, 1.5};
    return runStation(document, options, progress);
  });
  waitFor(task);
  const auto outcome = task.take();
  ASSERT_TRUE(outcome) << describe(outcome.error());
  EXPECT_EQ(outcome->document.job->stations.size(), 1U);
  EXPECT_TRUE(document.job->stations.empty());
}

}  // namespace
}  // namespace standpoint
