// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "emulated-ui/device/device.h"
#include "emulated-ui/rehearsal/exercise.h"
#include "project/document.h"

namespace standpoint {

// What all stations that are put up would see of the exercise's area with the device's settings, before a scan:
//   survey.walls      share of its walls that is met at 60° or steeper
//   survey.coverage   share of all its surfaces, however slanting
//   survey.reached    of the surfaces that can be seen from anywhere in the area where a tripod can stand, the share
//   that
//                     is seen: what lies behind a shelf or on top of a cupboard is asked of nobody
//   survey.overlap    the least overlap of a station with its best neighbour
// `in_reach` says which samples those are, and is filled where it is empty.
std::map<std::string, double> readSurvey(const Exercise& exercise, const Device& device, const Document& document,
                                         std::vector<std::uint8_t>& in_reach);

}  // namespace standpoint
