// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/survey.h"
#include "pointclouds/octree/cloud_point.h"

namespace standpoint {

// The poses at which scans are drawn: where they were made, or where registration believes them to be.
enum class ScanPoses { truth, solved };

// By which each scan of a cloud moves when its station stands where registration has it; local frame to local frame.
// A scan is of the station that has its name, else of the one whose scan its file is: `files` has one for each scan, or
// the one of all. One whose station was not registered, or that has no pose, stays.
std::vector<Pose> solvedMoves(const Job& job, const CloudHeader& header, const Eigen::Vector3d& shift_m,
                              std::span<const std::filesystem::path> files);

// How far registration is from the truth.
struct PoseOffset {
  std::string station;
  bool registered = false;  // then what follows
  double moved_m = 0, turned_rad = 0;
};
std::vector<PoseOffset> poseOffsets(const Job& job);  // of the stations that were scanned from
bool hasSolvedPose(const Job& job);                   // at least one of these

}  // namespace standpoint
