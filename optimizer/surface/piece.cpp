// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/surface/piece.h"

namespace standpoint {

Piece prism(const std::vector<Eigen::Vector3d>& bottom, const std::vector<Eigen::Vector3d>& top,
            CollisionShapeKind kind) {
  Piece piece{kind, bottom, {}};
  piece.positions.insert(piece.positions.end(), top.begin(), top.end());
  const auto n = static_cast<std::uint32_t>(bottom.size());
  for (std::uint32_t i = 1; i + 1 < n; ++i) {
    piece.triangles.push_back({0, i + 1, i});
    piece.triangles.push_back({n, n + i, n + i + 1});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    piece.triangles.push_back({i, j, n + j});
    piece.triangles.push_back({i, n + j, n + i});
  }
  return piece;
}

CollisionShape shapeOf(const Piece& piece, std::uint32_t product) {
  CollisionShape shape{piece.kind, product, {}};
  for (const auto& p : piece.positions) shape.mesh.positions.push_back(p.cast<float>());
  shape.mesh.triangles = piece.triangles;
  shape.mesh.surface_of_triangle.assign(piece.triangles.size(), 0);
  return shape;
}

}  // namespace standpoint
