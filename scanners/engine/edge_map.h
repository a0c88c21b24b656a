// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "scanners/engine/column_hits.h"
#include "scanners/engine/facet_cache.h"

namespace standpoint {

// The edges in one beam.
struct BeamEdges {
  static constexpr int kMost = 6;
  static constexpr std::uint64_t kRound = ~std::uint64_t{0};  // in place of an edge: the outline of a ball
  std::uint64_t edge[kMost] = {};                             // of the scene, in rising order
  int count = 0;
  bool several = false;  // more than those, or one that is not straight
  // Of the nearest edge that the axis' surface hides: what is beside that surface may show it.
  float hidden_m = 0;
};

// Those of one column.
class ColumnEdges {
 public:
  void begin(std::uint32_t rows);
  // Rows whose beams hold edges, of sixteen from `first_row` on, as bits.
  std::uint32_t rows(std::uint32_t first_row) const { return rows_[first_row / kPacket]; }
  // Of a row that holds some.
  const BeamEdges& of(std::uint32_t row) const { return edges_[row]; }
  void add(std::uint32_t row, std::uint64_t edge);
  void addHidden(std::uint32_t row, float range_m);

 private:
  BeamEdges& at(std::uint32_t row);
  std::vector<std::uint32_t> rows_, touched_;
  std::vector<BeamEdges> edges_;
};

// Where in the grid of a scan outlines of the scene run: edges at which a surface ends, turns away from the scanner or
// bends so far that a beam across them meets two ranges. A beam is wide where one is in it, however thin the thing and
// however far apart the pulses. Of a scanner that does not move.
//
// An edge is cut into pieces that are straight in the grid (to a fifth of a row), 40 bytes each, sorted by the columns
// that they reach: memory follows the outlines of the model, not the grid.
class EdgeMap {
 public:
  enum class Edges { outlines, corners };  // corners: concave, and as wide as the receiver's field of view
  explicit EdgeMap(const ScanPlan& plan, Edges edges = Edges::outlines);
  // The rows of a column whose beams may hold an edge that the axis' surface does not hide; `hits` has been traced
  // throughout.
  void mark(const ColumnHits& hits, FacetCache& facets, ColumnEdges& found) const;

  // Straight in the grid, from one place to another.
  struct Piece {
    float column[2] = {}, row[2] = {};
    float nearness[2] = {};  // 1 / range, which is even along what is straight
    float radius_rows = 0;   // of the beam
    float rows_per_column = 0;
    std::uint64_t edge = 0;  // of the scene
  };

 private:
  void sort(std::vector<std::vector<Piece>> found);
  void markPiece(const Piece& piece, const ColumnHits& hits, FacetCache& facets, ColumnEdges& found) const;
  bool visible(float range_m, float column, float row, std::uint32_t at_row, const ColumnHits& hits,
               FacetCache& facets) const;

  const ScanPlan& plan_;
  std::vector<Piece> pieces_;
  // Level by level, of cells of 2^level columns each: the pieces that begin there and are no wider than a cell.
  std::vector<std::vector<std::size_t>> first_;
};

}  // namespace standpoint
