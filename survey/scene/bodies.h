// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/environment.h"

namespace standpoint {

// Of each instance; empty for what is not in the scene.
std::vector<Bounds> instanceBounds(const Environment& environment);

// From a place to the nearest one in the box, m; 0 inside.
double distanceTo(const Bounds& box, const Eigen::Vector3d& place);

// The product whose closed body a place is inside of. A product with a class of its own is a body whichever way its
// faces look; of a mesh that only draws a room from inside, the faces look inwards, and its inside is open.
std::optional<std::uint32_t> bodyRound(const Environment& environment, const std::vector<Bounds>& instances,
                                       const Eigen::Vector3d& place);

// How a message calls a product: "IfcWall #12 'name'", "object /nodes/7".
std::string productText(const Product& product);

}  // namespace standpoint
