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

// Of the knots from which somebody came back to `here`: the nearest one of the first time that they were there.
LoopClosure firstPassed(std::span<const ErrorKnot> knots, const ErrorKnot& here, std::span<const std::size_t> from,
                        const ClosureRules& rules) {
  double first_m = here.way_m;
  for (const std::size_t j : from) first_m = std::min(first_m, knots[j].way_m);
  LoopClosure nearest{here.time_s, 0, rules.radius_m, 0};
  for (const std::size_t j : from) {
    const double distance = (here.pose.translation - knots[j].pose.translation).norm();
    if (knots[j].way_m < first_m + rules.apart_m && distance < nearest.distance_m)
      nearest = {here.time_s, knots[j].time_s, distance, here.way_m - knots[j].way_m};
  }
  return nearest;
}

// Of each place that comes within the radius of earlier ones.
std::vector<Candidate> candidatesOf(std::span<const ErrorKnot> knots, const ClosureRules& rules) {
  std::vector<Candidate> candidates;
  std::map<Cell, std::vector<std::size_t>> passed;  // knots, in their order
  double looked_m = -kPassed_m;
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const ErrorKnot& here = knots[i];
    if (here.way_m - looked_m < kPassed_m) continue;
    looked_m = here.way_m;
    const Cell cell = cellOf(here.pose.translation, rules.radius_m);
    std::vector<std::size_t> from;
    for (int k = 0; k < 27; ++k) {
      const auto found = passed.find({cell[0] + k % 3 - 1, cell[1] + k / 3 % 3 - 1, cell[2] + k / 9 - 1});
      if (found == passed.end()) continue;
      for (const std::size_t j : found->second) {
        if (here.way_m - knots[j].way_m < rules.least_way_m) break;
        if ((here.pose.translation - knots[j].pose.translation).norm() < rules.radius_m) from.push_back(j);
      }
    }
    if (!from.empty()) candidates.push_back({firstPassed(knots, here, from, rules), here.way_m});
    passed[cell].push_back(i);
  }
  return candidates;
}

}  // namespace

std::vector<LoopClosure> findClosures(std::span<const ErrorKnot> knots, const ClosureRules& rules,
                                      const std::function<bool(const LoopClosure&)>& share) {
  auto candidates = candidatesOf(knots, rules);
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.closure.worth_m() > b.closure.worth_m(); });
  std::vector<LoopClosure> closures;
  std::set<double> taken;  // ways
  for (const auto& [closure, at_m] : candidates) {
    const auto after = taken.lower_bound(at_m - rules.apart_m);
    if (after != taken.end() && *after < at_m + rules.apart_m) continue;
    if (share && !share(closure)) continue;
    taken.insert(at_m);
    closures.push_back(closure);
  }
  std::sort(closures.begin(), closures.end(),
            [](const LoopClosure& a, const LoopClosure& b) { return a.time_s < b.time_s; });
  return closures;
}

}  // namespace standpoint
