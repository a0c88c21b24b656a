// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/survey.h"
#include "project/document.h"

namespace standpoint {

// A cloud of the project that can be looked at: a station's scan, or an underlay.
struct InspectedCloud {
  std::string label;  // "S1, house-S1.e57"
  std::filesystem::path file;
  Pose local_from_cloud;            // frame of the cloud's file to the local one
  int station = -1, underlay = -1;  // index; -1: it is none
  std::string scan = {};            // what a station's scan is called in a file that holds several
};

// The stations' scans, the newest of each first, then the underlays.
std::vector<InspectedCloud> inspectedClouds(const Document& document);
// The file of each station's newest scan, each file once.
std::vector<std::filesystem::path> newestOfStations(const std::vector<InspectedCloud>& clouds);
// Nothing where `file` is none of them.
const InspectedCloud* cloudOf(const std::vector<InspectedCloud>& clouds, const std::filesystem::path& file);

}  // namespace standpoint
