// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

namespace standpoint {

using Outline = std::vector<Eigen::Vector2d>;  // counter-clockwise

// Few convex outlines that cover all of `solids` and nothing of `gaps`, and may lie over each other: what is around a
// hole of n sides needs one for each side, however many holes a wall has between its ends. All that is given is convex,
// and together without overlap the convex hull of the solids. By greedy choice of the outline that covers most of what
// is left; none where that would take long.
std::vector<Outline> coverOf(const std::vector<Outline>& solids, const std::vector<Outline>& gaps);

// The closed outline with as few sides as keep within tolerance_m of it on either side.
Outline simplified(const Outline& given, double tolerance_m);

}  // namespace standpoint
