// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "emulated-ui/device/device.h"

namespace standpoint::leica_blk360 {

bool isG1(const Device& device);
constexpr double kFatal_c = 10;  // beyond the limits: critical [P]

// The settings of scans that the key starts.
std::string button(const Device& device);
Result<void> storeButton(Device& device, const std::string&);

// What the app does with setups that are stored.
Result<void> addTag(Device& device, const std::string&);
std::vector<WidgetOption> tagRows(const Device& device);
std::string accuracyOf(const StoredSetup& setup);
std::vector<WidgetOption> linkRows(const Device& device);
Result<void> optimise(Device& device, const std::string&);
Result<void> send(Device& device, const std::string&);

std::vector<FactRow> facts();

}  // namespace standpoint::leica_blk360
