// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/result.h"
#include "emulated-ui/device/device.h"

namespace standpoint {

// Everything that is wrong with a device, each with its place: names that nobody has, conditions that can never hold,
// screens, phases and dialogues that cannot be reached or cannot be left, events that nobody sends, labels and helps
// without a translation. Empty: the device is sound.
std::vector<Error> checkDevice(const DeviceType& type);
// The same without the words, which may lack a language: what would go wrong in the hands.
std::vector<Error> checkStructure(const DeviceType& type);

}  // namespace standpoint
