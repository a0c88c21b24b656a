// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/georeference.h"
#include "core/result.h"
#include "core/survey.h"
#include "scanners/engine/ray_engine.h"

namespace standpoint {

// "X,Y" or "X,Y,Z" in the model's own frame, which may end in ":SECONDS" of a stop, or ":SECONDS:DEGREES" with the
// direction in which it looks from there on, counter-clockwise from X: on the floor there with that much free height,
// or in the air where its height is stated and no floor is. One of `known` that is there already keeps its place to the
// last digit. An error says which text is wrong, at `option`.
Result<std::vector<Waypoint>> waypointsOf(const std::vector<std::string>& texts, const RayScene& scene,
                                          const Georeference& georeference, double height_m, const char* option,
                                          std::span<const Waypoint> known = {});

}  // namespace standpoint
