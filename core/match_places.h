// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/result.h"
#include "core/survey.h"

namespace standpoint {

struct PlaceMatch {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;  // of `from`, of `to`; by the former
  Pose to_from;
  double rms_m = 0;
};

// Which place of one list is which of another, by their distances alone: every three of `from` that find three of `to`
// with the same distances propose a motion, and the one that brings most places together within the tolerance wins.
// Errors: fewer than three come together; another assignment does as well (the arrangement is symmetric).
constexpr std::size_t kMostPlacesToMatch = 30;  // of each list
Result<PlaceMatch> matchPlaces(std::span<const Eigen::Vector3d> from, std::span<const Eigen::Vector3d> to,
                               double tolerance_m);

}  // namespace standpoint
