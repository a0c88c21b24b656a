// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "emulated-ui/device/program.h"

namespace standpoint {

// Leica RTC360 with its touch display and what FIELD 360 adds: off, booting, idle, one or two passes of the laser,
// pictures, storing, and the tracking of the way to the next setup. Transitions: instrument facts, section 2.2.
const DeviceProgram& rtc360Program();

}  // namespace standpoint
