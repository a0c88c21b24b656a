// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/point_writer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "core/portable_math.h"

namespace standpoint {

namespace {

constexpr std::uint32_t kAllLanes = (1U << kReturnLanes) - 1;

}  // namespace

void PointWriter::begin(PointBlock& block) {
  block_ = &block;
  size_ = 0;
  room_ = block.size();
}

void PointWriter::beginColumn(const ColumnHits& column) {
  hits_ = &column;
  column_begin_ = size_;
  makeRoom(plan_.settings.rows);
}

// A pattern's pulses are traced channel by channel and written in the order of their firings.
void PointWriter::endColumn() {
  if (!plan_.pattern || plan_.pattern->channels() == 1 || size_ == column_begin_) return;
  const PointBlock& block = *block_;
  const std::uint32_t first = hits_->moving()->firing(0);
  order_.assign(plan_.pattern->firingsPerBlock() + 1, 0);
  for (std::size_t i = column_begin_; i < size_; ++i) ++order_[block.column[i] - first + 1];
  for (std::size_t k = 1; k < order_.size(); ++k) order_[k] += order_[k - 1];
  places_in_order_.resize(size_ - column_begin_);
  for (std::size_t i = column_begin_; i < size_; ++i)
    places_in_order_[order_[block.column[i] - first]++] = static_cast<std::uint32_t>(i);
  forEachColumn([this](auto& column) {
    using Value = typename std::decay_t<decltype(column)>::value_type;
    thread_local std::vector<Value> values;
    values.clear();
    for (const std::uint32_t i : places_in_order_) values.push_back(column[i]);
    std::copy(values.begin(), values.end(), column.begin() + static_cast<std::ptrdiff_t>(column_begin_));
  });
}

void PointWriter::end() { resize(size_); }

void PointWriter::makeRoom(std::size_t points) {
  if (size_ + points > room_) resize(std::max(size_ + points, size_ + plan_.settings.rows));
}

template <class Change>
void PointWriter::forEachColumn(Change change) {
  PointBlock& block = *block_;
  for (auto* column : {&block.x_m, &block.y_m, &block.z_m, &block.intensity}) change(*column);
  for (auto* column : {&block.row, &block.column, &block.product, &block.material}) change(*column);
  if (plan_.settings.imaging)
    for (auto* column : {&block.red, &block.green, &block.blue}) change(*column);
  const ScanChannels& channels = plan_.options.channels;
  if (channels.time) change(block.time_s);
  if (channels.channel) change(block.channel);
  if (channels.returns)
    for (auto* column : {&block.return_number, &block.return_count}) change(*column);
  if (!channels.truth) return;
  PointTruth& truth = block.truth;
  for (auto* column : {&truth.x_m, &truth.y_m, &truth.z_m, &truth.range_m, &truth.incidence_rad, &truth.received_db})
    change(*column);
  change(truth.flags);
}

void PointWriter::resize(std::size_t size) {
  room_ = size;
  forEachColumn([size](auto& column) { column.resize(size); });
}

void PointWriter::write(const ReturnLanes& lanes, std::uint32_t detected) {
  const ScanChannels& channels = plan_.options.channels;
  if (detected == kAllLanes && hits_->moving() == nullptr && !channels.channel && !channels.returns && !channels.truth)
    return writeAll(lanes);
  places_.clear();
  for (std::uint32_t left = detected; left != 0; left &= left - 1) places_.push_back({&lanes, std::countr_zero(left)});
  write(places_);
}

void PointWriter::writeAll(const ReturnLanes& lanes) {
  makeRoom(kReturnLanes);
  PointBlock& block = *block_;
  const auto copy = [this](const auto* from, auto& column) { std::copy_n(from, kReturnLanes, column.data() + size_); };
  copy(lanes.x_m, block.x_m), copy(lanes.y_m, block.y_m), copy(lanes.z_m, block.z_m);
  copy(lanes.signal.intensity, block.intensity);
  copy(lanes.row, block.row);
  std::fill_n(block.column.data() + size_, kReturnLanes, hits_->column());
  copy(lanes.product, block.product), copy(lanes.material, block.material);
  if (plan_.settings.imaging) copy(lanes.red, block.red), copy(lanes.green, block.green), copy(lanes.blue, block.blue);
  if (plan_.options.channels.time)
    for (int k = 0; k < kReturnLanes; ++k)
      block.time_s[size_ + static_cast<std::size_t>(k)] = hits_->time_s(lanes.row[k]);
  size_ += kReturnLanes;
}

void PointWriter::write(const std::vector<Place>& places) {
  makeRoom(places.size());
  PointBlock& block = *block_;
  const ScanChannels& channels = plan_.options.channels;
  const MovingColumn* const moving = hits_->moving();
  for (const Place& place : places) {
    const ReturnLanes& lanes = *place.lanes;
    const int k = place.lane;
    const std::size_t i = size_++;
    block.x_m[i] = lanes.x_m[k], block.y_m[i] = lanes.y_m[k], block.z_m[i] = lanes.z_m[k];
    block.intensity[i] = lanes.signal.intensity[k];
    block.row[i] = moving != nullptr ? moving->channel(lanes.row[k]) : lanes.row[k];
    block.column[i] = moving != nullptr ? moving->firing(lanes.row[k]) : hits_->column();
    block.product[i] = lanes.product[k], block.material[i] = lanes.material[k];
    if (plan_.settings.imaging)
      block.red[i] = lanes.red[k], block.green[i] = lanes.green[k], block.blue[i] = lanes.blue[k];
    if (channels.time) block.time_s[i] = hits_->time_s(lanes.row[k]);
    if (channels.channel) block.channel[i] = static_cast<std::uint8_t>(block.row[i]);
    if (channels.returns) block.return_number[i] = place.return_number, block.return_count[i] = place.return_count;
    if (channels.truth) writeTruth(lanes, k, i, block.truth);
  }
}

void PointWriter::writeTruth(const ReturnLanes& lanes, int lane, std::size_t i, PointTruth& truth) const {
  const Eigen::Vector3f met(lanes.place_x[lane], lanes.place_y[lane], lanes.place_z[lane]);
  const Eigen::Vector3d place = plan_.start.rotation.conjugate() * (met.cast<double>() - plan_.start.translation);
  truth.x_m[i] = static_cast<float>(place.x());
  truth.y_m[i] = static_cast<float>(place.y());
  truth.z_m[i] = static_cast<float>(place.z());
  truth.range_m[i] = lanes.signal.range_m[lane];
  const double cosine = std::min(1.0, static_cast<double>(lanes.signal.cosine[lane]));
  truth.incidence_rad[i] =
      static_cast<float>(2 * std::numbers::pi * portable::turnOf(std::sqrt(1 - cosine * cosine), cosine));
  truth.received_db[i] = 3.0102999566398120F * portable::log2(lanes.signal.x[lane]);
  const bool saturated = lanes.signal.x[lane] > plan_.saturation;
  truth.flags[i] = static_cast<std::uint8_t>(lanes.flags[lane] | (saturated ? point_flag::kSaturated : 0));
}

}  // namespace standpoint
