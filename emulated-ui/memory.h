// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include <nlohmann/json.hpp>

#include "emulated-ui/device/device.h"

namespace standpoint {

// What an instrument remembers from one day to the next beside its scans: projects without one, names and notes, the
// states of links and registrations, what was typed and chosen, where it stands and how that station was set up. Files
// are named relative to the folder of the scans, so that a project may be moved.
nlohmann::json deviceMemory(const Device& device, const std::filesystem::path& scans_folder);

// Lays it over what the device was loaded with. Setups that the project does not hold stay away; those that the memory
// does not know stay as they are. An error where the text is no such memory; then nothing has changed.
Result<void> recallMemory(Device& device, const nlohmann::json& memory, const std::filesystem::path& scans_folder);

// Whole, or not at all.
Result<void> writeMemory(const std::filesystem::path& file, const nlohmann::json& memory);
// Of each scanner its own: <scans>/<instrument>.device.json.
std::filesystem::path memoryFile(const std::filesystem::path& scans_folder, const DeviceType& type);

}  // namespace standpoint
