// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/las/las_packer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pointclouds/files/block_check.h"
#include "pointclouds/las/las_classes.h"

namespace standpoint::las {

void RecordPacker::start(const Layout& layout, const std::array<double, 3>& offset) {
  layout_ = layout;
  offset_ = offset;
}

void RecordPacker::begin(const ScanHeader& header, std::uint16_t station, const JointTable::Offset& labels) {
  header_ = header;
  station_ = station;
  labels_ = labels;
  class_of_product_.clear();
  for (const LabelledProduct& product : header.products) class_of_product_.push_back(classOf(product.ifc_class));
  clamped = beyond_returns = beyond_truth = 0;
}

void RecordPacker::count(WrittenFile& file) const {
  file.offset = offset_;
  file.low = low_, file.high = high_;
  file.points = points_;
  file.by_return = by_return_;
}

std::int32_t RecordPacker::step(double value, std::size_t axis) const {
  constexpr double kLeast = std::numeric_limits<std::int32_t>::min(), kMost = std::numeric_limits<std::int32_t>::max();
  return static_cast<std::int32_t>(std::clamp(std::round((value - offset_[axis]) / kScale_m), kLeast, kMost));
}

Result<void> RecordPacker::putPlace(const PointBlock& b, std::size_t i, std::uint8_t* record) {
  const Eigen::Vector3d p = header_.file_from_scanner * Eigen::Vector3d(b.x_m[i], b.y_m[i], b.z_m[i]);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int32_t value = step(p[static_cast<int>(k)], k);
    if (std::abs(static_cast<double>(value)) >= 2147483647.0)
      return failure(ErrorKind::unusable,
                     "a point is more than 214 km from the first station, out of range for integers of 0.1 mm",
                     "scan " + header_.name);
    low_[k] = points_ == 0 ? value : std::min(low_[k], value);
    high_[k] = points_ == 0 ? value : std::max(high_[k], value);
    store(record + 4 * k, value);
  }
  ++points_;
  return {};
}

void RecordPacker::putReturn(const PointBlock& b, std::size_t i, std::uint8_t* record) {
  const std::uint8_t number = header_.has_returns ? b.return_number[i] : 1;
  const std::uint8_t count = header_.has_returns ? b.return_count[i] : 1;
  beyond_returns += count > 15;
  record[14] = static_cast<std::uint8_t>(std::min<int>(number, 15) | std::min<int>(count, 15) << 4);
  ++by_return_[std::min<std::size_t>(number, 15) - 1];
}

void RecordPacker::putTruth(const PointBlock& b, std::size_t i, std::uint8_t* record) {
  const ExtraPlaces& at = layout_.extras;
  const PointTruth& t = b.truth;
  const Eigen::Vector3d p = truePose(header_) * Eigen::Vector3d(t.x_m[i], t.y_m[i], t.z_m[i]);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int32_t value = step(p[static_cast<int>(k)], k);
    beyond_truth += std::abs(static_cast<double>(value)) >= 2147483647.0;
    store(record + *at.at[static_cast<std::size_t>(Extra::true_x) + k], value);
  }
  store(record + *at[Extra::true_range], t.range_m[i]);
  store(record + *at[Extra::incidence], t.incidence_rad[i]);
  store(record + *at[Extra::received_power], t.received_db[i]);
  record[*at[Extra::flags]] = t.flags[i];
}

void RecordPacker::putExtras(const PointBlock& b, std::size_t i, std::uint8_t* record) {
  const ExtraPlaces& at = layout_.extras;
  if (layout_.labels && header_.has_labels) {
    store(record + *at[Extra::product], b.product[i] + labels_.product);
    store(record + *at[Extra::material], b.material[i] + labels_.material);
  }
  if (layout_.grid && hasGrid(header_)) {
    store(record + *at[Extra::row], b.row[i]);
    store(record + *at[Extra::column], b.column[i]);
  }
  if (layout_.channel && header_.has_channel) record[*at[Extra::channel]] = b.channel[i];
  if (layout_.truth && header_.has_truth) putTruth(b, i, record);
}

Result<void> RecordPacker::put(const PointBlock& b, std::size_t i, std::uint8_t* record) {
  if (auto placed = putPlace(b, i, record); !placed) return placed;
  if (hasIntensity(header_)) {
    const double fraction = (b.intensity[i] - header_.intensity_min) / (header_.intensity_max - header_.intensity_min);
    clamped += fraction < 0 || fraction > 1;
    store(record + 12, static_cast<std::uint16_t>(std::lround(std::clamp(fraction, 0.0, 1.0) * 65535)));
  }
  putReturn(b, i, record);
  const bool surfaceless = header_.has_truth && (b.truth.flags[i] & (point_flag::kNoise | point_flag::kWeather)) != 0;
  record[16] = surfaceless ? kLowNoise : header_.has_labels ? class_of_product_[b.product[i]] : 1;
  store(record + 20, station_);
  if (header_.acquisition_start_gps_s > 0 || header_.has_time)  // the large numbers first: steps of 6e-8 s are left
    store(record + 22, header_.acquisition_start_gps_s - kAdjustedGps_s + (header_.has_time ? b.time_s[i] : 0.0));
  if (layout_.colour && header_.has_colour) {
    store(record + 30, static_cast<std::uint16_t>(b.red[i] * 257));
    store(record + 32, static_cast<std::uint16_t>(b.green[i] * 257));
    store(record + 34, static_cast<std::uint16_t>(b.blue[i] * 257));
  }
  putExtras(b, i, record);
  return {};
}

}  // namespace standpoint::las
