// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "core/result.h"

namespace standpoint {

// For whoever writes an exercise: each device with its id, the key that switches it on, the seconds until it rests, the
// screen that it then shows, and the scanners that it drives.
Result<nlohmann::json> deviceNames();
// All names that an exercise for the device may use, and what each can be: settings and values with their choices,
// screens with their widgets, phases, dialogues, facts, hands, troubles, events.
Result<nlohmann::json> namesOf(const std::string& device);

// The same for people.
std::string deviceNamesText(const nlohmann::json& devices);
std::string namesText(const nlohmann::json& names);

}  // namespace standpoint
