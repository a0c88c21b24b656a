// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "emulated-ui/device/program.h"

namespace standpoint {

// Leica BLK360, both generations: one key, a ring of light, and an app on a tablet that may be connected or not. The
// key scans with a stored configuration after a self-timer; what the generations call their states and errors stands in
// facts. Transitions: instrument facts, section 2.3.
const DeviceProgram& blk360Program();

}  // namespace standpoint
