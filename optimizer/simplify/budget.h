// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "optimizer/simplify/levels.h"

namespace standpoint {

// A shape as the shared budget sees it.
struct Bidder {
  const std::vector<Level>* levels = nullptr;
  std::size_t limit = 0;        // levels that may be taken
  std::uint64_t triangles = 0;  // of one copy as it is
  std::uint64_t copies = 0;     // placed instances
  double scale = 1;             // of the largest of them
  double weight = 1;            // on what it costs
};

// How many levels each shape takes so that all copies together have at most `budget` triangles: always the one that
// costs least per triangle saved, over all shapes (the instance count cancels out: k copies cost and save k times as
// much). Then, last first, levels are given back while the budget allows it.
std::vector<std::size_t> shareBudget(const std::vector<Bidder>& bidders, std::uint64_t budget);

}  // namespace standpoint
