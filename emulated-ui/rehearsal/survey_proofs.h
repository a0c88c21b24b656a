// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include "emulated-ui/device/device.h"
#include "emulated-ui/rehearsal/exercise.h"
#include "project/document.h"

namespace standpoint {

// What all stations that are put up would see of the exercise's area with the device's settings, before a scan:
//   survey.walls      share of its walls that is met at 60° or steeper
//   survey.coverage   share of all its surfaces, however slanting
//   survey.overlap    the least overlap of a station with its best neighbour
std::map<std::string, double> readSurvey(const Exercise& exercise, const Device& device, const Document& document);

}  // namespace standpoint
