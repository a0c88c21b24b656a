// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <set>

#include "core/random.h"
#include "pointclouds/block_check.h"
#include "pointclouds/e57.h"
#include "pointclouds/e57_bytes.h"
#include "pointclouds/e57_labels.h"
#include "pointclouds/e57_packet_writer.h"
#include "pointclouds/e57_scan_xml.h"

namespace standpoint::e57 {
namespace {

constexpr std::size_t kFileHeader = 48;

// A guid made of a text: the clock and the machine have no part in it.
std::string guidFrom(const std::string& text) {
  const std::uint64_t a = stableHash(text.c_str()), b = stableHash(text.c_str(), a);
  char guid[40];
  std::snprintf(guid, sizeof guid, "{%08X-%04X-%04X-%04X-%012llX}", static_cast<unsigned>(a >> 32),
                static_cast<unsigned>(a >> 16 & 0xFFFF), static_cast<unsigned>(a & 0xFFFF),
                static_cast<unsigned>(b >> 48), static_cast<unsigned long long>(b & 0xFFFFFFFFFFFFULL));
  return guid;
}

std::vector<Field> pointFields(const ScanHeader& header) {
  std::vector<Field> fields = {floatField("cartesianX"), floatField("cartesianY"), floatField("cartesianZ")};
  if (hasIntensity(header)) fields.push_back(floatField("intensity"));
  if (header.has_colour)
    for (const char* name : {"colorRed", "colorGreen", "colorBlue"}) fields.push_back(integerField(name, 8));
  if (hasGrid(header)) {
    fields.push_back(integerField("rowIndex", bitsFor(header.rows - 1)));
    fields.push_back(integerField("columnIndex", bitsFor(header.columns - 1)));
  }
  if (header.has_labels) {
    const std::string prefix = std::string(kLabelPrefix) + ":";
    fields.push_back(integerField(prefix + "product", bitsFor(std::max<std::size_t>(header.products.size(), 1) - 1)));
    fields.push_back(integerField(prefix + "material", bitsFor(std::max<std::size_t>(header.materials.size(), 1) - 1)));
  }
  return fields;
}

PacketWriter packetsFor(const std::vector<Field>& fields) {
  std::vector<unsigned> bits;
  for (const Field& field : fields) bits.push_back(field.bits);
  return PacketWriter(std::move(bits));
}

// Where each scanner column's points lie, for groupingByLine; one entry per column.
struct Lines {
  struct Line {
    std::uint64_t first;
    std::uint32_t column;
    std::uint64_t points;
  };
  std::vector<Line> all;
  bool ascending = true;

  void add(std::uint64_t first_record, const std::vector<std::uint32_t>& columns) {
    for (std::size_t i = 0; ascending && i < columns.size();) {
      const std::size_t from = i;
      while (i < columns.size() && columns[i] == columns[from]) ++i;
      if (!all.empty() && all.back().column == columns[from]) {
        all.back().points += i - from;
        continue;
      }
      ascending = all.empty() || all.back().column < columns[from];
      all.push_back({first_record + from, columns[from], i - from});
    }
  }
};

class Writer final : public CloudWriter {
 public:
  explicit Writer(PartFile file) : out_(std::move(file)) {}
  Result<void> start() { return out_.append(std::array<std::uint8_t, kFileHeader>{}); }

  Result<void> begin(const ScanHeader& header) override;
  Result<void> write(const PointBlock& block) override;
  Result<void> end() override;
  Result<void> close() override;
  const Report& report() const override { return report_; }

 private:
  struct OpenScan {
    WrittenScan scan;
    PacketWriter packets;
    Lines lines;
  };
  std::string uniqueGuid(const ScanHeader& header) const;
  std::size_t labelTable(const ScanHeader& header);
  Result<void> putRecords(const PointBlock& block);
  Result<void> writeLines();
  std::string document() const;

