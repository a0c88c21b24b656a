// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/soup/position_welder.h"

#include <algorithm>
#include <bit>

namespace standpoint {

namespace {

constexpr std::uint32_t kFree = 0xFFFFFFFFU;

std::uint64_t hashOf(const Eigen::Vector3d& p) {
  std::uint64_t h = 0;
  for (int i = 0; i < 3; ++i) {
    h = (h ^ std::bit_cast<std::uint64_t>(p[i])) * 0x9E3779B97F4A7C15U;
    h ^= h >> 32U;
  }
  return h;
}

}  // namespace

std::uint32_t PositionWelder::weld(const Eigen::Vector3d& p, std::vector<Eigen::Vector3d>& positions) {
  const Eigen::Vector3d at = p + Eigen::Vector3d::Zero();  // -0 → 0
  if (2 * (positions.size() + 1) > table_.size()) grow(positions);
  std::size_t slot = hashOf(at) & (table_.size() - 1);
  for (; table_[slot] != kFree; slot = (slot + 1) & (table_.size() - 1))
    if (positions[table_[slot]] == at) return table_[slot];
  table_[slot] = static_cast<std::uint32_t>(positions.size());
  positions.push_back(at);
  return table_[slot];
}

void PositionWelder::grow(const std::vector<Eigen::Vector3d>& positions) {
  table_.assign(std::max<std::size_t>(1024, 2 * table_.size()), kFree);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    std::size_t slot = hashOf(positions[i]) & (table_.size() - 1);
    while (table_[slot] != kFree) slot = (slot + 1) & (table_.size() - 1);
    table_[slot] = static_cast<std::uint32_t>(i);
  }
}

}  // namespace standpoint
