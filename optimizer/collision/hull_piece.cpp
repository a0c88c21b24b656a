// SPDX-License-Identifier: GPL-3.0-or-later
#include <LinearMath/btConvexHullComputer.h>

#include "optimizer/collision/pieces.h"

namespace standpoint {

std::optional<Piece> hullPiece(const std::vector<Eigen::Vector3d>& points) {
  if (points.size() < 4) return std::nullopt;
  std::vector<float> coordinates;
  for (const auto& p : points)
    for (int k = 0; k < 3; ++k) coordinates.push_back(static_cast<float>(p[k]));
  btConvexHullComputer hull;
  hull.compute(coordinates.data(), 3 * sizeof(float), static_cast<int>(points.size()), 0, 0);
  Piece piece;
  for (int i = 0; i < hull.vertices.size(); ++i)
    piece.positions.push_back(
        points[static_cast<std::size_t>(hull.original_vertex_index[i])]);  // Bullet's own are rounded
  for (int i = 0; i < hull.faces.size(); ++i) {
    const auto* first = &hull.edges[hull.faces[i]];
    const auto apex = static_cast<std::uint32_t>(first->getSourceVertex());
    for (const auto* edge = first->getNextEdgeOfFace(); edge->getTargetVertex() != first->getSourceVertex();
         edge = edge->getNextEdgeOfFace())
      piece.triangles.push_back({apex, static_cast<std::uint32_t>(edge->getSourceVertex()),
                                 static_cast<std::uint32_t>(edge->getTargetVertex())});
  }
  const double volume = volumeOf(piece.positions, piece.triangles);
  if (volume < 0)
    for (auto& t : piece.triangles) std::swap(t[1], t[2]);
  if (piece.triangles.size() < 4 || volume == 0) return std::nullopt;  // flat
  return piece;
}

}  // namespace standpoint
