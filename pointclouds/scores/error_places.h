// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/environment.h"
#include "core/points.h"
#include "core/progress.h"
#include "core/result.h"

namespace standpoint {

// Every point of a cloud, all its scans one after the other, as trueClasses has them: its place in the frame of the
// cloud's file, its number from 0, and the scan that it is of. Reads the file once, in memory that does not grow.
using TakePlace = std::function<void(const ScanHeader& scan, const Eigen::Vector3d& at_m, std::uint64_t number)>;
Result<std::uint64_t> forEachPlace(const std::filesystem::path& cloud, const TakePlace& take, Progress& progress);

// Where points are along one axis, without the few that lie far off (seen by way of a mirror, or of nothing). Counts in
// bins of 1 cm that become twice as wide when the range outgrows them: 64 kB whatever comes.
class AxisSpread {
 public:
  void add(double at);
  // What holds all but the share `left_out` at either end, a bin more or less; (0, 0) without points.
  std::pair<double, double> range(double left_out) const;

 private:
  static constexpr std::size_t kBins = 8192;
  double width_ = 0.01, first_ = 0;    // m; the number of the first bin: bin k begins at k · width_
  std::vector<std::uint64_t> counts_;  // empty without points
  std::uint64_t points_ = 0;
};

// Of the three axes.
class PointSpread {
 public:
  void add(const Eigen::Vector3d& at);
  std::uint64_t points() const { return points_; }
  const Bounds& bounds() const { return bounds_; }
  Bounds without(double left_out) const;  // as AxisSpread::range; within bounds()

 private:
  std::array<AxisSpread, 3> axes_;
  Bounds bounds_;
  std::uint64_t points_ = 0;
};

// Where points are the densest: counts them in cubes of half a metre, which become twice as wide when there are more
// than 65 536 of them.
class DensestPlace {
 public:
  void add(const Eigen::Vector3d& at);
  struct Place {
    Eigen::Vector3d at_m = Eigen::Vector3d::Zero();  // the middle of the points counted there
    double edge_m = 0;                               // of the cube of three by three by three that they lie in
    std::uint64_t points = 0;
  };
  // Of equal ones the one with the smallest x, then y, then z; nothing without points.
  std::optional<Place> place() const;

 private:
  static constexpr std::size_t kMost = 65536;
  using Cube = std::array<std::int64_t, 3>;
  struct Content {
    std::uint64_t points = 0;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();  // of what each is off origin_
  };
  double edge_m_ = 0.5;
  std::optional<Eigen::Vector3d> origin_;  // near the first point: a sum keeps its millimetres on a national grid
  std::map<Cube, Content> cubes_;
};

}  // namespace standpoint
