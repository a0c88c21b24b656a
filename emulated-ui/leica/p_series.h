// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "emulated-ui/device/program.h"

namespace standpoint {

// Leica ScanStation P-series (P30, P40, P50) with its touch screen: station set-up, scan, image, targets, status,
// tools. Transitions: instrument facts, section 2.4.
const DeviceProgram& pSeriesProgram();

// Its station set-up and target half, in p_series_setup.cpp.
void addSetupTransitions(std::vector<Transition>& rows);
const std::vector<DeviceAction>& setupActions();
const std::vector<FactRow>& setupFacts();
const std::vector<ListRow>& setupLists();

}  // namespace standpoint
