// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/task.h"

#include <utility>

namespace standpoint {

Task::Task(std::string title, const Verb& verb, Document snapshot, nlohmann::json options, std::function<void()> wake)
    : title_(std::move(title)), verb_(verb), snapshot_(std::move(snapshot)), options_(std::move(options)) {
  progress_.onChange(wake);
  worker_ = std::thread([this, wake = std::move(wake)] {
    result_ = runVerb(verb_, snapshot_, options_, progress_);
    done_.store(true, std::memory_order_release);
    if (wake) wake();
  });
}

Task::~Task() {
  progress_.cancel();
  if (worker_.joinable()) worker_.join();
}

double Task::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
}

Result<Outcome> Task::take() {
  if (worker_.joinable()) worker_.join();
  return std::move(result_);
}

}  // namespace standpoint
