// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/survey.h"

namespace standpoint {

constexpr std::uint32_t kMostInRow = 100;

// How many, from one end to the other; else how far apart, from the first end on.
struct RowSteps {
  std::optional<std::uint32_t> count;
  std::optional<double> spacing_m;
};

// The places of a row on a floor; no more than kMostInRow.
std::vector<Eigen::Vector3d> rowPlaces(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const RowSteps& steps);
// After "S3" the first of "S4", "S5", … that no station has; after "Hall" of "Hall2", "Hall3", ….
std::string nextStationName(const Job& job, const std::string& name);

}  // namespace standpoint
