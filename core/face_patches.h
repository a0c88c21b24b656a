// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/environment.h"
#include "core/physical_material.h"

namespace standpoint {

struct PlacedTriangle {
  std::uint32_t instance = 0, triangle = 0;  // index into Environment::instances, and into its mesh's triangles
  auto operator<=>(const PlacedTriangle&) const = default;
};

// So far from its point a face is still taken for the one that was meant: what a lighter or a later model may be off.
constexpr double kPatchReach_m = 0.1;

// The triangle of a product nearest to `point` among those that look within kFaceCone of `direction`; with a surface,
// of that one only. Nothing within reach: nothing.
std::optional<PlacedTriangle> nearestFace(const Environment& environment, std::uint32_t product,
                                          std::optional<std::uint32_t> surface, const Eigen::Vector3d& direction,
                                          const Eigen::Vector3d& point);

// Which material single triangles have. Finds the patches of an assignment once, in this environment: the model as it
// was imported and the lighter one each have their own triangles. Both arguments must outlive it.
class AssignedTriangles {
 public:
  AssignedTriangles(const Environment& environment, const MaterialAssignment& assignment);

  std::int32_t materialOf(std::uint32_t instance, std::uint32_t triangle) const;  // -1 when it is not assigned
  // The triangles that AssignedFaces number `index` means, rising; empty when it means all that look its way.
  const std::vector<PlacedTriangle>& patch(std::size_t index) const { return patches_[index]; }

 private:
  const Environment& environment_;
  const MaterialAssignment& assignment_;
  std::vector<std::vector<PlacedTriangle>> patches_;  // of each of assignment.faces
};

}  // namespace standpoint
