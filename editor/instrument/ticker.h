// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace standpoint {

// Wakes the window twenty times a second while an instrument's clock runs; sleeps otherwise, so that nothing is drawn
// when nothing changes.
class Ticker {
 public:
  explicit Ticker(std::function<void()> wake)
      : wake_(std::move(wake)), thread_([this](const std::stop_token& stop) { loop(stop); }) {}
  void run(bool on) {
    {
      const std::lock_guard lock(mutex_);
      on_ = on;
    }
    condition_.notify_one();
  }

 private:
  void loop(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (condition_.wait(lock, stop, [this] { return on_; }) && !stop.stop_requested()) {
      lock.unlock();
      wake_();
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      lock.lock();
    }
  }

  std::function<void()> wake_;
  std::mutex mutex_;
  std::condition_variable_any condition_;
  bool on_ = false;
  std::jthread thread_;
};

}  // namespace standpoint
