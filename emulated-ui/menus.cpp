// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/menus.h"

#include <algorithm>
#include <array>

#include "core/data_folder.h"
#include "emulated-ui/device/check.h"
#include "emulated-ui/faro/focus.h"
#include "emulated-ui/generic/generic.h"
#include "emulated-ui/leica/blk360.h"
#include "emulated-ui/leica/p_series.h"
#include "emulated-ui/leica/rtc360.h"
#include "emulated-ui/riegl/vz_i.h"
#include "emulated-ui/trimble/x7.h"
#include "project/verb.h"
#include "survey/instruments.h"

namespace standpoint {

namespace {

constexpr std::array kDevices = {
    EmulatedDevice{"leica-rtc360", "Leica RTC360", rtc360Program},
    EmulatedDevice{"leica-blk360", "Leica BLK360", blk360Program},
    EmulatedDevice{"leica-p-series", "Leica ScanStation P-series", pSeriesProgram},
    EmulatedDevice{"faro-focus", "FARO Focus", focusProgram},
    EmulatedDevice{"trimble-x7", "Trimble X7 / X9", x7Program},
    EmulatedDevice{"riegl-vz-i", "RIEGL VZ-i", vzIProgram},
    EmulatedDevice{"generic", "Any laser scanner", genericProgram},  // last: for scanners that no other drives
};

}  // namespace

std::span<const EmulatedDevice> emulatedDevices() { return kDevices; }

const EmulatedDevice* findDevice(const std::string& id) {
  const auto found =
      std::find_if(kDevices.begin(), kDevices.end(), [&](const EmulatedDevice& d) { return id == d.id; });
  return found == kDevices.end() ? nullptr : &*found;
}

Result<std::shared_ptr<const DeviceType>> loadDevice(const EmulatedDevice& device, const std::string& instrument) {
  const auto folder = dataFolder() / "emulated-ui";
  TRY_ASSIGN(auto definition, readDefinition(folder / device.program().definition));
  TRY_ASSIGN(auto words, Words::read(folder / "words"));
  const auto& drives = definition.instruments;
  const auto default_value =
      std::find_if(drives.begin(), drives.end(), [](const std::string& id) { return id != "*"; });
  TRY_ASSIGN(auto found,
             instrumentById(instrument.empty() && default_value != drives.end() ? *default_value : instrument));
  auto type = makeDeviceType(std::move(definition), device.program(), std::move(found),
                             std::make_shared<const Words>(std::move(words)));
  if (!type) return type;
  if (const auto faults = checkStructure(**type); !faults.empty()) return failure(faults.front());
  return type;
}

const EmulatedDevice& deviceFor(const std::string& instrument) {
  for (const auto& device : kDevices)
    if (const auto definition = readDefinition(dataFolder() / "emulated-ui" / device.program().definition))
      if (std::find(definition->instruments.begin(), definition->instruments.end(), instrument) !=
          definition->instruments.end())
        return device;
  return kDevices.back();
}

}  // namespace standpoint
