// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/motion/closures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace standpoint {

namespace {

constexpr double kPassed_m = 0.2;  // of way between the knots that are looked at: who stands is there once

using Cell = std::array<long, 3>;

Cell cellOf(const Eigen::Vector3d& place, double size) {
  return {std::lround(std::floor(place.x() / size)), std::lround(std::floor(place.y() / size)),
          std::lround(std::floor(place.z() / size))};
}

struct Candidate {
  LoopClosure closure;
  double at_m = 0;  // of the way
};

// Of each place that comes within the radius of an earlier one, the nearest of these.
std::vector<Candidate> candidatesOf(std::span<const ErrorKnot> knots, const ClosureRules& rules) {
  std::vector<Candidate> candidates;
  std::map<Cell, std::vector<std::size_t>> passed;  // knots, in their order
  double looked_m = -kPassed_m;
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const ErrorKnot& here = knots[i];
    if (here.way_m - looked_m < kPassed_m) continue;
    looked_m = here.way_m;
    const Cell cell = cellOf(here.pose.translation, rules.radius_m);
    Candidate best{{here.time_s, 0, rules.radius_m, 0}, here.way_m};
    for (int k = 0; k < 27; ++k) {
      const auto found = passed.find({cell[0] + k % 3 - 1, cell[1] + k / 3 % 3 - 1, cell[2] + k / 9 - 1});
      if (found == passed.end()) continue;
      for (const std::size_t j : found->second) {
        const double way = here.way_m - knots[j].way_m;
        if (way < rules.least_way_m) break;
        const double distance = (here.pose.translation - knots[j].pose.translation).norm();
        if (distance < best.closure.distance_m) best.closure = {here.time_s, knots[j].time_s, distance, way};
      }
    }
    if (best.closure.way_m > 0) candidates.push_back(best);
    passed[cell].push_back(i);
  }
  return candidates;
}

}  // namespace

std::vector<LoopClosure> findClosures(std::span<const ErrorKnot> knots, const ClosureRules& rules,
                                      const std::function<bool(const LoopClosure&)>& share) {
  auto candidates = candidatesOf(knots, rules);
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.closure.distance_m < b.closure.distance_m; });
  std::vector<LoopClosure> closures;
  std::set<double> taken;  // ways
  for (const auto& [closure, at_m] : candidates) {
    const auto after = taken.lower_bound(at_m - rules.apart_m);
    if (after != taken.end() && *after < at_m + rules.apart_m) continue;
    taken.insert(at_m);
    if (!share || share(closure)) closures.push_back(closure);
  }
  std::sort(closures.begin(), closures.end(),
            [](const LoopClosure& a, const LoopClosure& b) { return a.time_s < b.time_s; });
  return closures;
}

}  // namespace standpoint
