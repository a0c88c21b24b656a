// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/progress.h"
#include "core/result.h"
#include "core/survey.h"

namespace standpoint {

// A place on a surface that a point is held against.
struct SurfaceTouch {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // unit; zero where nothing is within reach
};

// For each point, placed in the surface's frame, the surface nearest to it within `reach_m`: a model's triangles, or
// the planes of another cloud's points. The points stand in the order of those that were handed in; it may use threads.
using SurfaceSearch =
    std::function<void(std::span<const Eigen::Vector3d> placed, double reach_m, std::span<SurfaceTouch> touches)>;

struct SurfaceFitOptions {
  double reach_m = 0.5;  // of the search at first; it closes in as the points come to lie on the surface
  double min_reach_m = 0.03;
  int max_iterations = 60;
  double block_m = 0.5;  // points of one block are not independent: see sigma
};

// A motion that the surface does not hold: along a corridor, about a column.
struct FreeMotion {
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  // unit direction in the surface's frame; zero for a mere turn
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();   // unit, of the turn; zero for a mere shift
  double held_fraction = 0;                         // of the points that hold it; what is below kHeldShare is not moved
};
constexpr double kHeldFraction = 0.003;

struct SurfaceFit {
  Pose to_from;
  int iterations = 0;
  bool settled = false;      // else it stopped at most_iterations
  double rms_m = 0;          // of the used points, along the normals
  double used_fraction = 0;  // of all points: within reach, and not outvoted
  double moved_m = 0;        // root mean square of what it moved the points by
  // 1 σ of the placement at the points' middle, in the surface's axes, and of the turns about them, by the scatter of
  // whole blocks: what neighbours share (a wall that is not where the model has it) does not average out.
  Eigen::Vector3d sigma_shift_m = Eigen::Vector3d::Zero(), sigma_turn_rad = Eigen::Vector3d::Zero();
  std::vector<FreeMotion> free;  // empty when all six are held
};

// Point-to-plane ICP (Chen and Medioni 1992) from `start`, by Tukey's weights at a scale from the residuals' median.
// Where the surface leaves a motion free, that motion stays as it was (Zhang et al. 2016) and is told. Errors: unusable
// with fewer than 100 points or where fewer than 100 find a surface within reach; cancelled.
Result<SurfaceFit> fitToSurface(std::span<const Eigen::Vector3d> points, const Pose& start, const SurfaceSearch& search,
                                const SurfaceFitOptions& options, Progress& progress);

}  // namespace standpoint
