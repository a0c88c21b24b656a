// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "project/task.h"

namespace standpoint {

// Serves a wish that keeps changing, such as that of a slider, in the background: one task at a time, and the newest
// wish always in the end. It belongs to the thread that wishes, which polls it once a frame; `wake` is that of the
// tasks. Destroyed, it cancels and waits, as a task does.
template <class Wish, class T>
class LatestTask {
 public:
  using Work = typename Task<T>::Work;
  struct Answer {
    Wish wish;
    Result<T> result;
  };
  // What becomes of the work for an older wish: it is asked to stop, or it ends where the newer one goes on from what
  // it makes.
  enum class Older { stops, ends };

  LatestTask(std::string title, std::function<void()> wake) : title_(std::move(title)), wake_(std::move(wake)) {}

  bool wants(const Wish& wish) const { return wanted_ == wish; }
  const std::optional<Wish>& wanted() const { return wanted_; }
  // The work owns what it works on: it may still run when the next wish has come.
  void want(Wish wish, Work work, Older older = Older::stops) {
    if (task_ && older == Older::stops) task_->progress().cancel();
    wanted_ = std::move(wish);
    waiting_ = std::move(work);
    poll();
  }
  // Nothing is wanted, and nothing is known any more.
  void drop() {
    if (task_) task_->progress().cancel();
    wanted_.reset();
    waiting_ = nullptr;
    answer_.reset();
    poll();
  }
  // Takes in what has ended, and starts what waits.
  void poll() {
    if (task_ && task_->done()) takeIn();
    if (task_ || !waiting_) return;
    served_ = wanted_;
    task_ = std::make_unique<Task<T>>(title_, std::exchange(waiting_, nullptr), wake_);
  }
  bool busy() const { return task_ != nullptr; }
  Task<T>* task() const { return task_.get(); }  // that runs, for its progress; null: none
  void wait() {                                  // until the newest wish has its answer
    while (task_) {
      task_->wait();
      poll();
    }
  }

  // To the newest wish; null while it is worked out.
  const Result<T>* answer() const { return answer_ && wants(answer_->wish) ? &answer_->result : nullptr; }
  // To the newest wish that has one.
  const std::optional<Answer>& latest() const { return answer_; }

 private:
  void takeIn() {
    auto result = task_->take();
    task_.reset();
    const bool cancelled = !result && result.error().kind == ErrorKind::cancelled;
    if (wanted_ && !cancelled) answer_ = Answer{*std::move(served_), std::move(result)};
  }

  std::string title_;
  std::function<void()> wake_;
  std::optional<Wish> wanted_, served_;  // the newest, and that of the task
  Work waiting_;                         // for the newest, until it is its turn
  std::optional<Answer> answer_;
  std::unique_ptr<Task<T>> task_;
};

}  // namespace standpoint
