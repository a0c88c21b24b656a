// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/points.h"
#include "core/progress.h"
#include "core/report.h"
#include "core/result.h"

namespace standpoint {

// Where a scan's scanner stood, in the frame of the cloud's file; nothing where the file does not say (a LAS, a merged
// cloud).
std::optional<Eigen::Vector3d> stationOf(const ScanHeader& header);
// Is a pose more than the whole metres by which readers keep far coordinates fine?
bool isOfScanner(const Pose& file_from_scanner);

struct SampledScan {
  std::string name, sensor_vendor, sensor_model;
  std::optional<Eigen::Vector3d> station;  // stationOf
  std::uint64_t points = 0;                // that the file holds
};

// Points drawn evenly from a cloud by a hash of their number in the file: the same file gives the same sample.
struct CloudSample {
  std::vector<Eigen::Vector3d> position;  // frame of the cloud's file
  std::vector<float> intensity;           // raw; empty where the file has none
  std::vector<std::uint32_t> scan;
  std::vector<SampledScan> scans;
  std::uint64_t points = 0;                    // that the file holds
  float min_intensity = 0, max_intensity = 0;  // of all points
  Report report;                               // of reading
};

// Reads the file once; keeps between most/2 and `most` points of a larger cloud, all of a smaller one.
Result<CloudSample> sampleCloud(const std::filesystem::path& file, std::size_t most, Progress& progress);

// Of the first place in each cell of a grid, ascending: dense floors near a station then weigh no more than far walls.
std::vector<std::size_t> thinned(const std::vector<Eigen::Vector3d>& places, double cell_m, std::size_t most);

}  // namespace standpoint
