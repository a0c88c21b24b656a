// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "emulated-ui/device/program.h"

namespace standpoint {

// RIEGL VZ-i (VZ-400i): projects and numbered scan positions, patterns, storage media, reflector search, registration
// after each scan, control points, camera. Transitions: instrument facts, section 2.6.
const DeviceProgram& vzIProgram();

}  // namespace standpoint
