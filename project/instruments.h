// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/result.h"
#include "scanners/instrument.h"

namespace standpoint {

Result<std::vector<Instrument>> shippedInstruments();
// "leica-p40, leica-rtc360, …": what an error offers.
std::string idsOf(const std::vector<Instrument>& instruments);
// By id; an unknown one is an error of --instrument that lists those there are.
Result<Instrument> instrumentById(const std::string& id);

}  // namespace standpoint
