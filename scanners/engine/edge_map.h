// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "scanners/engine/column_hits.h"
#include "scanners/engine/facet_cache.h"

namespace standpoint {

// Where in the grid of a scan outlines of the scene run: edges at which a surface ends, turns away from the scanner or
// bends so far that a beam across them meets two ranges. A beam is wide where one is in it, however thin the thing and
// however far apart the pulses. Of a scanner that does not move.
//
// An edge is cut into pieces that are straight in the grid (to a fifth of a row), 32 bytes each, sorted by the columns
// that they reach: memory follows the outlines of the model, not the grid.
class EdgeMap {
 public:
  explicit EdgeMap(const ScanPlan& plan);
  // The rows of a column whose beams may hold an edge that the axis' surface does not hide, as bits of sixteen rows
  // each; `hits` has been traced throughout.
  void mark(const ColumnHits& hits, FacetCache& facets, std::vector<std::uint32_t>& rows) const;

  // Straight in the grid, from one place to another.
  struct Piece {
    float column[2] = {}, row[2] = {};
    float nearness[2] = {};  // 1 / range, which is even along what is straight
    float radius_rows = 0;   // of the beam
    float rows_per_column = 0;
  };

 private:
  void sort(std::vector<std::vector<Piece>> found);
  void markPiece(const Piece& piece, const ColumnHits& hits, FacetCache& facets,
                 std::vector<std::uint32_t>& rows) const;
  bool visible(float range_m, float column, float row, std::uint32_t at_row, const ColumnHits& hits,
               FacetCache& facets) const;

  const ScanPlan& plan_;
  std::vector<Piece> pieces_;
  // Level by level, of cells of 2^level columns each: the pieces that begin there and are no wider than a cell.
  std::vector<std::vector<std::size_t>> first_;
};

}  // namespace standpoint
