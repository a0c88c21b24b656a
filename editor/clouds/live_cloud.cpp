// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clouds/live_cloud.h"

namespace standpoint {

namespace {

// Half a million points are shaded and handed to the graphics card anew each time: this leaves most of it for the scan.
constexpr auto kPause = std::chrono::milliseconds(200);

}  // namespace

LiveCloud::LiveCloud(const Eigen::Vector3d& shift_m, std::function<void()> wake)
    : wake_(std::move(wake)), sampler_(1, kMostShownPoints, shift_m) {}

Result<void> LiveCloud::begin(const ScanHeader& header) {
  const std::lock_guard lock(mutex_);
  return sampler_.begin(header);
}

Result<void> LiveCloud::write(const PointBlock& block) {
  bool due = false;
  {
    const std::lock_guard lock(mutex_);
    if (auto ok = sampler_.write(block); !ok) return ok;
    due = !sampler_.empty() && Clock::now() - woken_at_ > kPause;
    if (due) woken_at_ = Clock::now();
  }
  if (due && wake_) wake_();
  return {};
}

std::shared_ptr<const Cloud> LiveCloud::newer(bool all) {
  const std::lock_guard lock(mutex_);
  if (sampler_.empty() || sampler_.seen() == given_) return nullptr;
  if (!all && given_ > 0 && Clock::now() - given_at_ < kPause) return nullptr;
  given_ = sampler_.seen();
  given_at_ = Clock::now();
  return std::make_shared<const Cloud>(sampler_.coloured());
}

}  // namespace standpoint
