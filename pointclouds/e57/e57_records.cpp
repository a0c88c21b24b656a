// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/e57/e57_records.h"

#include <algorithm>

#include "pointclouds/e57/e57_labels.h"
#include "pointclouds/files/block_check.h"

namespace standpoint::e57 {
namespace {

std::vector<Field> pointFields(const ScanHeader& header, Coordinates kind) {
  std::vector<Field> fields = coordinateFields(kind);
  if (hasIntensity(header)) fields.push_back(intensityField(kind, header));
  if (header.has_colour)
    for (const char* name : {"colorRed", "colorGreen", "colorBlue"}) fields.push_back(integerField(name, 8));
  if (hasGrid(header)) {
    fields.push_back(integerField("rowIndex", bitsFor(header.rows - 1)));
    fields.push_back(integerField("columnIndex", bitsFor(header.columns - 1)));
  }
  if (header.has_returns)
    for (const char* name : {"returnIndex", "returnCount"}) fields.push_back(integerField(name, 8));
  if (header.has_time) fields.push_back(doubleField("timeStamp"));
  const std::string prefix = std::string(kLabelPrefix) + ":";
  if (header.has_channel) fields.push_back(integerField(prefix + kChannelField, 8));
  if (header.has_labels) {
    fields.push_back(integerField(prefix + "product", bitsFor(std::max<std::size_t>(header.products.size(), 1) - 1)));
    fields.push_back(integerField(prefix + "material", bitsFor(std::max<std::size_t>(header.materials.size(), 1) - 1)));
  }
  if (header.has_truth)
    for (const char* name : kTruthFields)
      fields.push_back(name == kTruthFields.back() ? integerField(prefix + name, 8) : floatField(prefix + name));
  return fields;
}

PacketWriter packetsFor(const std::vector<Field>& fields) {
  std::vector<unsigned> bits;
  for (const Field& field : fields) bits.push_back(field.bits);
  return PacketWriter(bits);
}

}  // namespace

ScanRecords::ScanRecords(const ScanHeader& header, Coordinates kind)
    : header_(header), fields_(pointFields(header, kind)), packets_(packetsFor(fields_)), places_(kind) {}

Result<void> ScanRecords::write(PagedWriter& out, const PointBlock& block) {
  TRY_ASSIGN(const auto extent, checkBlock(header_, block));
  if (auto taken = places_.take(header_, block, extent); !taken) return taken;
  largest_row_ = std::max(largest_row_, extent.row);
  largest_column_ = std::max(largest_column_, extent.column);
  if (hasGrid(header_)) addLines(block.column);
  return put(out, block);
}

void ScanRecords::addLines(const std::vector<std::uint32_t>& columns) {
  const std::uint64_t first_record = packets_.records();
  for (std::size_t i = 0; ascending_ && i < columns.size();) {
    const std::size_t from = i;
    while (i < columns.size() && columns[i] == columns[from]) ++i;
    if (!lines_.empty() && lines_.back().column == columns[from]) {
      lines_.back().points += i - from;
      continue;
    }
    ascending_ = lines_.empty() || lines_.back().column < columns[from];
    lines_.push_back({first_record + from, columns[from], i - from});
  }
}

Result<void> ScanRecords::put(PagedWriter& out, const PointBlock& b) {
  for (std::size_t from = 0; from < b.size();) {
    const std::size_t n = std::min(packets_.room(), b.size() - from);
    std::size_t stream = places_.put(packets_, 0, b, from, n);  // in the order of pointFields()
    const auto put = [&](const auto& column) { packets_.put(stream++, std::span(column).subspan(from, n)); };
    if (header_.has_colour) put(b.red), put(b.green), put(b.blue);
    if (hasGrid(header_)) put(b.row), put(b.column);
    putExtras(b, stream, from, n);
    if (auto advanced = packets_.advance(out, n); !advanced) return advanced;
    from += n;
  }
  return {};
}

void ScanRecords::putExtras(const PointBlock& b, std::size_t stream, std::size_t from, std::size_t n) {
  const auto put = [&](const auto& column) { packets_.put(stream++, std::span(column).subspan(from, n)); };
  if (header_.has_returns) {
    return_index_.resize(n);  // the file counts from 0
    for (std::size_t i = 0; i < n; ++i) return_index_[i] = static_cast<std::uint8_t>(b.return_number[from + i] - 1);
    packets_.put(stream++, std::span<const std::uint8_t>(return_index_));
    put(b.return_count);
  }
  if (header_.has_time) put(b.time_s);
  if (header_.has_channel) put(b.channel);
  if (header_.has_labels) put(b.product), put(b.material);
  if (!header_.has_truth) return;
  const PointTruth& t = b.truth;
  for (const auto* column : {&t.x_m, &t.y_m, &t.z_m, &t.range_m, &t.incidence_rad, &t.received_db}) put(*column);
  put(t.flags);
}

Result<WrittenVector> ScanRecords::writeLines(PagedWriter& out) const {
  const std::uint64_t points = packets_.records();
  WrittenVector groups;
  groups.fields = {integerField("idElementValue", bitsFor(header_.columns - 1)),
                   integerField("startPointIndex", bitsFor(points)), integerField("pointCount", bitsFor(points))};
  PacketWriter packets = packetsFor(groups.fields);
  TRY(packets.begin(out));
  for (const auto& line : lines_) {
    packets.putWide(0, line.column);
    packets.putWide(1, line.first);
    packets.putWide(2, line.points);
    TRY(packets.advance(out, 1));
  }
  groups.offset = packets.physicalOffset();
  groups.records = packets.records();
  TRY(packets.finish(out));
  return groups;
}

Result<void> ScanRecords::finish(PagedWriter& out, WrittenScan& scan) {
  if (auto finished = packets_.finish(out); !finished) return finished;
  scan.points = {fields_, packets_.physicalOffset(), packets_.records()};
  scan.bounds = places_.bounds;
  scan.largest_row = largest_row_;
  scan.largest_column = largest_column_;
  if (!hasGrid(header_) || !ascending_) return {};
  TRY_ASSIGN(auto lines, writeLines(out));
  scan.lines = std::move(lines);
  return {};
}

}  // namespace standpoint::e57
