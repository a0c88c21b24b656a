// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "core/report.h"
#include "core/survey.h"
#include "scanners/engine/ray_engine.h"

namespace standpoint {

// Where a target is wanted, by one of the three. Places in metres, the frame of the model's file.
struct TargetPlace {
  std::optional<Eigen::Vector3d> at;          // its centre
  std::optional<FloorPlace> on;               // a floor, below its tripod
  double height_m = 1.5;                      // of its centre above that floor
  std::optional<Eigen::Vector3d> on_surface;  // stuck to what is nearest
  double stand_off_m = 0;                     // between surface and target
  std::optional<Eigen::Vector3d> normal;  // of a checkerboard; nothing: towards the nearest station, off the surface
};

// The target (its name, shape and size) at its place in the local frame: the file's less `shift_m`. `stands` says on
// what. Refused where it does not fit, is inside a solid, or has nothing to stand on.
Result<Target> placedTarget(const Job& job, const Eigen::Vector3d& shift_m, const RayScene& scene, Target target,
                            const TargetPlace& place, std::string& stands, Report& report);

}  // namespace standpoint
