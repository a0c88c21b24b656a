// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/simplify/collapses/cheapest_steps.h"

#include <algorithm>
#include <random>
#include <tuple>

#include <gtest/gtest.h>

namespace standpoint {
namespace {

// What sorting all of them gives: by cost, equal ones by log.
TEST(CheapestSteps, AreThoseOfOneQueueOverAllLogs) {
  std::mt19937 random(4);
  std::vector<std::vector<Step>> logs(23);
  std::vector<std::tuple<double, std::uint32_t, std::uint32_t>> all;  // cost, log, how many of the log before it
  std::size_t triangles = 0;
  for (std::uint32_t i = 0; i < logs.size(); ++i) {
    double cost = 0;
    for (std::uint32_t k = 0; k < random() % 900; ++k) {
      cost += random() % 4 == 0 ? 0.01 * static_cast<double>(random() % 5) : 0;  // many are equal
      Step step;
      step.collapse.triangles = 1 + random() % 2;
      step.collapse.kept = k;
      step.cost = cost;
      triangles += step.collapse.triangles;
      logs[i].push_back(step);
      all.emplace_back(cost, i, k);
    }
  }
  std::sort(all.begin(), all.end());
  for (const auto enough : {std::size_t{0}, triangles / 3, triangles - 1, triangles}) {
    const CheapestSteps cheapest(logs, triangles, enough);
    std::vector<std::size_t> taken(logs.size(), 0);
    std::size_t left = triangles, count = 0;
    for (; left > enough; ++count) {
      const auto [cost, log, k] = all[count];
      left -= logs[log][k].collapse.triangles;
      ++taken[log];
      ASSERT_LT(count, cheapest.steps().size());
      EXPECT_EQ(cheapest.steps()[count].cost, cost);
      EXPECT_EQ(cheapest.steps()[count].collapse.kept, k);
    }
    EXPECT_EQ(cheapest.steps().size(), count);
    for (std::size_t i = 0; i < logs.size(); ++i) EXPECT_EQ(cheapest.taken(i), taken[i]);
  }
}

}  // namespace
}  // namespace standpoint
