// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/statistics/coverage.h"

#include <algorithm>
#include <cmath>

namespace standpoint {

std::uint64_t mixed(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15ULL;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31);
}

Cell cellAt(const Eigen::Vector3d& point, double cell_m) {
  Cell cell;
  for (int axis = 0; axis < 3; ++axis) {
    const double at = std::floor(point[axis] / cell_m);
    // Whatever a damaged file says, also NaN, becomes some cell.
    cell[axis] = std::abs(at) < 1e18 ? static_cast<std::int64_t>(at) : 0;
  }
  return cell;
}

std::uint64_t hashOf(const Cell& cell) {
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis) hash = mixed(hash ^ static_cast<std::uint64_t>(cell[axis]));
  return hash;
}

void Coverage::add(std::uint64_t hash) {
  if (hash == last_ && !hashes_.empty()) return;
  last_ = hash;
  if (!sampled(hash, halvings_)) return;
  hashes_.push_back(hash);
  if (hashes_.size() >= 2 * max_cells_) compact();
}

void Coverage::settle() { compact(); }

void Coverage::compact() {
  std::sort(hashes_.begin(), hashes_.end());
  hashes_.erase(std::unique(hashes_.begin(), hashes_.end()), hashes_.end());
  while (hashes_.size() > max_cells_) {
    ++halvings_;
    std::erase_if(hashes_, [&](std::uint64_t h) { return !sampled(h, halvings_); });
  }
}

double Coverage::sharedWith(const Coverage& other) const {
  const unsigned halvings = std::max(halvings_, other.halvings_);
  std::uint64_t mine = 0, shared = 0;
  for (const std::uint64_t hash : hashes_) {
    if (!sampled(hash, halvings)) continue;
    ++mine;
    shared += std::binary_search(other.hashes_.begin(), other.hashes_.end(), hash);
  }
  return mine == 0 ? 0 : static_cast<double>(shared) / static_cast<double>(mine);
}

}  // namespace standpoint
