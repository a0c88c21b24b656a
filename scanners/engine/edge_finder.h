// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <vector>

#include "scanners/engine/edge_map.h"
#include "scanners/engine/edge_tree.h"

namespace standpoint {

// What EdgeMap is for a scanner that stands before what stands, for all that moves: the outlines of what stands, for
// beams that start anywhere, and those of bodies, by trees in their rest frames. A body's tree is made when a beam
// first comes near it. For any number of threads.
class EdgeFinder {
 public:
  explicit EdgeFinder(const ScanPlan& plan);
  // The rows of a column whose beams may hold an edge that the axis' surface does not hide; `hits` has been traced
  // throughout. What stands is left out where the scanner does, too.
  void mark(const ColumnHits& hits, TimedScene& scene, FacetCache& facets, ColumnEdges& found) const;

 private:
  struct BodyTree {
    std::once_flag made;
    EdgeTree tree;
    std::vector<std::uint32_t> placements;
  };
  struct Search;

  EdgeTree treeOf(const std::vector<std::uint32_t>& placements) const;
  const EdgeTree& bodyTree(std::uint32_t body) const;
  void markBodies(Search& search, std::uint32_t first_row, std::uint32_t lanes) const;

  const ScanPlan& plan_;
  EdgeTree still_;
  mutable std::deque<BodyTree> bodies_;
};

}  // namespace standpoint
