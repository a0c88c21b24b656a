// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "core/report.h"

namespace standpoint {

// For people, who read the same of 597 bolts but once: issues of one severity whose messages differ in names and
// numbers only, where they are more than kMostAlike, as the first of them with their count. The others have 1.
constexpr std::size_t kMostAlike = 20;
struct AlikeIssues {
  Issue first;
  std::size_t count = 1;
};
std::vector<AlikeIssues> alikeIssues(const Report& report);

}  // namespace standpoint
