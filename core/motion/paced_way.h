// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>

#include <Eigen/Core>

#include "core/motion/pose_spline.h"

namespace standpoint {

// The poses of somebody who is at these places every `step_s`, from 0 s on: upright, looking where they go, and where
// they stand turning evenly to where they go next, by no more than half a turn a second. `returns`: at the end they
// stand for a second and come back, place by place. An error where there are fewer than two places.
Result<PoseSpline> pacedWay(std::span<const Eigen::Vector3d> places_m, double step_s, bool returns);

// The same of somebody who carried something so, whatever its attitude was: by its places every 0.2 s, each the mean of
// 1.2 s, so that steps and shaking are gone; by its own clock. An error where it has no end.
Result<PoseFunctionPtr> wayOnFoot(const PoseFunction& carried);

}  // namespace standpoint
