// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/simplify/budget.h"

#include <algorithm>
#include <tuple>

namespace standpoint {

namespace {

struct Bid {
  double cost;
  std::uint32_t bidder;
  bool operator<(const Bid& o) const { return std::tie(o.cost, o.bidder) < std::tie(cost, bidder); }
};

Bid nextBid(const std::vector<Bidder>& bidders, std::uint32_t i, std::size_t level) {
  const double scale = bidders[i].scale;
  return {(*bidders[i].levels)[level].cost * scale * scale * scale * bidders[i].weight, i};
}

// Triangles that all copies save by going on to a level.
std::uint64_t saving(const Bidder& bidder, std::size_t level) {
  const auto before = level == 0 ? bidder.triangles : (*bidder.levels)[level - 1].triangles;
  return (before - (*bidder.levels)[level].triangles) * bidder.copies;
}

}  // namespace

std::vector<std::size_t> shareBudget(const std::vector<Bidder>& bidders, std::uint64_t budget) {
  std::vector<std::size_t> taken(bidders.size(), 0);
  std::vector<Bid> heap;
  std::uint64_t total = 0;
  for (std::uint32_t i = 0; i < bidders.size(); ++i) {
    total += bidders[i].triangles * bidders[i].copies;
    if (bidders[i].copies > 0 && bidders[i].limit > 0) heap.push_back(nextBid(bidders, i, 0));
  }
  std::make_heap(heap.begin(), heap.end());
  std::vector<std::uint32_t> order;
  while (total > budget && !heap.empty()) {
    std::pop_heap(heap.begin(), heap.end());
    const auto i = heap.back().bidder;
    heap.pop_back();
    total -= saving(bidders[i], taken[i]);
    order.push_back(i);
    if (++taken[i] < bidders[i].limit) {
      heap.push_back(nextBid(bidders, i, taken[i]));
      std::push_heap(heap.begin(), heap.end());
    }
  }
  std::vector<bool> settled(bidders.size(), false);
  for (std::size_t k = order.size(); k-- > 0 && total < budget;) {
    const auto i = order[k];
    if (settled[i]) continue;
    const auto gain = saving(bidders[i], taken[i] - 1);
    settled[i] = total + gain > budget;
    if (settled[i]) continue;
    total += gain;
    --taken[i];
  }
  return taken;
}

}  // namespace standpoint
