// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "survey/quality/place_verdict.h"

namespace standpoint {

struct Model;

// The verdict's sign, word and reason, of the place of a station: `centre` of the instrument, local frame. Nothing
// while the scene is prepared.
void drawPlaceVerdict(const Model& model, const Eigen::Vector3d& centre, bool on_tripod);

}  // namespace standpoint
