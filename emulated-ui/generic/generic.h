// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "emulated-ui/device/program.h"

namespace standpoint {

// A plain device for any scanner on a tripod that has none of its own: those of users, and the shipped ones without a
// menu. Its scan screen holds what the scanner's data sheet offers. Nothing here is any maker's: all of it is a choice
// of this emulator, after the rules that all emulated instruments share (instrument facts, section 2.7).
const DeviceProgram& genericProgram();

}  // namespace standpoint
