// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/environment.h"

namespace standpoint::octree {

constexpr int kGrid = 128;  // cells each way

// A cube and its place in the octree.
struct Cube {
  Eigen::Vector3d min_m = Eigen::Vector3d::Zero();
  double size_m = 1;
  int level = 0;
  Cube child(unsigned octant) const {
    return {min_m + size_m / 2 * Eigen::Vector3d(octant & 1U, octant >> 1 & 1U, octant >> 2 & 1U), size_m / 2,
            level + 1};
  }
};

// The index of the cell, of 2^bits each way, that a point of the cube is in; the digits of x, y and z interleaved, so
// that the cells of a node of the octree are one run of numbers. What lies outside counts to the next cell.
std::uint64_t cellOf(const Cube& cube, const std::array<float, 3>& place_m, int bits);

// Counts points in 128³ cells of a cube that grows with them: cells have a power of two as their size and a multiple of
// it as their place, so they can be joined by eights, and cube and counts hang on the points alone, not on their order.
class GrowingCounts {
 public:
  GrowingCounts() : counts_(std::size_t{kGrid} * kGrid * kGrid, 0) {}
  void add(std::span<const std::array<float, 3>> places_m);
  const Bounds& bounds() const { return bounds_; }
  // The smallest such cube around all; its cells have the counts in the order of cellOf(cube, place, 7).
  Cube cube();
  std::vector<std::uint64_t> counts() const;

 private:
  using Cell = std::array<std::int64_t, 3>;
  Cell cellAt(const Eigen::Vector3d& p) const;
  void fit();
  std::size_t index(const Cell& c) const { return static_cast<std::size_t>((c[2] * kGrid + c[1]) * kGrid + c[0]); }
  std::vector<std::uint64_t> counts_;
  double size_m_ = 1.0 / 1024;  // of a cell
  Cell base_ = {};              // of the first cell
  bool empty_ = true;
  Bounds bounds_;
};

}  // namespace standpoint::octree
