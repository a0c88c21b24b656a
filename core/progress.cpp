// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/progress.h"

#include <algorithm>
#include <utility>

namespace standpoint {

void Progress::stage(std::string name, double from, double to) {
  const std::lock_guard lock(mutex_);
  name_ = std::move(name);
  from_ = from;
  to_ = to;
  fraction_.store(from, std::memory_order_relaxed);
}

void Progress::advance(double share_of_stage) {
  const std::lock_guard lock(mutex_);
  fraction_.store(from_ + (to_ - from_) * std::clamp(share_of_stage, 0.0, 1.0), std::memory_order_relaxed);
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
