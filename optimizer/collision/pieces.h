// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/progress.h"
#include "optimizer/optimizer.h"
#include "optimizer/surface/piece.h"
#include "optimizer/surface/shape.h"

namespace standpoint {

struct Pieces {
  std::vector<Piece> pieces;
  double max_deviation_m = 0;  // between the pieces' outer surface and the shape's, measured
  bool fell_back = false;      // a part that no convex pieces describe stays a triangle mesh
};

// Connected part by part: boxes between the planes of its faces where these are square to each other, else its convex
// hull, else prisms over a convex partition of its section, else what cuts along its reflex planes leave: whatever is
// least and deviates by at most max_deviation_m; else its triangles.
Pieces collisionPieces(const Shape& shape, double max_deviation_m, const Progress& progress);

// The ways, each empty when it does not apply. `volume_m3` of the closed part tells whether nothing was lost.
std::vector<Piece> boxPieces(const Shape& part, double volume_m3);
// Over a section that may be simplified by tolerance_m on either side, its ends cut off by planes.
std::vector<Piece> prismPieces(const Shape& part, double volume_m3, double tolerance_m);
// A part without a volume becomes a plate of a millimetre.
std::vector<Piece> sheetPieces(const Shape& part);
// Cut along the planes of its reflex faces until no face has anything more than tolerance_m before it.
std::vector<Piece> cutPieces(const Shape& part, double tolerance_m);
std::optional<Piece> hullPiece(const std::vector<Eigen::Vector3d>& points);

double volumeOf(const std::vector<Eigen::Vector3d>& positions, const std::vector<Triangle>& triangles);

// Sorted, values closer than `tolerance` to the one before joined.
std::vector<double> distinct(std::vector<double> values, double tolerance);

}  // namespace standpoint
