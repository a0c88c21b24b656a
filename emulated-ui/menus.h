// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <string>

#include "emulated-ui/device/device.h"

namespace standpoint {

struct EmulatedDevice {
  const char* id;     // "leica-rtc360"
  const char* title;  // "Leica RTC360"
  const DeviceProgram& (*program)();
};

// The table of emulated devices; a new one is a folder, a data file and one line in menus.cpp.
std::span<const EmulatedDevice> emulatedDevices();
const EmulatedDevice* findDevice(const std::string& id);

// Reads its data file, the words and the scanner's data sheet. `instrument` empty: the first that it drives. Refuses
// what checkStructure finds, so that a slip in a data file shows when the device is chosen, not when a key is pressed.
Result<std::shared_ptr<const DeviceType>> loadDevice(const EmulatedDevice& device, const std::string& instrument = {});
// The device that drives this scanner; the generic one where no other does.
const EmulatedDevice& deviceFor(const std::string& instrument);

}  // namespace standpoint
