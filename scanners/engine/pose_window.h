// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/motion/pose_function.h"
#include "scanners/math/vector_lanes.h"

namespace standpoint {

// A pose function over some milliseconds, quickly: cubic between poses at most 1 ms apart. A sway of 10 mm and 10 Hz is
// met within 0.1 nm. Depends on the window alone.
class PoseWindow {
 public:
  // `local_from_body` from one time to another, times `body_from_device`.
  void sample(const PoseFunction& function, const Pose& body_from_device, double from_s, double to_s);
  Pose at(double time_s) const;  // within the window
  // The same of those lanes, as bits; the others keep what they have.
  void at(const double* times_s, std::uint32_t lanes, PoseLanes& poses) const;

 private:
  double lastStep() const;

  double from_s_ = 0, per_step_ = 0;
  std::vector<Pose> poses_;  // one before the window and one after it as well; of alike quaternions
};

}  // namespace standpoint
