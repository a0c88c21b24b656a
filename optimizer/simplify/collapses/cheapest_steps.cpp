// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/simplify/collapses/cheapest_steps.h"

#include <algorithm>
#include <cstdint>

#include <tbb/parallel_for.h>

namespace standpoint {

namespace {

constexpr std::size_t kStretches = 64;  // of all steps by cost, that are put in order side by side

}  // namespace

CheapestSteps::CheapestSteps(const std::vector<std::vector<Step>>& logs, std::size_t triangles, std::size_t enough)
    : logs_(logs), taken_(logs.size(), 0) {
  findStretches();
  const auto last = stretches_.size() - 1;  // where all logs end
  tbb::parallel_for(std::size_t{0}, last, [&](std::size_t s) {
    for (std::size_t i = 0; i < logs.size(); ++i)
      for (auto k = stretches_[s].from[i]; k < stretches_[s + 1].from[i]; ++k)
        stretches_[s].triangles += logs[i][k].collapse.triangles;
  });
  std::size_t until = 0;
  auto left = triangles;
  for (; until < last && left > enough; ++until) left -= stretches_[until].triangles;
  steps_.resize(stretches_[until].first);
  tbb::parallel_for(std::size_t{0}, until, [&](std::size_t s) { merge(stretches_[s], stretches_[s + 1].from); });
  taken_ = stretches_[until].from;
  // What is too much of the last stretch.
  while (!steps_.empty() && left + steps_.back().collapse.triangles <= enough) {
    left += steps_.back().collapse.triangles;
    steps_.pop_back();
  }
  if (until == 0) return;
  for (std::size_t i = 0; i < logs.size(); ++i) taken_[i] = stretches_[until - 1].from[i];
  for (auto k = stretches_[until - 1].first; k < steps_.size(); ++k) ++taken_[steps_[k].cell];
}

void CheapestSteps::findStretches() {
  std::vector<double> costs;
  for (const auto& log : logs_)
    for (std::size_t k = 0; k < log.size(); k += kStretches) costs.push_back(log[k].cost);
  std::sort(costs.begin(), costs.end());
  for (std::size_t s = 0; s <= kStretches; ++s) {
    auto& stretch = stretches_.emplace_back();
    for (const auto& log : logs_) {
      std::size_t at = s == 0 ? 0 : log.size();
      if (s > 0 && s < kStretches && !costs.empty())
        at = static_cast<std::size_t>(std::lower_bound(log.begin(), log.end(), costs[s * costs.size() / kStretches],
                                                       [](const Step& step, double cost) { return step.cost < cost; }) -
                                      log.begin());
      stretch.from.push_back(at);
      stretch.first += at;
    }
  }
}

void CheapestSteps::merge(const Stretch& stretch, const std::vector<std::size_t>& to) {
  struct Next {
    double cost;
    std::uint32_t log;
    bool operator<(const Next& o) const { return cost != o.cost ? cost > o.cost : log > o.log; }
  };
  auto at = stretch.from;
  std::vector<Next> heap;
  for (std::uint32_t i = 0; i < at.size(); ++i)
    if (at[i] < to[i]) heap.push_back({logs_[i][at[i]].cost, i});
  std::make_heap(heap.begin(), heap.end());
  for (auto k = stretch.first; !heap.empty(); ++k) {
    std::pop_heap(heap.begin(), heap.end());
    const auto i = heap.back().log;
    steps_[k] = logs_[i][at[i]++];
    steps_[k].cell = i;
    if (at[i] < to[i]) {
      heap.back() = {logs_[i][at[i]].cost, i};
      std::push_heap(heap.begin(), heap.end());
    } else {
      heap.pop_back();
    }
  }
}

}  // namespace standpoint
