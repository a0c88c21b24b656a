// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/mesh.h"

namespace standpoint {

using EdgeLine = std::array<std::uint32_t, 2>;  // indices into Mesh::positions

// The edges that a draughtsman would draw: where the surface ends, and where two faces meet at more than `angle_rad`.
// Positions that are equal count as one, so that a mesh that is not welded gives the same lines.
std::vector<EdgeLine> featureEdges(const Mesh& mesh, double angle_rad);

}  // namespace standpoint
