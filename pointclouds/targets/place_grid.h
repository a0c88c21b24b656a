// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "pointclouds/statistics/coverage.h"

namespace standpoint {

// Places by the cells of a grid, to be asked for those near a point. It keeps a reference: the places must outlive it.
class PlaceGrid {
 public:
  PlaceGrid(std::span<const Eigen::Vector3d> places, double cell_m) : places_(places), cell_m_(cell_m) {
    entries_.reserve(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) entries_.emplace_back(hashOf(cellAt(places[i], cell_m)), i);
    std::sort(entries_.begin(), entries_.end());
  }

  // visit(index) for all within `radius_m`, which is at most a cell. Two cells with one hash are seen once.
  template <class Visit>
  void near(const Eigen::Vector3d& p, double radius_m, Visit visit) const {
    const Cell middle = cellAt(p, cell_m_);
    std::uint64_t hashes[27];
    int count = 0;
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) hashes[count++] = hashOf(middle + Cell(x, y, z));
    std::sort(hashes, hashes + count);
    count = static_cast<int>(std::unique(hashes, hashes + count) - hashes);
    for (int k = 0; k < count; ++k)
      for (auto at = std::lower_bound(entries_.begin(), entries_.end(), std::pair{hashes[k], std::size_t{0}});
           at != entries_.end() && at->first == hashes[k]; ++at)
        if ((places_[at->second] - p).squaredNorm() <= radius_m * radius_m) visit(at->second);
  }

 private:
  std::span<const Eigen::Vector3d> places_;
  double cell_m_;
  std::vector<std::pair<std::uint64_t, std::size_t>> entries_;
};

}  // namespace standpoint
