// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "core/environment.h"
#include "core/progress.h"
#include "core/result.h"
#include "pointclouds/octree/cloud_point.h"
#include "survey/scene/model_surface.h"

namespace standpoint {

constexpr double kDeviationReach_m = 1;  // farther off, a point is on nothing

// Points beside the model. `shift_m` leads from the local frame to the file's.
class ModelDeviation {
 public:
  ModelDeviation(const Environment& environment, const Eigen::Vector3d& shift_m)
      : surface_(environment), shift_m_(shift_m) {}
  // The distance of each point to the nearest surface of the model, > 0 outside, in metres; NaN where none is within
  // reach. Where the scanner of a point is known, surfaces that turn away from it do not count: a wall has two sides.
  // From any thread. Errors: cancelled.
  Result<std::vector<float>> of(std::span<const CloudPoint> points, const CloudHeader& header,
                                Progress& progress) const;

 private:
  ModelSurface surface_;
  Eigen::Vector3d shift_m_;
};

}  // namespace standpoint
