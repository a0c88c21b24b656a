// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace standpoint {

// Pairs of vertices, cheapest first; among equals the one with the lower first vertex. Four children to a node of 16
// bytes, so that those of one are in a cache line and the way down is half as long: most of a simplification's time was
// spent in a heap of two.
class CollapseQueue {
 public:
  struct Entry {
    Entry() = default;
    Entry(double cost, std::uint32_t first, std::uint32_t second, std::uint32_t sum_of_ages)
        : rank(std::uint64_t{keyOf(cost)} << 32U | first), b(second), age(sum_of_ages) {}
    std::uint32_t a() const { return static_cast<std::uint32_t>(rank); }
    // Whether the cost is more than it was ranked by, as far as 20 binary digits tell.
    bool isBelow(double cost) const { return keyOf(cost) > rank >> 32U; }

    std::uint64_t rank = 0;
    std::uint32_t b = 0;
    std::uint32_t age = 0;  // of both: neither ever falls, so the sum tells whether one changed
  };

  bool empty() const { return heap_.empty(); }
  void reserve(std::size_t count) { heap_.reserve(count); }
  // In any order; arrange() before anything is taken.
  void append(const Entry& entry) { heap_.push_back(entry); }
  void arrange() {
    for (std::size_t i = heap_.size() / 4 + 1; i-- > 0;)
      if (i < heap_.size()) sink(i, heap_[i]);
  }
  void push(const Entry& entry) {
    heap_.push_back(entry);
    auto i = heap_.size() - 1;
    for (; i > 0 && entry.rank < heap_[(i - 1) / 4].rank; i = (i - 1) / 4) heap_[i] = heap_[(i - 1) / 4];
    heap_[i] = entry;
  }
  Entry pop() {
    const Entry top = heap_.front(), last = heap_.back();
    heap_.pop_back();
    if (!heap_.empty()) sink(0, last);
    return top;
  }

 private:
  // Costs are never negative: the upper half of their bits, as a number, is in their order.
  static std::uint32_t keyOf(double cost) {
    return static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(cost) >> 32U);
  }

  std::size_t leastFrom(std::size_t child) const {
    if (child + 4 > heap_.size()) {
      auto least = child;
      for (auto k = child + 1; k < heap_.size(); ++k) least = heap_[k].rank < heap_[least].rank ? k : least;
      return least;
    }
    const Entry* entry =
        &heap_[child];  // sums, not branches: which child is the least is chance, and wrong guesses cost most
    const std::size_t left = entry[1].rank < entry[0].rank ? 1 : 0, right = entry[3].rank < entry[2].rank ? 3 : 2;
    return child + left + (right - left) * static_cast<std::size_t>(entry[right].rank < entry[left].rank);
  }

  void sink(std::size_t i, const Entry entry) {
    for (auto child = 4 * i + 1; child < heap_.size(); child = 4 * i + 1) {
      const auto least = leastFrom(child);
      if (entry.rank <= heap_[least].rank) break;
      heap_[i] = heap_[least];
      i = least;
    }
    heap_[i] = entry;
  }

  std::vector<Entry> heap_;
};

}  // namespace standpoint
