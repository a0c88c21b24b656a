// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/environment.h"

namespace standpoint {

// The walkable surface as level rectangles, two triangles each, and how one walks from one to the next: they are joined
// where they touch with no more than a step between them.
class WalkableMap {
 public:
  explicit WalkableMap(const Mesh& walkable);

  std::size_t size() const { return boxes_.size(); }
  const Bounds& box(std::uint32_t i) const { return boxes_[i]; }
  Eigen::Vector3d middle(std::uint32_t i) const { return 0.5 * (boxes_[i].min + boxes_[i].max); }
  double area(std::uint32_t i) const;
  // All that can be walked to from each other has the same one.
  std::uint32_t islandOf(std::uint32_t i) const { return island_[i]; }
  double islandArea(std::uint32_t i) const { return area_of_island_.at(island_[i]); }

  // The rectangle that p stands on or, within 0.6 m, beside.
  std::optional<std::uint32_t> at(const Eigen::Vector3d& p) const;
  // The one that p stands on, no more than a step above or below.
  std::optional<std::uint32_t> under(const Eigen::Vector3d& p) const;
  // Whether there is another floor a storey below p.
  bool anyUnder(const Eigen::Vector3d& p) const;

  // Of a straight piece of way within one rectangle, from its ends; at least 0.
  using Cost = std::function<double(const Eigen::Vector3d&, const Eigen::Vector3d&)>;
  // The cheapest way from any of some rectangles to one that is wanted: its corners, from one rectangle to the next.
  // Empty where none leads there.
  std::vector<Eigen::Vector3d> cheapestWay(std::span<const Eigen::Vector3d> from,
                                           const std::function<bool(std::uint32_t)>& wanted, const Cost& cost) const;
  // A short way on the surface that turns only where it must; each corner can be walked to straight from the one
  // before. Empty where none leads there.
  std::vector<Eigen::Vector3d> way(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

 private:
  using Tile = std::pair<int, int>;
  void join();
  void unite(std::uint32_t a, std::uint32_t b);
  std::uint32_t rootOf(std::uint32_t i);
  bool isStraight(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

  std::vector<Bounds> boxes_;
  std::vector<std::uint32_t> island_;
  std::vector<std::vector<std::uint32_t>> neighbours_;
  std::map<std::uint32_t, double> area_of_island_;
  std::map<Tile, std::vector<std::uint32_t>> in_tile_;
};

}  // namespace standpoint
