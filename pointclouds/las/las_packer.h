// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/result.h"
#include "pointclouds/files/scan_text.h"
#include "pointclouds/las/las_layout.h"

namespace standpoint::las {

// Turns the points of one scan after the other into records, and counts what the file's header says of them.
class RecordPacker {
 public:
  // The first scan decides where the integers begin.
  void start(const Layout& layout, const std::array<double, 3>& offset);
  void begin(const ScanHeader& header, std::uint16_t station, const JointTable::Offset& labels);
  Result<void> put(const PointBlock& block, std::size_t i, std::uint8_t* record);  // which is all 0
  void count(WrittenFile& file) const;

  std::uint64_t clamped = 0, beyond_returns = 0, beyond_truth = 0;  // of the scan

 private:
  std::int32_t step(double value, std::size_t axis) const;
  Result<void> putPlace(const PointBlock& block, std::size_t i, std::uint8_t* record);
  void putReturn(const PointBlock& block, std::size_t i, std::uint8_t* record);
  void putExtras(const PointBlock& block, std::size_t i, std::uint8_t* record);
  void putTruth(const PointBlock& block, std::size_t i, std::uint8_t* record);

  Layout layout_;
  std::array<double, 3> offset_{};
  std::array<std::int32_t, 3> low_{}, high_{};
  std::uint64_t points_ = 0;
  std::array<std::uint64_t, 15> by_return_{};
  ScanHeader header_;
  std::uint16_t station_ = 0;
  JointTable::Offset labels_;
  std::vector<std::uint8_t> class_of_product_;
};

}  // namespace standpoint::las
