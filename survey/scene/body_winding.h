// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/environment.h"

namespace standpoint {

// How often the surfaces of a product go round a point: 1 inside a closed body whose faces look outwards, -1 where they
// look inwards, 0 outside, and some share where the surface has holes. The sum of the solid angles of all triangles, so
// it needs no lucky direction.
double windingOf(const Environment& environment, const std::vector<std::uint32_t>& instances,
                 const Eigen::Vector3d& place);

// Of each instance; empty for what is not in the scene.
std::vector<Bounds> instanceBounds(const Environment& environment);

// The product whose closed body a place is inside of. A product with a class of its own is a body whichever way its
// faces look; of a mesh that only draws a room from inside, the faces look inwards, and its inside is open.
std::optional<std::uint32_t> bodyRound(const Environment& environment, const std::vector<Bounds>& instances,
                                       const Eigen::Vector3d& place);

}  // namespace standpoint
