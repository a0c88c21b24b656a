// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "core/progress.h"
#include "core/result.h"

namespace standpoint {

// What this thread and the threads that it starts compute gives way to whoever draws: they get a quarter of a processor
// for which a thread of usual priority asks, too, and all of it otherwise.
void computeInBackground();

// One background run of any function that takes Progress&. The function owns what it works on and gives back what it
// made, so that it writes nothing that could be gone before it ends. The starter polls done() from its own thread, then
// takes the result. A task that is destroyed cancels and waits.
template <class T>
class Task {
 public:
  using Work = std::function<Result<T>(Progress&)>;
  // `wake` is called from the worker when progress has moved visibly and once at the end (e.g. glfwPostEmptyEvent).
  Task(std::string title, Work work, std::function<void()> wake = {}) : title_(std::move(title)) {
    progress_.onChange(wake);
    worker_ = std::thread([this, work = std::move(work), wake = std::move(wake)] {
      computeInBackground();
      result_ = guarded(work);
      done_.store(true, std::memory_order_release);
      if (wake) wake();
    });
  }
  ~Task() {
    progress_.cancel();
    wait();
  }
  Task(const Task&) = delete;
  Task& operator=(const Task&) = delete;

  const std::string& title() const { return title_; }
  Progress& progress() { return progress_; }
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count(); }
  bool done() const { return done_.load(std::memory_order_acquire); }
  void wait() {
    if (worker_.joinable()) worker_.join();
  }
  const Result<T>& result() const { return *result_; }  // after done()
  // Once; waits for the end.
  Result<T> take() {
    wait();
    return *std::move(result_);
  }

 private:
  Result<T> guarded(const Work& work) {
    try {
      return work(progress_);
    } catch (const std::exception& e) {
      return failure(ErrorKind::unusable, std::string("not enough memory, or a defect: ") + e.what());
    }
  }

  std::string title_;
  Progress progress_;
  std::atomic<bool> done_{false};
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
  std::optional<Result<T>> result_;
  std::thread worker_;
};

}  // namespace standpoint
