// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/survey/station_row.h"

#include <algorithm>
#include <cmath>

namespace standpoint {

std::vector<Eigen::Vector3d> rowPlaces(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const RowSteps& steps) {
  const double length = (to - from).head<2>().norm();
  std::vector<Eigen::Vector3d> places;
  if (steps.spacing_m && !steps.count) {
    const auto along = static_cast<std::uint32_t>(std::min(kMostInRow - 1.0, length / *steps.spacing_m + 1e-9));
    for (std::uint32_t k = 0; k <= along; ++k)
      places.push_back(length > 0 ? Eigen::Vector3d(from + (to - from) * (k * *steps.spacing_m / length)) : from);
    return places;
  }
  const std::uint32_t count = std::clamp(steps.count.value_or(2), 2U, kMostInRow);
  for (std::uint32_t k = 0; k < count; ++k) places.push_back(from + (to - from) * (k / (count - 1.0)));
  return places;
}

std::string nextStationName(const Job& job, const std::string& name) {
  const auto digits = name.find_last_not_of("0123456789") + 1;
  const std::string stem = name.substr(0, digits), number = name.substr(digits, 6);
  for (unsigned long k = number.empty() ? 2 : std::stoul(number) + 1;; ++k) {
    auto next = stem + std::to_string(k);
    if (std::none_of(job.stations.begin(), job.stations.end(), [&](const Station& s) { return s.name == next; }))
      return next;
  }
}

}  // namespace standpoint
