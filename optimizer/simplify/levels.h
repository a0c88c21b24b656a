// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "optimizer/simplify/collapses/collapse.h"
#include "optimizer/surface/deviation.h"
#include "optimizer/surface/shape.h"

namespace standpoint {

// One simpler form of a shape.
struct Level {
  std::uint32_t triangles = 0;  // that it has
  std::uint32_t collapses = 0;  // steps of the log that lead to it, unless it is a stand-in
  std::int32_t stand_in = -1;   // index into ShapeLevels::stand_ins
  double cost = 0;              // m³ (area times mean distance) per triangle saved since the level before; never falls
};

// All forms of a shape from full to gone, each worth its price: the lower convex hull of measured deviation over
// triangles.
struct ShapeLevels {
  std::vector<Collapse> log;
  std::vector<Shape> stand_ins;  // its box, and the rectangle that halves the box where that is thinnest
  std::vector<Level> levels;
};

// How the shape's largest copy stands.
struct Placement {
  double scale = 1;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  // in the shape's own frame
};

// Without loss every step of the log is a level that costs nothing. Else the deviation is measured at a few of the
// steps, so that shapes compete by what one would see and not by their quadrics, which overrate thin and underrate
// folded parts. Forms that close a doorway are left out, and stand-ins for what is painted. `tree` becomes the shape's.
ShapeLevels makeLevels(const Shape& shape, std::unique_ptr<TriangleTree>& tree, const CollapseOptions& options,
                       const Placement& placement, std::uint64_t seed, const Progress& progress);

// `levels` of them taken; 0 is the shape itself. `image` as for replay().
Shape atLevel(const Shape& shape, const ShapeLevels& levels, std::size_t taken, std::vector<std::uint32_t>& image);

}  // namespace standpoint
