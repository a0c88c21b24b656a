// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "emulated-ui/device/device.h"
#include "emulated-ui/layout/layout.h"

namespace standpoint {

// A row of the table of devices: one line standpoint_device(<id> <sources>) of emulated-ui/CMakeLists.txt. Everything
// else that is the device's own is in its folder emulated-ui/devices/<id>/.
struct EmulatedDevice {
  const char* id;                     // "leica-rtc360"
  const DeviceProgram& (*program)();  // of its code; an empty one where it has none
  const std::string& title() const;   // of its file, "Leica RTC360"; the id where that cannot be read
  std::filesystem::path folder() const;
};

std::span<const EmulatedDevice> emulatedDevices();
const EmulatedDevice* findDevice(const std::string& id);

// Reads its data file, the words and the scanner's data sheet. `instrument` empty: the first that it drives. Refuses
// what checkStructure finds, so that a slip in a data file shows when the device is chosen, not when a key is pressed.
Result<std::shared_ptr<const DeviceType>> loadDevice(const EmulatedDevice& device, const std::string& instrument = {});
// Where its widgets stand, by the device's own file.
Result<Layout> loadLayout(const EmulatedDevice& device, const DeviceType& type);
// The file by which a user shows it otherwise; it need not be there: <id>.json in STANDPOINT_LAYOUTS, else in
// ~/.config/standpoint/layouts.
std::filesystem::path userLayout(const EmulatedDevice& device);
// With the files of words that the devices share, and those of further languages.
std::filesystem::path wordsFolder();
// The words of all devices, for what is asked of them together.
Result<Words> wordsOfAllDevices();
// The device that drives this scanner; the generic one where no other does.
const EmulatedDevice& deviceFor(const std::string& instrument);

}  // namespace standpoint
