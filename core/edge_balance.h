// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace standpoint {

// A side of a face between two vertices of a welded mesh, as the face passes it.
struct PassedEdge {
  PassedEdge(std::uint32_t from, std::uint32_t to)
      : key(std::uint64_t{std::min(from, to)} << 32U | std::max(from, to)),
        way(from < to   ? 1
            : from > to ? -1
                        : 0) {}
  std::uint64_t key;
  std::int32_t way;  // 0 of an edge whose ends are one vertex
};

// Whether every edge is passed as often one way as the other: then the faces close a body. Sorts `edges`.
inline bool balanced(std::vector<PassedEdge>& edges) {
  std::sort(edges.begin(), edges.end(), [](const PassedEdge& a, const PassedEdge& b) { return a.key < b.key; });
  for (std::size_t i = 0; i < edges.size();) {
    std::int32_t sum = 0;
    const auto key = edges[i].key;
    for (; i < edges.size() && edges[i].key == key; ++i) sum += edges[i].way;
    if (sum != 0) return false;
  }
  return true;
}

}  // namespace standpoint
