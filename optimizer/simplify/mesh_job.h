// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/environment.h"
#include "optimizer/optimizer.h"
#include "optimizer/simplify/levels.h"
#include "optimizer/surface/deviation.h"
#include "optimizer/surface/shape.h"

namespace standpoint {

// What one mesh, shared by its copies, goes through.
struct MeshJob {
  Shape shape, lighter;
  WeldCounts welded;
  std::unique_ptr<TriangleTree> tree;  // of shape; while it is simplified and measured
  ShapeLevels levels;
  std::vector<Collapse> steps;  // that lead from shape to lighter; none where it stayed or is a stand-in
  std::size_t limit = 0, taken = 0;
  std::size_t floor = 0;  // triangles that the budget leaves it anyway: simpler forms are not made
  std::uint64_t copies = 0;
  double scale = 0;  // of the largest copy: deviations are measured in its metres
  double placed_area_m2 = 0;
  double cap_m = std::numeric_limits<double>::infinity();  // on the deviation, in the mesh's own frame
  double weight = 0;
  std::uint32_t budget_group = 0;
  bool keep = false;
  bool lossless = false;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  // of the first copy, in the mesh's frame
  std::uint32_t samples = 0;
  Deviation deviation;  // in the mesh's own frame
  bool measured = false;
  std::string_view engine;  // that made the lighter shape: its id; empty where it stayed or became a stand-in
  std::string refusal;      // why the one that was asked for did not

  bool dropped() const { return lighter.triangles.empty() && !shape.triangles.empty(); }
};

double largestStretch(const Eigen::Affine3d& transform);
inline double meanStretch(const Eigen::Affine3d& transform) {
  return std::cbrt(std::abs(transform.linear().determinant()));
}

ProductAllowance allowanceOf(const OptimizeOptions& options, std::uint32_t product);
std::uint64_t budgetOf(const OptimizeOptions& options, std::uint32_t budget_group);

// Errors: usage where an option is out of range, unusable where the environment is.
Result<void> checkOptions(const Environment& environment, const OptimizeOptions& options);
Environment withoutDropped(const Environment& environment, const OptimizeOptions& options);

// One for each mesh of the environment. Meshes that are the same but for a motion are found first (identical.h): the
// environment's instances are led to the first of them. `residual_m` gets, for each instance, how far that moved any
// vertex.
std::vector<MeshJob> prepareMeshJobs(Environment& environment, const OptimizeOptions& options,
                                     std::vector<double>& residual_m);

}  // namespace standpoint
