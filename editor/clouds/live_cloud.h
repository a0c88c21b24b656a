// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>

#include "editor/clouds/cloud.h"

namespace standpoint {

// A scan's points as they come: written by the thread that scans, looked at by the one that draws.
class LiveCloud : public PointSink {
 public:
  // `wake` is called with the first ones, and now and then.
  LiveCloud(const Eigen::Vector3d& shift_m, std::function<void()> wake);
  Result<void> begin(const ScanHeader& header) override;
  Result<void> write(const PointBlock& block) override;
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }

  // What there is now; null when there is nothing that the last call did not give already, or when that was a moment
  // ago. `all`: however short ago.
  std::shared_ptr<const Cloud> newer(bool all = false);

 private:
  using Clock = std::chrono::steady_clock;
  std::function<void()> wake_;
  std::mutex mutex_;
  CloudSampler sampler_;
  std::uint64_t given_ = 0;  // points seen when the last cloud was given
  Clock::time_point given_at_, woken_at_;
};

}  // namespace standpoint
