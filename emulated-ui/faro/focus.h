// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "emulated-ui/device/program.h"

namespace standpoint {

// FARO Focus S, M and Premium, which differ by their data sheets: off, booting, idle, spin-up, scanning, pictures,
// saving. Transitions: instrument facts, section 2.1.
const DeviceProgram& focusProgram();

}  // namespace standpoint