  PagedWriter out_;
  Report report_;
  std::optional<OpenScan> open_;
  XmlWriter scans_;
  std::set<std::string> guids_;
  std::string guid_seed_;
  std::string coordinate_metadata_;
  std::vector<std::array<std::string, 2>> label_tables_;
  double created_gps_s_ = 0;
};

std::string Writer::uniqueGuid(const ScanHeader& header) const {
  std::string guid = header.guid;
  for (int attempt = 0; guid.empty() || guids_.contains(guid); ++attempt)
    guid = guidFrom(guid_seed_ + header.guid + header.name + std::to_string(attempt));
  return guid;
}

std::size_t Writer::labelTable(const ScanHeader& header) {
  std::array<std::string, 2> table = {productsText(header.products), materialsText(header.materials)};
  const auto known = std::find(label_tables_.begin(), label_tables_.end(), table);
  if (known != label_tables_.end()) return static_cast<std::size_t>(known - label_tables_.begin());
  label_tables_.push_back(std::move(table));
  return label_tables_.size() - 1;
}

Result<void> Writer::begin(const ScanHeader& header) {
  if (open_) return failure(ErrorKind::internal, "a scan begins before the last one has ended", header.name);
  if (auto checked = checkHeader(header); !checked) return checked;
  WrittenScan scan;
  scan.header = header;
  scan.guid = uniqueGuid(header);
  guids_.insert(scan.guid);
  guid_seed_ += scan.guid;
  if (header.name.empty()) scan.header.name = "Scan " + std::to_string(guids_.size());
  scan.points.fields = pointFields(header);
  if (header.has_labels) scan.label_table = labelTable(header);
  if (coordinate_metadata_.empty())
    coordinate_metadata_ = header.coordinate_metadata;
  else if (!header.coordinate_metadata.empty() && header.coordinate_metadata != coordinate_metadata_)
    report_.lose(scan.header.name, "its coordinate reference system differs from the file's, of which E57 has one");
  if (header.acquisition_start_gps_s > 0)
    created_gps_s_ = std::max(created_gps_s_, header.acquisition_start_gps_s + header.acquisition_seconds);
  PacketWriter packets = packetsFor(scan.points.fields);
  open_.emplace(OpenScan{std::move(scan), std::move(packets), {}});
  return open_->packets.begin(out_);
}

Result<void> Writer::write(const PointBlock& block) {
  if (!open_) return failure(ErrorKind::internal, "points outside a scan", out_.file().string());
  if (block.size() == 0) return {};
  WrittenScan& scan = open_->scan;
  const auto extent = checkBlock(scan.header, block);
  if (!extent) return failure(extent.error());
  const bool first = open_->packets.records() == 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    scan.low[axis] = first ? extent->low[axis] : std::min<double>(scan.low[axis], extent->low[axis]);
    scan.high[axis] = first ? extent->high[axis] : std::max<double>(scan.high[axis], extent->high[axis]);
  }
  scan.largest_row = std::max(scan.largest_row, extent->row);
  scan.largest_column = std::max(scan.largest_column, extent->column);
  if (hasGrid(scan.header)) open_->lines.add(open_->packets.records(), block.column);
  return putRecords(block);
}

Result<void> Writer::putRecords(const PointBlock& b) {
  PacketWriter& packets = open_->packets;
  const ScanHeader& header = open_->scan.header;
  for (std::size_t from = 0; from < b.size();) {
    const std::size_t n = std::min(packets.room(), b.size() - from);
    std::size_t stream = 0;  // in the order of pointFields()
    const auto put = [&](const auto& column) { packets.put(stream++, std::span(column).subspan(from, n)); };
    put(b.x_m), put(b.y_m), put(b.z_m);
    if (hasIntensity(header)) put(b.intensity);
    if (header.has_colour) put(b.red), put(b.green), put(b.blue);
    if (hasGrid(header)) put(b.row), put(b.column);
    if (header.has_labels) put(b.product), put(b.material);
    if (auto advanced = packets.advance(out_, n); !advanced) return advanced;
    from += n;
  }
  return {};
}

Result<void> Writer::writeLines() {
  const Lines& lines = open_->lines;
  const std::uint64_t points = open_->packets.records();
  WrittenVector groups;
  groups.fields = {integerField("idElementValue", bitsFor(open_->scan.header.columns - 1)),
                   integerField("startPointIndex", bitsFor(points)), integerField("pointCount", bitsFor(points))};
  PacketWriter packets = packetsFor(groups.fields);
  if (auto begun = packets.begin(out_); !begun) return begun;
  for (const auto& line : lines.all) {
    packets.putWide(0, line.column);
    packets.putWide(1, line.first);
    packets.putWide(2, line.points);
    if (auto advanced = packets.advance(out_, 1); !advanced) return advanced;
  }
  groups.offset = packets.physicalOffset();
  groups.records = packets.records();
  open_->scan.lines = std::move(groups);
  return packets.finish(out_);
}

Result<void> Writer::end() {
  if (!open_) return failure(ErrorKind::internal, "a scan ends that did not begin", out_.file().string());
  if (auto finished = open_->packets.finish(out_); !finished) return finished;
  WrittenScan& scan = open_->scan;
  scan.points.offset = open_->packets.physicalOffset();
  scan.points.records = open_->packets.records();
  if (hasGrid(scan.header) && open_->lines.ascending)
    if (auto written = writeLines(); !written) return written;
  appendScan(scans_, scan);
  open_.reset();
  return {};
}

std::string Writer::document() const {
  XmlWriter xml;
  xml.append("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
  std::string root = "type=\"Structure\" xmlns=\"http://www.astm.org/COMMIT/E57/2010-e57-v1.0\"";
  const std::string prefix = kLabelPrefix;
  if (!label_tables_.empty()) root += " xmlns:" + prefix + "=\"" + kLabelNamespace + "\"";
  xml.open("e57Root", root);
  xml.string("formatName", "ASTM E57 3D Imaging Data File");
  xml.string("guid", guidFrom("file " + guid_seed_));
  xml.integer("versionMajor", 1);
  xml.integer("versionMinor", 0);
  xml.string("e57LibraryVersion", "Standpoint");
  if (created_gps_s_ > 0) appendTime(xml, "creationDateTime", created_gps_s_);
  if (!coordinate_metadata_.empty()) xml.string("coordinateMetadata", coordinate_metadata_);
  const char* vector = "type=\"Vector\" allowHeterogeneousChildren=\"1\"";
  xml.open("data3D", vector);
  xml.append(scans_.text());
  xml.close("data3D");
  xml.leaf("images2D", vector);  // readers refuse a file without it
  if (!label_tables_.empty()) {
    xml.open(prefix + ":labelTables", vector);
    for (const auto& [products, materials] : label_tables_) {
      xml.open("vectorChild", "type=\"Structure\"");
      xml.string(prefix + ":products", products);
      xml.string(prefix + ":materials", materials);
      xml.close("vectorChild");
    }
    xml.close(prefix + ":labelTables");
  }
  xml.close("e57Root");
  return xml.text();
}

Result<void> Writer::close() {
  if (open_) return failure(ErrorKind::internal, "the file is closed inside a scan", out_.file().string());
  const std::string xml = document();
  const std::uint64_t xml_offset = physicalFrom(out_.logicalSize());
  if (auto written = out_.append({reinterpret_cast<const std::uint8_t*>(xml.data()), xml.size()}); !written)
    return written;
  std::array<std::uint8_t, kFileHeader> header{};
  std::copy_n("ASTM-E57", 8, header.begin());
  store<std::uint32_t>(header.data() + 8, 1);
  store(header.data() + 16, out_.physicalSize());
  store(header.data() + 24, xml_offset);
  store<std::uint64_t>(header.data() + 32, xml.size());
  store(header.data() + 40, kPageBytes);
  if (auto written = out_.overwrite(0, header); !written) return written;
  return out_.close();
}

}  // namespace

Result<std::unique_ptr<CloudWriter>> createWriter(const std::filesystem::path& file) {
  auto part = PartFile::create(file);
  if (!part) return failure(part.error());
  auto writer = std::make_unique<Writer>(std::move(*part));
  if (auto started = writer->start(); !started) return failure(started.error());
  return writer;
}

}  // namespace standpoint::e57
