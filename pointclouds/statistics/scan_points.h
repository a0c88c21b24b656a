// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/points.h"

namespace standpoint {

// The points of one scan that a filter looks at, in the scanner's frame: 12 bytes each, 8 for the number and, with a
// grid, 8 for the place in it.
struct ScanPoints {
  std::vector<Eigen::Vector3f> place_m;
  std::vector<std::uint64_t> number;  // in the file
  std::vector<std::uint64_t> cell;    // column << 32 | row; empty without a grid
  std::size_t size() const { return place_m.size(); }
  void clear();
  void append(const PointBlock& block, std::size_t i, std::uint64_t point, bool grid);
};

// Finds points by their place in the grid. Several returns of a pulse are found as the first that the file has.
class GridIndex {
 public:
  explicit GridIndex(ScanPoints& points);                                      // sorts them by cell
  std::optional<std::size_t> at(std::int64_t column, std::int64_t row) const;  // thread-safe

 private:
  const ScanPoints& points_;
  std::vector<std::uint64_t> columns_;  // those with points, ascending
  std::vector<std::size_t> begins_;     // of each, and the end of the last
};

// The `count` nearest of every point, nearest first and without the point itself, as indices; `count` is cut to what
// there is.
class NearestPoints {
 public:
  NearestPoints(const ScanPoints& points, std::size_t count);
  ~NearestPoints();
  std::size_t count() const { return count_; }
  void of(std::size_t point, std::vector<std::size_t>& neighbours, std::vector<float>& squared_m) const;  // thread-safe

 private:
  struct Tree;
  const ScanPoints& points_;
  std::size_t count_;
  std::unique_ptr<Tree> tree_;
};

}  // namespace standpoint
