// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/dataset/label_sink.h"

#include "pointclouds/datasets/label_array.h"

namespace standpoint {

namespace {

constexpr std::size_t kColumnBuffer = std::size_t{1} << 18U;

}  // namespace

Result<NumberColumn> NumberColumn::create(const std::filesystem::path& file, bool wide) {
  TRY_ASSIGN(auto part, PartFile::create(file));
  NumberColumn column(std::move(part), wide);
  column.buffer_ = numpyHead(wide ? "<u4" : "<u2", 0, 1);
  return column;
}

Result<void> NumberColumn::add(std::uint32_t value) {
  ++rows_;
  for (unsigned byte = 0; byte < (wide_ ? 4U : 2U); ++byte) buffer_ += static_cast<char>(value >> (8 * byte));
  return buffer_.size() < kColumnBuffer ? Result<void>() : flush();
}

Result<void> NumberColumn::flush() {
  TRY(file_.append(buffer_));
  buffer_.clear();
  return {};
}

Result<void> NumberColumn::finish() {
  TRY(flush());
  const auto head = numpyHead(wide_ ? "<u4" : "<u2", rows_, 1);
  TRY(file_.overwrite(0, {reinterpret_cast<const std::uint8_t*>(head.data()), head.size()}));
  return file_.commit();
}

LabelSink::LabelSink(const std::vector<RecipeClasses>& classes, std::vector<std::filesystem::path> labels,
                     std::filesystem::path instances)
    : maps_(classes), label_files_(std::move(labels)), instance_file_(std::move(instances)) {
  for (const auto& map : maps_) counts_.emplace_back(map.map.classes.size(), 0);
}

Result<void> LabelSink::begin(const ScanHeader& header) {
  for (std::size_t k = 0; k < maps_.size(); ++k) {
    classes_.emplace_back(maps_[k].map, header);
    TRY_ASSIGN(auto column, NumberColumn::create(label_files_[k], false));
    labels_.push_back(std::move(column));
  }
  TRY_ASSIGN(auto column, NumberColumn::create(instance_file_, true));
  instances_.emplace(std::move(column));
  return {};
}

Result<void> LabelSink::write(const PointBlock& block) {
  for (std::size_t k = 0; k < maps_.size(); ++k)
    for (std::size_t i = 0; i < block.size(); ++i) {
      const auto index = classes_[k].of(block, i);
      ++counts_[k][index];
      TRY(labels_[k].add(maps_[k].map.classes[index].id));
    }
  for (std::size_t i = 0; i < block.size(); ++i)
    TRY(instances_->add(!classes_.empty() && classes_.front().isSurfaceless(block, i) ? 0 : block.product[i] + 1));
  return {};
}

Result<void> LabelSink::end() {
  for (auto& column : labels_) TRY(column.finish());
  return instances_->finish();
}

}  // namespace standpoint
