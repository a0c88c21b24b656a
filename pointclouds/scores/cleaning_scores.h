// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/progress.h"
#include "core/result.h"
#include "pointclouds/filters/cleaning.h"

namespace standpoint {

// What a cleaning removed of a class, and of what moved.
struct CleanedClass {
  std::string name;
  Taken good, flawed;
};
struct CleanedMover {
  std::string id, name;
  Taken points;
};

// What somebody's cleaning removed of a scan, by the scan's truth.
struct CleaningScores {
  Taken points, good, flawed;         // flawed: kFlawed
  std::array<Taken, 8> flags{};       // by bit of point_flag
  Taken plainly_mixed;                // as in FilterFigures
  std::vector<CleanedClass> classes;  // by name; without labels none
  std::vector<CleanedMover> movers;   // by name, of products that moving points are of
};

// A point of the scan as a cleaning left it; its place in the frame of the cloud's file.
struct CleanedPoint {
  Eigen::Vector3d at_m = Eigen::Vector3d::Zero();
  bool is_flawed = false, is_removed = false;
};
using TakeCleaned = std::function<void(const CleanedPoint& point)>;

// Reads the scan once. `kept` says of each point whether it is still there, not 0, by its number. A scan without truth
// is an error.
Result<CleaningScores> cleaningScores(const std::filesystem::path& truth, const std::vector<std::uint8_t>& kept,
                                      Progress& progress);
Result<void> forEachCleaned(const std::filesystem::path& truth, const std::vector<std::uint8_t>& kept,
                            const TakeCleaned& take, Progress& progress);

}  // namespace standpoint
