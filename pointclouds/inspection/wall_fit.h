// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/result.h"
#include "pointclouds/inspection/region_points.h"

namespace standpoint {

struct WallOptions {
  std::optional<Eigen::Vector3d> normal;  // of the model's face: other planes of the region are not meant
  double roughness_radius_m = 0.05;
  std::size_t fewest_points = 200;
};

// Residuals along one axis of the plane.
struct WallProfile {
  double low_m = 0, step_m = 0;  // of the first bin, from WallFit::centre
  struct Bin {
    std::uint32_t points = 0;
    double mean_m = 0, sigma_m = 0;  // of the residuals
  };
  std::vector<Bin> bins;
};

// How rough a surface is: distances of sampled points to the plane of their neighbours within the radius, as
// CloudCompare has it, of the fitted points alone: what stands before the wall is no roughness of it. The instrument's
// noise is in it; what is longer than the radius is not.
struct WallRoughness {
  double radius_m = 0;
  std::size_t samples = 0;  // with three neighbours or more
  double mean_m = 0, rms_m = 0;
};

// A plane through measured points. Residuals are along the normal, > 0 towards the scanner.
struct WallFit {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(), normal = Eigen::Vector3d::UnitX();  // towards the scanner
  Eigen::Vector3d along = Eigen::Vector3d::UnitY(), up = Eigen::Vector3d::UnitZ();      // in the plane; along is level
  std::size_t points = 0;                                                               // given
  std::size_t fitted = 0;                                                               // within three sigma
  // Of the fitted points; sigma with fitted - 3 degrees of freedom.
  double sigma_m = 0, max_m = 0;
  std::optional<double> beam_sigma_m;   // of residual / cos(incidence): how an instrument's range noise is defined
  std::optional<double> incidence_rad;  // mean, between beam and normal
  bool level = false;                   // a floor or a ceiling: nearer to level than to plumb
  double tilt_rad = 0;                  // from plumb, or of a floor from level; >= 0
  double width_m = 0, height_m = 0;     // of the fitted points, along `along` and `up`
  WallRoughness roughness;
  static constexpr std::size_t kBins = 41;
  double histogram_reach_m = 0;                     // bins of equal width from -reach to reach
  std::array<std::uint32_t, kBins> histogram = {};  // of all points, fitted or not, that lie within
  std::size_t beyond = 0;                           // those that do not
  WallProfile across, upward;                       // along `along` and `up`, of the fitted points
};

// Robust: a seed of the least median of squared distances among planes through three points (Rousseeuw 1984), then
// total least squares of the points within 3 · 1.4826 medians of |residual|, until these stay the same. The same points
// give the same fit. Errors (`unusable`): too few points, or none of the planes lies as `normal` says.
Result<WallFit> fitWall(std::span<const BeamPoint> points, const WallOptions& options);

}  // namespace standpoint
