// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "optimizer/surface/shape.h"

namespace standpoint {

// Which shape a shape repeats, and how: its positions (about its own centre) are motion * those of the first one.
struct Repetition {
  std::uint32_t first = 0;  // itself where it repeats nothing
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  double residual_m =
      0;  // how far any vertex is from where the first one's is put; at most 0.05 mm and 1/10 000 of its size
};

// Finds shapes that are the same but for a motion, whatever the order of their vertices: candidates by counts, area and
// distances of the vertices from the centroid, then each proved vertex by vertex and triangle by triangle, surfaces
// included. A mirrored shape is another shape. Only shapes of the same `kind` are compared; painted ones (wedges) and
// empty ones are left alone.
std::vector<Repetition> findRepetitions(const std::vector<Shape>& shapes, const std::vector<std::uint32_t>& kinds);

}  // namespace standpoint
