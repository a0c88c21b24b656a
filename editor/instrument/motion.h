// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "editor/bodies/sweep.h"
#include "emulated-ui/device/device.h"

namespace standpoint {

// The head, the mirror and the light of a device's instrument, as its state machine has them from moment to moment.
class MotionOfDevice {
 public:
  // `wall_s`: for lights that flash, which they do in real time however fast the device's clock goes. `ticks`: that
  // clock runs; a light of a device at rest does not flash, so that nothing has to be drawn.
  WorkingMotion of(const Device& device, double wall_s, bool ticks);
  // That the head has done over what is measured, 2 after both passes of a double scan; none while it measures nothing.
  std::optional<double> turns() const { return turns_; }
  SweepShape shape(const Device& device) const;

 private:
  std::string phase_;
  double head_rad_ = 0, at_phase_rad_ = 0;
  std::optional<double> turns_;
};

// "red flashing", as devices' files have it; none where it is dark at that moment.
std::optional<LampColour> lampAt(const std::string& lamp, double wall_s, bool ticks);

}  // namespace standpoint
