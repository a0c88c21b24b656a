// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/mesh.h"
#include "optimizer/optimizer.h"

namespace standpoint {

// A solid that a body bumps into: convex unless its kind is `mesh`.
struct Piece {
  CollisionShapeKind kind = CollisionShapeKind::convex;
  std::vector<Eigen::Vector3d> positions;
  std::vector<Triangle> triangles;  // outward
};

// A convex prism over a counter-clockwise polygon, given by its corners at the bottom and at the top.
Piece prism(const std::vector<Eigen::Vector3d>& bottom, const std::vector<Eigen::Vector3d>& top,
            CollisionShapeKind kind);

CollisionShape shapeOf(const Piece& piece, std::uint32_t product);

}  // namespace standpoint
