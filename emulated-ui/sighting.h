// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "emulated-ui/device/orders.h"
#include "emulated-ui/device/orientation.h"
#include "project/document.h"

namespace standpoint {

// How targets are measured for an emulated device, and what it knows of them beforehand.

const Station* stationOf(const Document& document, const std::string& name);

// What is copied to the instrument before the job: control points by their names, else targets where they were put; and
// the ground marks of the stations.
ControlList controlOf(const Document& document);

// The turn from the scanner's frame into the levelled one, as the device measures its tilt.
Result<Eigen::Quaterniond> levelledFromScanner(const Station& station, const Instrument& instrument, bool compensator,
                                               std::uint64_t seed);

// All targets of the job in a stored setup.
Result<std::vector<FittedTarget>> targetsIn(const Document& document, const std::filesystem::path& file,
                                            std::uint64_t seed, Progress& progress);
// The one that is seen at a point of a stored setup, not behind it, under the name that it is given.
Result<FittedTarget> pickedTarget(const Document& document, const PickOrder& order, std::uint64_t seed,
                                  Progress& progress);
// One target by a fine scan of a window about it, into `file`, which is gone afterwards.
Result<FittedTarget> sightTarget(const Document& document, const SightOrder& order, const std::filesystem::path& file,
                                 std::uint64_t seed, Progress& progress);

}  // namespace standpoint
