// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace standpoint {

// Gives corners that are equal bit for bit one position; 0 and -0 are equal.
class PositionWelder {
 public:
  // Index into `positions`, to which only this adds.
  std::uint32_t weld(const Eigen::Vector3d& p, std::vector<Eigen::Vector3d>& positions);

 private:
  void grow(const std::vector<Eigen::Vector3d>& positions);

  std::vector<std::uint32_t> table_;  // open addressing: index of a position, or free
};

}  // namespace standpoint
