// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "emulated-ui/device/orientation.h"
#include "emulated-ui/device/program.h"

namespace standpoint::leica_p_series {

// The station set-up that scans get their coordinates from; without one they are in the scanner's own frame.
StationOrientation orientationOfScans(const Device& device);

// The station set-up and the targets of a P-series.
void addSetupTransitions(std::vector<Transition>& rows);
const std::vector<DeviceAction>& setupActions();
const std::vector<FactRow>& setupFacts();
const std::vector<ListRow>& setupLists();

}  // namespace standpoint::leica_p_series
