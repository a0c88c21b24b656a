// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The ways of a solid Boolean, from quick and exact to slow and general. Each says in an error why it could not.

#include <optional>
#include <span>

#include "importers/geometry/kernel.h"

namespace standpoint::geometry {

enum class Operation { difference, intersection, unite };

// The direction along which the first mesh and most of the others are prismatic: every face stands on it or lies along
// it.
struct CommonDirection {
  Eigen::Vector3d direction;
  std::vector<bool> fits;  // parallel to the others
};
std::optional<CommonDirection> commonDirection(const PolyMesh& first, std::span<const PolyMesh> others);

// All meshes must be prismatic along the direction and turned outward. Cuts space into slabs in which nothing changes,
// works in the plane, and joins the slabs with shared points.
Result<PolyMesh> combinePrisms(const PolyMesh& a, std::span<const PolyMesh> b, const Eigen::Vector3d& direction,
                               Operation operation);

// Points snapped to 1e-6 m. Closed meshes only: on others carve may run without end.
Result<PolyMesh> combineWithCarve(const PolyMesh& a, const PolyMesh& b, Operation operation);

// Exact arithmetic, triangles only: the last resort.
Result<PolyMesh> combineWithCgal(const PolyMesh& a, std::span<const PolyMesh> b, Operation operation);

}  // namespace standpoint::geometry
