// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/menus.h"

#include <algorithm>
#include <array>

#include "emulated-ui/faro/focus.h"
#include "emulated-ui/leica/blk360.h"
#include "emulated-ui/leica/p_series.h"
#include "emulated-ui/leica/rtc360.h"
#include "project/instruments.h"
#include "project/verb.h"

namespace standpoint {

namespace {

constexpr std::array kDevices = {
    EmulatedDevice{"leica-rtc360", "Leica RTC360", rtc360Program},
    EmulatedDevice{"leica-blk360", "Leica BLK360", blk360Program},
    EmulatedDevice{"leica-p-series", "Leica ScanStation P-series", pSeriesProgram},
    EmulatedDevice{"faro-focus", "FARO Focus", focusProgram},
};

}  // namespace

std::span<const EmulatedDevice> emulatedDevices() { return kDevices; }

const EmulatedDevice* findDevice(const std::string& id) {
  const auto found = std::find_if(kDevices.begin(), kDevices.end(), [&](const EmulatedDevice& d) { return id == d.id; });
  return found == kDevices.end() ? nullptr : &*found;
}

Result<std::shared_ptr<const DeviceType>> loadDevice(const EmulatedDevice& device, const std::string& instrument) {
  const auto folder = dataFolder() / "emulated-ui";
  auto definition = readDefinition(folder / device.program().definition);
  if (!definition) return failure(definition.error());
  auto words = Words::read(folder / "words");
  if (!words) return failure(words.error());
  auto found = instrumentById(instrument.empty() ? definition->instruments.front() : instrument);
  if (!found) return failure(found.error());
  return makeDeviceType(*std::move(definition), device.program(), *std::move(found), std::make_shared<const Words>(*std::move(words)));
}

const EmulatedDevice& deviceFor(const std::string& instrument) {
  for (const auto& device : kDevices)
    if (const auto definition = readDefinition(dataFolder() / "emulated-ui" / device.program().definition))
      if (std::find(definition->instruments.begin(), definition->instruments.end(), instrument) != definition->instruments.end()) return device;
  return kDevices.back();
}

}  // namespace standpoint
