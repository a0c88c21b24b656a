// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>

#include "emulated-ui/menu.h"

namespace standpoint {

struct EmulatedInstrument {
  const char* instrument;   // id of the data sheet
  const char* device;       // what is emulated, for the editor's list
  Result<std::unique_ptr<Menu>> (*make)(const Instrument&);
};

// The table of emulated instruments; a new one is a folder and one line in menus.cpp.
std::span<const EmulatedInstrument> emulatedInstruments();

// Reads the instrument's data sheet and labels from the program's data and makes its menu.
Result<std::unique_ptr<Menu>> makeMenu(const EmulatedInstrument& emulated);

}  // namespace standpoint
