// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "core/surface_fit.h"
#include "project/document.h"

namespace standpoint {

// Points of a station that is placed already.
struct PlacedCloud {
  Pose local_from_station;
  std::span<const Eigen::Vector3d> points;  // the station's own frame
};

// Fits a station's points to the surface that others show: planes of their points in cells of 15 cm.
Result<SurfaceFit> fitCloudToClouds(std::span<const Eigen::Vector3d> points, const Pose& start,
                                    std::span<const PlacedCloud> others, double reach_m, Progress& progress);

}  // namespace standpoint
