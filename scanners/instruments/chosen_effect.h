// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "scanners/instruments/instrument.h"

namespace standpoint {

// What the chosen settings say of one thing: the figure that the choice states under `key`, such as "most_returns";
// nothing where none of the instrument's choices speaks of it.
std::optional<double> chosenEffect(const Instrument& instrument, const SettingValues& values, const std::string& key);

}  // namespace standpoint
