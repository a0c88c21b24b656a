// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "core/progress.h"
#include "project/verb.h"

namespace standpoint {

// One background run of a verb on a snapshot. Whoever started it polls `done()` from its own thread, then takes the
// result.
class Task {
 public:
  // What runs instead of the verb when it has been half done already: the rest, with the same result.
  using Work = std::function<Result<Outcome>(const Document&, Progress&)>;
  // `wake` is called from the worker when progress has moved visibly and once at the end (e.g. glfwPostEmptyEvent).
  Task(std::string title, const Verb& verb, Document snapshot, nlohmann::json options, std::function<void()> wake,
       Work work = {});
  ~Task();  // cancels and waits
  Task(const Task&) = delete;
  Task& operator=(const Task&) = delete;

  const std::string& title() const { return title_; }
  const Verb& verb() const { return verb_; }
  const Document& snapshot() const { return snapshot_; }
  const nlohmann::json& options() const { return options_; }
  Progress& progress() { return progress_; }
  double seconds() const;
  bool done() const { return done_.load(std::memory_order_acquire); }
  Result<Outcome> take();  // once, after done()

 private:
  std::string title_;
  const Verb& verb_;
  Document snapshot_;
  nlohmann::json options_;
  Progress progress_;
  std::atomic<bool> done_{false};
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
  Result<Outcome> result_ = failure(ErrorKind::internal, "not finished");
  std::thread worker_;
};

}  // namespace standpoint
