// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/menus.h"

#include <algorithm>
#include <map>

#include "core/data_folder.h"
#include "emulated-ui/device/check.h"
#include "project/verb.h"
#include "survey/instruments.h"

namespace standpoint {

namespace {

Result<DeviceDefinition> definitionOf(const EmulatedDevice& device) {
  const auto file = device.folder() / "device.json";
  TRY_ASSIGN(auto definition, readDefinition(file));
  if (definition.id != device.id)
    return failure(ErrorKind::unusable, std::string("must be '") + device.id + "', as its folder",
                   std::string(device.id) + "/device.json /id");
  return definition;
}

Result<void> addWords(Words& words, const EmulatedDevice& device) {
  TRY(words.add(device.folder() / "words.json", device.id));
  for (const auto& file : languageFiles(wordsFolder(), device.id)) TRY(words.add(file, device.id));
  return {};
}

}  // namespace

const std::string& EmulatedDevice::title() const {
  static const auto titles = [] {
    std::map<std::string, std::string> all;
    for (const auto& device : emulatedDevices()) {
      const auto definition = definitionOf(device);
      all[device.id] = definition ? definition->title : device.id;
    }
    return all;
  }();
  return titles.at(id);
}

std::filesystem::path EmulatedDevice::folder() const { return dataFolder() / "emulated-ui" / "devices" / id; }

const EmulatedDevice* findDevice(const std::string& id) {
  const auto devices = emulatedDevices();
  const auto found = std::find_if(devices.begin(), devices.end(), [&](const EmulatedDevice& d) { return id == d.id; });
  return found == devices.end() ? nullptr : &*found;
}

Result<std::shared_ptr<const DeviceType>> loadDevice(const EmulatedDevice& device, const std::string& instrument) {
  TRY_ASSIGN(auto definition, definitionOf(device));
  TRY_ASSIGN(auto words, Words::read(wordsFolder()));
  TRY(addWords(words, device));
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

std::filesystem::path userLayout(const EmulatedDevice& device) {
  const auto folder = ownPath("STANDPOINT_LAYOUTS", "layouts");
  return folder.empty() ? folder : folder / (std::string(device.id) + ".json");
}

Result<Layout> loadLayout(const EmulatedDevice& device, const DeviceType& type) {
  return readLayout(device.folder() / "layout.json", type.definition);
}

std::filesystem::path wordsFolder() { return dataFolder() / "emulated-ui" / "words"; }

Result<Words> wordsOfAllDevices() {
  TRY_ASSIGN(auto words, Words::read(wordsFolder()));
  for (const auto& device : emulatedDevices()) TRY(addWords(words, device));
  return words;
}

const EmulatedDevice& deviceFor(const std::string& instrument) {
  for (const auto& device : emulatedDevices())
    if (const auto definition = definitionOf(device))
      if (std::find(definition->instruments.begin(), definition->instruments.end(), instrument) !=
          definition->instruments.end())
        return device;
  return emulatedDevices().back();
}

}  // namespace standpoint
