// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/files/block_check.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <utility>

namespace standpoint {
namespace {

// Every point passes here, so the columns are gone through in lanes that the compiler makes vectors of.
constexpr std::size_t kLanes = 16;

bool isFinite(float v) { return (std::bit_cast<std::uint32_t>(v) & 0x7F800000u) != 0x7F800000u; }

struct Span {
  float low = 0, high = 0;
  bool finite = true;
};

Span spanOf(const std::vector<float>& values) {
  float low[kLanes], high[kLanes];
  std::uint32_t wrong[kLanes] = {};
  std::fill_n(low, kLanes, values.front());
  std::fill_n(high, kLanes, values.front());
  const auto take = [&](std::size_t lane, float v) {
    low[lane] = v < low[lane] ? v : low[lane];
    high[lane] = v > high[lane] ? v : high[lane];
    wrong[lane] |= isFinite(v) ? 0u : 1u;
  };
  const std::size_t whole = values.size() / kLanes * kLanes;
  for (std::size_t i = 0; i < whole; i += kLanes)
    for (std::size_t k = 0; k < kLanes; ++k) take(k, values[i + k]);
  for (std::size_t i = whole; i < values.size(); ++i) take(i - whole, values[i]);
  return {*std::min_element(low, low + kLanes), *std::max_element(high, high + kLanes),
          std::all_of(wrong, wrong + kLanes, [](std::uint32_t w) { return w == 0; })};
}

bool allFinite(const std::vector<float>& values) {
  std::uint32_t wrong = 0;
  for (const float v : values) wrong |= isFinite(v) ? 0u : 1u;
  return wrong == 0;
}

std::uint32_t largest(const std::vector<std::uint32_t>& values) {
  std::uint32_t most = 0;
  for (const std::uint32_t v : values) most = v > most ? v : most;
  return most;
}

template <class T>
bool sizedAs(const std::vector<T>& column, std::size_t wanted) {
  return column.size() == wanted;
}

bool truthFits(const PointTruth& t, std::size_t n) {
  return sizedAs(t.x_m, n) && sizedAs(t.y_m, n) && sizedAs(t.z_m, n) && sizedAs(t.range_m, n) &&
         sizedAs(t.incidence_rad, n) && sizedAs(t.received_db, n) && sizedAs(t.flags, n);
}

bool columnsFit(const ScanHeader& header, const PointBlock& b) {
  const std::size_t n = b.size(), colours = header.has_colour ? n : 0, labels = header.has_labels ? n : 0;
  const std::size_t times = header.has_time ? n : 0, returns = header.has_returns ? n : 0;
  const std::size_t channels = header.has_channel ? n : 0;
  return sizedAs(b.y_m, n) && sizedAs(b.z_m, n) && sizedAs(b.intensity, n) && sizedAs(b.row, n) &&
         sizedAs(b.column, n) && sizedAs(b.red, colours) && sizedAs(b.green, colours) && sizedAs(b.blue, colours) &&
         sizedAs(b.product, labels) && sizedAs(b.material, labels) && sizedAs(b.time_s, times) &&
         sizedAs(b.channel, channels) && sizedAs(b.return_number, returns) && sizedAs(b.return_count, returns) &&
         truthFits(b.truth, header.has_truth ? n : 0);
}

// What is optional: finite, and returns that are counted from 1.
const char* faultOfChannels(const PointBlock& b) {
  const PointTruth& t = b.truth;
  for (const double time : b.time_s)
    if (!std::isfinite(time)) return "a time is not finite";
  for (const auto* column : {&t.x_m, &t.y_m, &t.z_m, &t.range_m, &t.incidence_rad, &t.received_db})
    if (!allFinite(*column)) return "a true value is not finite";
  for (std::size_t i = 0; i < b.return_number.size(); ++i)
    if (b.return_number[i] < 1 || b.return_number[i] > b.return_count[i]) return "invalid return number";
  return nullptr;
}

tl::unexpected<Error> broken(const ScanHeader& header, const std::string& what) {
  return failure(ErrorKind::internal, what, "scan " + header.name);
}

}  // namespace

Result<void> checkHeader(const ScanHeader& header) {
  const Pose& pose = header.file_from_scanner;
  const bool pose_known =
      pose.translation.allFinite() && pose.rotation.coeffs().allFinite() && pose.rotation.norm() > 0;
  if (!pose_known) return broken(header, "the pose is not a rotation and translation");
  for (const double v :
       {header.intensity_min, header.intensity_max, header.acquisition_start_gps_s, header.acquisition_seconds})
    if (!std::isfinite(v)) return broken(header, "an intensity limit or a time is not finite");
  return {};
}

Result<BlockExtent> checkBlock(const ScanHeader& header, const PointBlock& block) {
  if (!columnsFit(header, block))
    return broken(header, "the columns of a block differ in size or do not match the header");
  BlockExtent extent;
  const std::array<const std::vector<float>*, 3> axes = {&block.x_m, &block.y_m, &block.z_m};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Span span = spanOf(*axes[axis]);
    if (!span.finite) return broken(header, "a coordinate is not finite");
    extent.low[axis] = span.low;
    extent.high[axis] = span.high;
  }
  if (!allFinite(block.intensity)) return broken(header, "an intensity is not finite");
  if (hasGrid(header)) {
    extent.row = largest(block.row);
    extent.column = largest(block.column);
    if (extent.row >= header.rows || extent.column >= header.columns)
      return broken(header, "row " + std::to_string(extent.row) + " or column " + std::to_string(extent.column) +
                                " is outside the grid of " + std::to_string(header.rows) + " rows and " +
                                std::to_string(header.columns) + " columns");
  }
  if (header.has_labels &&
      (largest(block.product) >= header.products.size() || largest(block.material) >= header.materials.size()))
    return broken(header, "a label is outside the header's table");
  if (const char* fault = faultOfChannels(block)) return broken(header, fault);
  return extent;
}

void listUnheld(const ScanHeader& header, const char* format, const Channels& held, Report& report) {
  const std::pair<bool, const char*> all[] = {
      {header.has_colour && !held.colour, "colours"},
      {header.has_labels && !held.labels, "product and material labels"},
      {header.has_time && !held.time, "the points' times"},
      {header.has_channel && !held.channel, "the points' channels"},
      {header.has_returns && !held.returns, "return numbers"},
      {header.has_truth && !held.truth, "true positions and flags"},
      {!header.coordinate_metadata.empty() && !held.crs, "the coordinate reference system"}};
  std::string names;
  for (const auto& [unheld, name] : all)
    if (unheld) names += (names.empty() ? "" : ", ") + std::string(name);
  if (!names.empty()) report.warn(header.name, std::string(format) + " cannot store " + names);
}

}  // namespace standpoint
