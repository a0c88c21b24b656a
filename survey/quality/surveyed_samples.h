// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scanners/forecast/surface_samples.h"

namespace standpoint {

// Of each sample, a 1 where a survey from these places (local frame) is to see it. Where one of them is in a room these
// are the samples of rooms: a corner of the terrain, or the back of a wall, is not what was missed inside. A room is an
// IfcSpace; in a model without any, a place with surfaces above and below that face it. Else, or where no sample is in
// a room, all.
std::vector<std::uint8_t> surveyedSamples(const SurfaceSamples& samples, const RayScene& scene,
                                          std::span<const Eigen::Vector3d> stands);

}  // namespace standpoint
