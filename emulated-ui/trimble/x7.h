// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "emulated-ui/device/program.h"

namespace standpoint {

// Trimble X7 and X9 with the software of their tablet: projects, scan panel, capture step by step, registration with
// its two limits, stations, export. Transitions: instrument facts, section 2.5.
const DeviceProgram& x7Program();

}  // namespace standpoint
