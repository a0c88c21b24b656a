// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "scanners/engine/column_hits.h"
#include "scanners/engine/return_lanes.h"

namespace standpoint {

// Puts the points of columns into a block, in place of what it holds. Its columns of values keep their length until the
// end: a block that is used again has entries for most of its points already.
class PointWriter {
 public:
  explicit PointWriter(const ScanPlan& plan) : plan_(plan) {}
  void begin(PointBlock& block);
  void beginColumn(const ColumnHits& column);
  void endColumn();
  // One point in each lane, those of a pulse in order of its returns.
  struct Place {
    const ReturnLanes* lanes;
    int lane;
    std::uint8_t return_number = 1, return_count = 1;
  };
  void write(const std::vector<Place>& places);
  // Returns that are the only ones of their pulses.
  void write(const ReturnLanes& lanes, std::uint32_t detected);
  void end();

 private:
  template <class Change>
  void forEachColumn(Change change);
  void resize(std::size_t size);
  void makeRoom(std::size_t points);
  void writeAll(const ReturnLanes& lanes);
  void writeTruth(const ReturnLanes& lanes, int lane, std::size_t i, PointTruth& truth) const;

  const ScanPlan& plan_;
  const ColumnHits* hits_ = nullptr;  // of the column that is written
  PointBlock* block_ = nullptr;
  std::size_t size_ = 0, room_ = 0;  // points written, and that the block has entries for
  std::size_t column_begin_ = 0;     // points before this column
  std::vector<std::uint32_t> order_, places_in_order_;
  std::vector<Place> places_;
};

}  // namespace standpoint
