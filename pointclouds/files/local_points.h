// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/points.h"
#include "core/report.h"

namespace standpoint {

// What a reader found, before the coordinates become floats.
struct FoundPoints {
  std::vector<double> x, y, z;
  std::vector<double> true_x, true_y, true_z;  // where the scan has truth: in the frame of x, y, z
  PointBlock columns;                          // all but the coordinates
  std::size_t size() const { return x.size(); }
  void clear();
};

// Passes one scan of a file on to a sink. A file may hold coordinates that a float would spoil (an unregistered cloud
// in a national grid); then the frame is moved by whole metres and the pose takes the move up.
class LocalPoints {
 public:
  // `moves_frame`: whether the file's coordinates are finer than a float at all. Rounding up to `fineness_m`, half a
  // step of the file's own coordinates, loses nothing.
  LocalPoints(PointSink& sink, ScanHeader header, bool moves_frame, double fineness_m = 0);
  Result<void> write(FoundPoints& points);              // drops points that are not finite; clears `points`
  Result<void> picture(const StationPicture& picture);  // after the last point
  Result<void> finish(Report& report);

 private:
  Result<void> begin(const FoundPoints* first);
  PointSink& sink_;
  ScanHeader header_;
  bool moves_frame_ = false, begun_ = false;
  Eigen::Vector3d move_ = Eigen::Vector3d::Zero();
  double worst_rounding_m_ = 0, fineness_m_ = 0;
  std::uint64_t not_finite_ = 0;
};

}  // namespace standpoint
