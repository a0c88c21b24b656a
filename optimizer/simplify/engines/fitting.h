// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/progress.h"
#include "optimizer/simplify/collapses/collapse.h"
#include "optimizer/surface/shape.h"
#include "optimizer/surface/triangle_tree.h"

namespace standpoint {

struct FitTarget {
  double max_m = 0;        // places further from the shape than that weigh more and more
  int rounds = 6;          // of least squares
  std::uint32_t seed = 0;  // of the points at which distances are taken: others than those that measure the result
};

// Moves the vertices of a simpler form so that the mean distance between it and the shape becomes least: points spread
// over both, each with its foot on the other, and least squares over the vertices' moves, weighted by one over the
// distance (Hoppe et al. 1993 and iteratively reweighted least squares). No triangle turns by more than 72°, no vertex
// leaves the shape's box, and borders, lines and edges of three triangles stay. The best of a few rounds by the points'
// own distances; nothing where none is better. `form` is of the shape's vertices, with wedges where the shape has them.
std::vector<Collapse> fitted(const Shape& shape, const TriangleTree& tree, const Shape& form, const FitTarget& target,
                             const Progress& progress);

struct FarSpot {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // on the shape
  double distance_m = 0;
};

// Points that are further than `target.max_m` from the form, or whose place on the form is that far from the shape.
std::vector<FarSpot> farSpots(const Shape& shape, const TriangleTree& tree, const Shape& form, const FitTarget& target);

}  // namespace standpoint
