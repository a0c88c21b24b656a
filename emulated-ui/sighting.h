// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "emulated-ui/device/orders.h"
#include "emulated-ui/device/orientation.h"
#include "project/verb.h"

namespace standpoint {

// How targets are measured for an emulated device, and what it knows of them beforehand.

const Station* stationOf(const Document& document, const std::string& name);

// What is copied to the instrument before the job: control points by their names, else targets where they were put; and
// the ground marks of the stations.
ControlList controlOf(const Document& document);

// The turn from the scanner's frame into the levelled one, as the device measures its tilt.
Result<Eigen::Quaterniond> levelledFromScanner(const Station& station, const Instrument& instrument, bool compensator,
                                               std::uint64_t seed);

// Options of the verb `scan`.
nlohmann::json scanOptions(const std::string& instrument, const SettingValues& values, const std::string& station,
                           std::uint64_t seed, const std::filesystem::path& file);

// All targets of the job in a stored setup; rows for targetsFrom.
Result<Outcome> targetsIn(const Document& document, const std::string& file, std::uint64_t seed, Progress& progress);
// One target by a fine scan of a window about it, into `file`, which is gone afterwards; a row for targetsFrom.
Result<Outcome> sightTarget(const Document& document, const SightOrder& order, const std::filesystem::path& file,
                            std::uint64_t seed, Progress& progress);
std::vector<FittedTarget> targetsFrom(const nlohmann::json& rows);

}  // namespace standpoint
