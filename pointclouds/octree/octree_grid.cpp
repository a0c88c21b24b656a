// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/octree/octree_grid.h"

#include <algorithm>
#include <cmath>

namespace standpoint::octree {

namespace {

// Two zeros after each of the lower 21 digits.
std::uint64_t spread(std::uint64_t x) {
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffff;
  x = (x | x << 16) & 0x1f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  return (x | x << 2) & 0x1249249249249249;
}

Eigen::Vector3d vectorOf(const std::array<float, 3>& p) { return {p[0], p[1], p[2]}; }

}  // namespace

std::uint64_t cellOf(const Cube& cube, const std::array<float, 3>& place_m, int bits) {
  const auto cells = static_cast<double>(std::uint64_t{1} << bits);
  const double scale = cells / cube.size_m;
  std::uint64_t cell = 0;
  for (int k = 0; k < 3; ++k) {
    const double at = (static_cast<double>(place_m[static_cast<std::size_t>(k)]) - cube.min_m[k]) * scale;
    cell |= spread(static_cast<std::uint64_t>(std::clamp(at, 0.0, cells - 1))) << k;
  }
  return cell;
}

GrowingCounts::Cell GrowingCounts::cellAt(const Eigen::Vector3d& p) const {
  Cell c;
  for (int k = 0; k < 3; ++k) c[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(std::floor(p[k] / size_m_));
  return c;
}

// Moves and joins the cells so that all of the bounds is inside.
void GrowingCounts::fit() {
  const auto fits = [&] {
    const Cell low = cellAt(bounds_.min), high = cellAt(bounds_.max);
    for (std::size_t k = 0; k < 3; ++k)
      if (high[k] - low[k] >= kGrid) return false;
    return true;
  };
  const double before_m = size_m_;
  const Cell base_before = base_;
  while (!fits()) size_m_ *= 2;
  base_ = cellAt(bounds_.min);
  if (empty_ || (before_m == size_m_ && base_before == base_)) return;
  const auto joined = static_cast<std::int64_t>(size_m_ / before_m);  // cells of before, each way
  const auto down = [&](std::int64_t a) { return a >= 0 ? a / joined : -((joined - 1 - a) / joined); };
  std::vector<std::uint64_t> counts(counts_.size(), 0);
  Cell c;
  for (c[2] = 0; c[2] < kGrid; ++c[2])
    for (c[1] = 0; c[1] < kGrid; ++c[1])
      for (c[0] = 0; c[0] < kGrid; ++c[0]) {
        const std::uint64_t n = counts_[index(c)];
        if (n == 0) continue;
        Cell to;
        for (std::size_t k = 0; k < 3; ++k) to[k] = down(base_before[k] + c[k]) - base_[k];
        counts[index(to)] += n;
      }
  counts_ = std::move(counts);
}

void GrowingCounts::add(std::span<const std::array<float, 3>> places_m) {
  if (places_m.empty()) return;
  for (const auto& p : places_m) bounds_.extend(vectorOf(p));
  const Cell low = cellAt(bounds_.min), high = cellAt(bounds_.max);
  bool inside = !empty_;
  for (std::size_t k = 0; k < 3; ++k) inside &= low[k] >= base_[k] && high[k] < base_[k] + kGrid;
  if (!inside) fit();
  empty_ = false;
  const double scale = 1 / size_m_;  // exact: a power of two
  for (const auto& p : places_m) {
    Cell c;
    for (std::size_t k = 0; k < 3; ++k)
      c[k] = static_cast<std::int64_t>(std::floor(static_cast<double>(p[k]) * scale)) - base_[k];
    ++counts_[index(c)];
  }
}

Cube GrowingCounts::cube() {
  if (!empty_) fit();
  Cube cube{Eigen::Vector3d::Zero(), size_m_ * kGrid, 0};
  for (int k = 0; k < 3; ++k) cube.min_m[k] = static_cast<double>(base_[static_cast<std::size_t>(k)]) * size_m_;
  return cube;
}

std::vector<std::uint64_t> GrowingCounts::counts() const {
  std::vector<std::uint64_t> ordered(counts_.size());
  for (std::int64_t z = 0; z < kGrid; ++z)
    for (std::int64_t y = 0; y < kGrid; ++y)
      for (std::int64_t x = 0; x < kGrid; ++x)
        ordered[spread(static_cast<std::uint64_t>(x)) | spread(static_cast<std::uint64_t>(y)) << 1 |
                spread(static_cast<std::uint64_t>(z)) << 2] = counts_[index({x, y, z})];
  return ordered;
}

}  // namespace standpoint::octree
