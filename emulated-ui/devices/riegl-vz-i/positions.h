// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "emulated-ui/device/device.h"

namespace standpoint::riegl_vz_i {

// Projects, the running number of the scan positions, and the three storage media of a VZ-i.

constexpr const char* kPositionBase = "ScanPos";  // [S31]
constexpr double kSsdBytes = 1e12;                // [G2]

// A position's number: the next free one, or with the automatic numbering off the one that stands there, taken or not.
int nextPosition(const Device& device);
bool positionTaken(const Device& device);
// "ScanPos003"; "Scan2_ScanPos003" for another scan under the same number: the two can hardly be told apart [S32].
std::string nextPositionName(const Device& device);
double doublePositions(const Device& device);

Result<void> loadOrCreate(Device& device, const std::string&);
Result<void> openPositionProject(Device& device, const std::string& row);
Result<void> proposePosition(Device& device, const std::string&);
Result<void> setBase(Device& device, const std::string&);
Result<void> numberFromHere(Device& device, const std::string&);

// The medium that is chosen. The SSD is built in; stick and card share what hands put in and take out.
std::string cardState(const Device& device);
double cardFree(const Device& device);
void storePosition(Device& device);
void deletePosition(Device& device);
void formatMedium(Device& device);

}  // namespace standpoint::riegl_vz_i
