// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "core/progress.h"
#include "core/result.h"
#include "core/survey.h"
#include "editor/clouds/cloud.h"

namespace standpoint {

// A scan that is looked at from where it stands here, whatever pose its file has.
struct PosedScan {
  std::filesystem::path file;
  std::optional<Pose> local_from_scanner;  // nothing: where its file has it
  std::string scan = {};                   // of a file that holds several, that of this name; "": all
};

// What is kept of scans: a ball, or the slice of it between two planes that lie `half_slice_m` before and behind its
// centre along `slice`. Local frame.
struct CropShape {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius_m = 1;
  std::optional<Eigen::Vector3d> slice;  // unit
  double half_slice_m = 0;
  bool keeps(const Eigen::Vector3d& local) const;
};

// All points of the scans that lie there, not a sample of the whole, which would look coarser than it is. Where there
// are more than `most`, an even part of them.
Result<Cloud> croppedCloud(std::span<const PosedScan> scans, const CropShape& shape, const Eigen::Vector3d& shift_m,
                           std::uint64_t most, Progress& progress);

// Gives two clouds one scale of colours, so that what looks alike is alike.
void colourAlike(Cloud& one, Cloud& other);
// Lets the points with any of these bits of point_flag stand out.
void highlight(Cloud& cloud, std::uint8_t flags);

}  // namespace standpoint
