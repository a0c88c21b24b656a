// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "scanners/ray_engine.h"

namespace standpoint {

// The product whose closed body a place is inside of: rays leave it through an odd number of its faces, the first from
// behind. Of a body whose faces look inwards (a room drawn as one) the inside is open. Only what is beneath the model's
// surface everywhere is sure to be found: a shell with holes is none.
std::optional<std::uint32_t> solidAround(const RayScene& scene, const Eigen::Vector3d& place);

}  // namespace standpoint
