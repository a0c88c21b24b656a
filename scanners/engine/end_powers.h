// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "scanners/engine/beam_paths.h"
#include "scanners/radiometry/signal_lanes.h"

namespace standpoint {

// What comes back of where light ends, sixteen at a time. For one thread.
class EndPowers {
 public:
  explicit EndPowers(const Receiver& receiver);
  // Good until the next call; at least as many as there are ends.
  const std::vector<float>& of(const std::vector<PathEnd>& ends);

 private:
  const Receiver& receiver_;
  SignalLanes signal_{};
  std::vector<float> powers_;
};

}  // namespace standpoint
