// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/progress.h"

#include <algorithm>
#include <utility>

namespace standpoint {

void Progress::stage(std::string name, double from, double to) {
  {
    const std::lock_guard lock(mutex_);
    name_ = std::move(name);
    from_ = from;
    to_ = to;
    fraction_.store(from, std::memory_order_relaxed);
  }
  if (watcher_) watcher_();
}

void Progress::advance(double share_of_stage) {
  {
    const std::lock_guard lock(mutex_);
    const double whole = from_ + (to_ - from_) * std::clamp(share_of_stage, 0.0, 1.0);
    fraction_.store(whole, std::memory_order_relaxed);
    const int percent = static_cast<int>(whole * 100);
    if (percent == told_percent_) return;
    told_percent_ = percent;
  }
  if (watcher_) watcher_();
}

Result<void> Progress::check() const {
  if (cancelled()) return failure(ErrorKind::cancelled, "cancelled");
  return {};
}

std::string Progress::stageName() const {
  const std::lock_guard lock(mutex_);
  return name_;
}

}  // namespace standpoint
