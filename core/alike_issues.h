// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "core/report.h"

namespace standpoint {

// For people, who read the same of 597 bolts but once: issues of one severity whose messages differ in names and
// numbers only, where they are more than kMostAlike, as the first of them and the others; any other issue stands alone.
constexpr std::size_t kMostAlike = 20;
struct AlikeIssues {
  std::size_t first = 0;            // index into Report::issues
  std::vector<std::size_t> others;  // likewise, of those that it stands for
  std::size_t count() const { return others.size() + 1; }
};
std::vector<AlikeIssues> alikeIssues(const Report& report);

}  // namespace standpoint
