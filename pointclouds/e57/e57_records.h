// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/result.h"
#include "pointclouds/e57/e57_coordinates.h"

namespace standpoint::e57 {

// The records of one scan on their way into the file: its points, then where each scanner column's points lie.
class ScanRecords {
 public:
  ScanRecords(const ScanHeader& header, Coordinates kind);
  Result<void> begin(PagedWriter& out) { return packets_.begin(out); }
  Result<void> write(PagedWriter& out, const PointBlock& block);
  // What the XML says of them.
  Result<void> finish(PagedWriter& out, WrittenScan& scan);
  std::uint64_t clamped() const { return places_.clamped(); }  // intensities outside the sensor's range

 private:
  // For groupingByLine; one entry per column, as long as they ascend.
  struct Line {
    std::uint64_t first;
    std::uint32_t column;
    std::uint64_t points;
  };
  void addLines(const std::vector<std::uint32_t>& columns);
  Result<void> put(PagedWriter& out, const PointBlock& block);
  void putExtras(const PointBlock& block, std::size_t stream, std::size_t from, std::size_t n);
  Result<WrittenVector> writeLines(PagedWriter& out) const;

  ScanHeader header_;
  std::vector<Field> fields_;
  PacketWriter packets_;
  StoredPlaces places_;
  std::uint32_t largest_row_ = 0, largest_column_ = 0;
  std::vector<Line> lines_;
  bool ascending_ = true;
  std::vector<std::uint8_t> return_index_;
};

}  // namespace standpoint::e57
