// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/task.h"

#include <exception>
#include <utility>

namespace standpoint {

namespace {

Result<Outcome> guarded(const Task::Work& work, const Document& snapshot, Progress& progress) {
  try {
    return work(snapshot, progress);
  } catch (const std::exception& e) {
    return failure(ErrorKind::unusable, std::string("not enough memory, or an internal error: ") + e.what());
  }
}

}  // namespace

Task::Task(std::string title, const Verb& verb, Document snapshot, nlohmann::json options, std::function<void()> wake,
           Work work)
    : title_(std::move(title)), verb_(verb), snapshot_(std::move(snapshot)), options_(std::move(options)) {
  progress_.onChange(wake);
  worker_ = std::thread([this, wake = std::move(wake), work = std::move(work)] {
    result_ = work ? guarded(work, snapshot_, progress_) : runVerb(verb_, snapshot_, options_, progress_);
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
