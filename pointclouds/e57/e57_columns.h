// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "pointclouds/e57/e57_field_roles.h"

namespace standpoint::e57 {

using Columns = std::vector<std::vector<double>>;

// Turns the file's columns into those of a block, column by column, and counts what it leaves out or mends.
class ColumnTaker {
 public:
  ColumnTaker(const ScanPlan& plan, const Roles& roles) : plan_(plan), roles_(roles) {}
  // Uses `from` up.
  Result<void> take(Columns& from, std::size_t records, FoundPoints& to);
  void list(const std::string& source, Report& report) const;

 private:
  struct Tally {
    std::uint64_t invalid = 0, no_intensity = 0, no_colour = 0, no_time = 0, outside_grid = 0, no_channel = 0,
                  no_return = 0, no_truth = 0;
  };
  void dropInvalid(Columns& from, std::size_t& records);
  void takePlaces(Columns& from, FoundPoints& to) const;
  void takeColours(Columns& from, PointBlock& to);
  Result<void> takeLabels(const Columns& from, PointBlock& to) const;
  void takeReturns(const Columns& from, PointBlock& to);
  void takeTruth(Columns& from, FoundPoints& to);
  // Values that the file marks as invalid become 0; how many there are.
  std::uint64_t blank(Columns& from, const Place& marks, std::span<const Place> places) const;
  const ScanPlan& plan_;
  const Roles& roles_;
  Tally tally_;
  std::vector<std::uint8_t> dropped_;
};

}  // namespace standpoint::e57
