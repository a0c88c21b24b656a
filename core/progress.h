// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <utility>

#include "core/result.h"

namespace standpoint {

// One handle for progress and cancel, shared between the worker and whoever watches it; every member is thread-safe.
// It is the last parameter of anything slow. A worker calls `advance` and, at points where it can stop, `check`.
class Progress {
 public:
  Progress() = default;
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // Begins a named stage that covers [from, to] of the whole, 0..1.
  void stage(std::string name, double from = 0, double to = 1);
  // The share of the current stage that is done, 0..1.
  void advance(double share_of_stage);

  void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
  bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }
  // Error of kind `cancelled` once cancel() was called.
  Result<void> check() const;

  // Called from the worker when a stage begins and whenever the whole has moved by another hundredth. Set it before the
  // work starts.
  void onChange(std::function<void()> watcher) { watcher_ = std::move(watcher); }

  double fraction() const { return fraction_.load(std::memory_order_relaxed); }
  std::string stageName() const;

 private:
  std::atomic<bool> cancelled_{false};
  std::atomic<double> fraction_{0};
  mutable std::mutex mutex_;
  std::string name_;
  double from_ = 0;
  double to_ = 1;
  int told_percent_ = -1;
  std::function<void()> watcher_;
};

}  // namespace standpoint
