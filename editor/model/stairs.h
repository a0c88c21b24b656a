// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/environment.h"

namespace standpoint {

struct Model;
struct ViewState;

// A stair in sight of whoever walks, who can take it.
struct StairAhead {
  std::uint32_t product = 0;
  Bounds box;          // local frame
  std::string storey;  // that it leads to
  double elevation_m = 0;
  bool up = true;
  Eigen::Vector3d anchor = Eigen::Vector3d::Zero();  // of its name
  double range_m = 0;                                // from the eyes
};

// Those that lead away from the storey where somebody walks, the nearest first; none while nobody does.
std::vector<StairAhead> stairsAhead(const Model& model, const ViewState& state);
std::string whyNoStair(const Model& model);  // none is ahead
// Walks to the storey that the nearest one, or that of a product, leads to, or says why not. The view before comes back
// with Alt+Left.
void takeStair(Model& model);
void takeStair(Model& model, std::uint32_t product);

}  // namespace standpoint
