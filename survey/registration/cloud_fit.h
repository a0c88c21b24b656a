// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/environment.h"
#include "core/surface_fit.h"
#include "core/survey.h"
#include "pointclouds/statistics/cloud_sample.h"

namespace standpoint {

// Points of a station that is placed already.
struct PlacedCloud {
  Pose local_from_station;
  std::span<const Eigen::Vector3d> points;  // the station's own frame
};

// Fits a station's points to the surface that others show: planes of their points in cells of 15 cm.
Result<SurfaceFit> fitCloudToClouds(std::span<const Eigen::Vector3d> points, const Pose& start,
                                    std::span<const PlacedCloud> others, double reach_m, Progress& progress);

// Fits the cloud to the model's scene from where `file_from_cloud` puts it; the fit's poses are in the model's file
// frame, which is the local one plus `shift_m`.
Result<SurfaceFit> fitCloudToModel(const Environment& model, const Eigen::Vector3d& shift_m, const CloudSample& sample,
                                   const Pose& file_from_cloud, double reach_m, Progress& progress);
// "along (1.00, 0.00, 0.00)", "about (0.00, 0.00, 1.00)"
std::string describe(const FreeMotion& motion);

constexpr std::size_t kSampleForFit = 1000000;

}  // namespace standpoint
