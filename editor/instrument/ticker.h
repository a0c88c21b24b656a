// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace standpoint {

// Wakes the window at most twenty times a second, once for each time that the panel of an instrument whose clock runs
// asks for it; so nothing is drawn when nothing changes, nor when the panel is no longer drawn.
class Ticker {
 public:
  explicit Ticker(std::function<void()> wake)
      : wake_(std::move(wake)), thread_([this](const std::stop_token& stop) { loop(stop); }) {}
  void askFor(bool frame) {
    {
      const std::lock_guard lock(mutex_);
      asked_ = frame;
    }
    condition_.notify_one();
  }

 private:
  void loop(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (condition_.wait(lock, stop, [this] { return asked_; }) && !stop.stop_requested()) {
      asked_ = false;
      lock.unlock();
      wake_();
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      lock.lock();
    }
  }

  std::function<void()> wake_;
  std::mutex mutex_;
  std::condition_variable_any condition_;
  bool asked_ = false;
  std::jthread thread_;
};

}  // namespace standpoint
