// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/report.h"
#include "pointclouds/files/local_points.h"

namespace standpoint {

// What a named number of a point can be, in formats that name them: PLY, PCD, text with a header.
enum class PointField : std::uint8_t {
  x,
  y,
  z,
  intensity,
  red,
  green,
  blue,
  packed_colour,
  label,
  product,
  row,
  column,
  time,
  channel,
  return_number,
  return_count,
  true_x,
  true_y,
  true_z,
  true_range,
  incidence,
  received_power,
  flags
};
inline constexpr std::size_t kPointFields = 23;

struct FieldPlaces {
  std::array<std::optional<std::size_t>, kPointFields> at{};  // into the numbers of a point
  std::array<double, 3> colour_scale{1, 1, 1};                // to 0..255
  const std::optional<std::size_t>& operator[](PointField f) const { return at[static_cast<std::size_t>(f)]; }
  std::optional<std::size_t>& operator[](PointField f) { return at[static_cast<std::size_t>(f)]; }
  bool all(PointField first, PointField last) const;
};

// Turns the numbers of points into columns.
class FieldTaker {
 public:
  // Sets what `scan` has by the fields that are there: labels need its tables, a grid its rows and columns. `placed`:
  // the numbers are in the file's frame, and the scan's pose leads back.
  FieldTaker(const FieldPlaces& places, ScanHeader& scan, bool placed);
  // An error when an index lies outside its table or grid; without a place.
  Result<void> take(const std::vector<double>& numbers, FoundPoints& to);
  void list(const std::string& source, Report& report) const;  // what was mended
  bool isRead(std::size_t number) const;                       // whether anything is taken from it

 private:
  void takeColour(const std::vector<double>& numbers, PointBlock& block);
  void takeReturn(const std::vector<double>& numbers, PointBlock& block);
  void takeTruth(const std::vector<double>& numbers, FoundPoints& to);
  Result<void> takeIndices(const std::vector<double>& numbers, PointBlock& block) const;
  Eigen::Vector3d place(const std::vector<double>& numbers, PointField first) const;
  double number(const std::vector<double>& numbers, PointField field) const { return numbers[*places_[field]]; }

  FieldPlaces places_;
  bool placed_, colour_, labels_, grid_, time_, channel_, returns_, truth_;
  double rows_ = 0, columns_ = 0, products_ = 0, materials_ = 0;
  Pose pose_;
  Eigen::Quaterniond back_;
  std::uint64_t senseless_returns_ = 0, senseless_values_ = 0;
};

}  // namespace standpoint
