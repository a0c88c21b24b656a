// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/environment.h"

namespace standpoint {

constexpr std::uint32_t kNoCorner = ~0U;

// An edge of a mesh that can be an outline from somewhere: a bound of the mesh, or two triangles that are not in one
// plane. Vertices of the mesh; `left` and `right` are what its triangles have beside the edge.
struct MeshEdge {
  std::uint32_t from = 0, to = 0;
  std::uint32_t left = 0, right = kNoCorner;  // kNoCorner: nothing goes on there, or more than one triangle does
};

// Vertices in one place are one, whatever the mesh says. In a fixed order; 20 bytes a triangle while it works. Runs on
// the threads of the caller's arena.
std::vector<MeshEdge> outlineEdges(const Mesh& mesh);

}  // namespace standpoint
