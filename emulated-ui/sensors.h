// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "emulated-ui/device/definition.h"
#include "project/document.h"
#include "scanners/instruments/instrument.h"

namespace standpoint {

// What an instrument's own sensors write into the record of a scan, as key and text, in the frame of the model's file:
//   compass    azimuth of the scanner's zero, clockwise from the file's Y
//   altimeter  height of the instrument's centre
//   gps        its place, or that there was none: under a roof nothing is received
// Each is the truth with a normal error of the stated accuracy, drawn by seed, station and number of the scan: they are
// hints for whoever puts the scans together, not control.
SettingValues sensorReadings(const Document& document, const Station& station, const std::vector<SensorRow>& sensors,
                             const std::vector<std::string>& on, std::uint64_t seed, int number);

// Something of the scene lies straight above the place (local frame).
bool isUnderARoof(const Environment& environment, const Eigen::Vector3d& place);

}  // namespace standpoint
