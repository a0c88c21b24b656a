// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/progress.h"
#include "core/report.h"
#include "core/result.h"

namespace standpoint {

// A measured place and the direction in which it was measured, in one frame.
struct BeamPoint {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  // m
  Eigen::Vector3d beam = Eigen::Vector3d::Zero();   // unit, from the scanner; zero where the file has no station
};

struct Ball {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // frame of the cloud's file, m
  double radius_m = 0.5;
};

// All points of a file that lie in a ball, not those of a sample that is shown.
struct RegionPoints {
  std::vector<BeamPoint> points;  // frame of the cloud's file, in its order
  std::uint64_t inside = 0;       // of which `points` are all, or a fair half, quarter … of them
  std::uint64_t read = 0;         // in the file
  Report report;                  // of reading
};

constexpr std::size_t kMostRegionPoints = 400000;

// Reads the file once; keeps between most/2 and `most` points where more lie in the ball. An empty region is no error.
Result<RegionPoints> readRegion(const std::filesystem::path& file, const Ball& ball, Progress& progress,
                                std::size_t most = kMostRegionPoints);

}  // namespace standpoint
