// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/mesh.h"
#include "core/progress.h"
#include "core/result.h"

namespace standpoint {

// Ways on foot over a walkable surface (CollideResult::walkable), on a grid of at least 5 cm and at most two million
// cells. Local frame, metres.
class WalkRoutes {
 public:
  explicit WalkRoutes(const Mesh& walkable);

  // Where one stands nearest to a point: at most 1.5 m beside it and 0.5 m above or below, so that nobody is taken to
  // the storey below. Nothing where there is no such place.
  std::optional<Eigen::Vector3d> nearest(const Eigen::Vector3d& point) const;
  // The shortest way along the grid, with the corners that the grid alone makes pulled straight: places on the surface
  // no farther apart than two cells. Empty where one cannot be walked to from the other. By A*; each step is at most
  // kStepHeight high.
  Result<std::vector<Eigen::Vector3d>> between(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                               Progress& progress) const;

 private:
  struct Cell {
    std::int32_t x = 0, y = 0;
    float z = 0;
  };
  static constexpr std::uint32_t kNone = 0xffffffffU;
  void cover(const Mesh& walkable, std::size_t triangle);
  Eigen::Vector3d place(std::uint32_t cell) const;
  std::uint32_t cellAt(std::int32_t x, std::int32_t y, double z, double reach_m) const;
  std::uint32_t nearestCell(const Eigen::Vector3d& point) const;
  bool straight(std::uint32_t from, std::uint32_t to, std::vector<std::uint32_t>& between) const;
  std::vector<Eigen::Vector3d> pulled(const std::vector<std::uint32_t>& cells) const;

  double cell_m_ = 0.05;
  std::vector<Cell> cells_;  // by y, x, z
};

}  // namespace standpoint
