// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <span>
#include <utility>

#include "core/physical_material.h"

namespace standpoint {

// Null when the pair is not assigned.
inline const AssignedSurface* assignedSurface(const MaterialAssignment& assignment, std::uint32_t product,
                                              std::uint32_t surface) {
  const auto& all = assignment.surfaces;
  const auto before = [](const AssignedSurface& a, const std::pair<std::uint32_t, std::uint32_t>& key) {
    return std::pair(a.product, a.surface) < key;
  };
  const auto found = std::lower_bound(all.begin(), all.end(), std::pair(product, surface), before);
  return found == all.end() || found->product != product || found->surface != surface ? nullptr : &*found;
}

// In their order: of several that fit a face, the last one holds.
inline std::span<const AssignedFaces> assignedFaces(const MaterialAssignment& assignment, std::uint32_t product,
                                                    std::uint32_t surface) {
  struct Before {
    using Key = std::pair<std::uint32_t, std::uint32_t>;
    bool operator()(const AssignedFaces& a, const Key& key) const { return Key(a.product, a.surface) < key; }
    bool operator()(const Key& key, const AssignedFaces& a) const { return key < Key(a.product, a.surface); }
  };
  const auto [first, last] =
      std::equal_range(assignment.faces.begin(), assignment.faces.end(), std::pair(product, surface), Before());
  return {first, last};
}

}  // namespace standpoint
