// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <set>

#include "core/random.h"
#include "pointclouds/block_check.h"
#include "pointclouds/e57.h"
#include "pointclouds/e57_labels.h"
#include "pointclouds/e57_packet_writer.h"
#include "pointclouds/e57_pictures.h"
#include "pointclouds/e57_scan_xml.h"
#include "pointclouds/raw_bytes.h"

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
  Writer(PartFile file, Coordinates kind) : out_(std::move(file)), kind_(kind) {}
  Result<void> start() { return out_.append(std::array<std::uint8_t, kFileHeader>{}); }

  Result<void> begin(const ScanHeader& header) override;
  Result<void> write(const PointBlock& block) override;
  Result<void> picture(const StationPicture& picture) override;
  Result<void> end() override;
  Result<void> close() override;

 private:
  struct OpenScan {
    WrittenScan scan;
    PacketWriter packets;
    Lines lines;
    StoredPlaces places;
    std::vector<StationPicture> pictures;  // their blobs have no place inside the section of points
  };
  std::string uniqueGuid(const std::string& wanted, const std::string& name);
  std::size_t labelTable(const ScanHeader& header);
  Result<void> putRecords(const PointBlock& block);
  void putExtras(const PointBlock& block, std::size_t stream, std::size_t from, std::size_t n);
  Result<void> writeLines();
  Result<void> writePictures();
  std::string document() const;

  PagedWriter out_;
  Coordinates kind_;
  std::optional<OpenScan> open_;
  XmlWriter scans_, pictures_;
  bool uses_namespace_ = false;
  std::size_t scan_count_ = 0;
  std::vector<std::uint8_t> return_index_;
  std::set<std::string> guids_;
  std::string guid_seed_;
  std::string coordinate_metadata_;
  std::vector<std::array<std::string, 2>> label_tables_;
  double created_gps_s_ = 0;
};

std::string Writer::uniqueGuid(const std::string& wanted, const std::string& name) {
  std::string guid = wanted;
  for (int attempt = 0; guid.empty() || guids_.contains(guid); ++attempt)
    guid = guidFrom(guid_seed_ + wanted + name + std::to_string(attempt));
  guids_.insert(guid);
  guid_seed_ += guid;
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
  scan.guid = uniqueGuid(header.guid, header.name);
  scan.spherical = kind_ == Coordinates::spherical;
  ++scan_count_;
  if (header.name.empty()) scan.header.name = "Scan " + std::to_string(scan_count_);
  scan.points.fields = pointFields(header, kind_);
  uses_namespace_ |= header.has_labels || header.has_truth;
  if (header.has_labels) scan.label_table = labelTable(header);
  if (coordinate_metadata_.empty())
    coordinate_metadata_ = header.coordinate_metadata;
  else if (!header.coordinate_metadata.empty() && header.coordinate_metadata != coordinate_metadata_)
    report_.lose(scan.header.name, "its coordinate reference system differs from the file's, of which E57 has one");
  if (header.acquisition_start_gps_s > 0)
    created_gps_s_ = std::max(created_gps_s_, header.acquisition_start_gps_s + header.acquisition_seconds);
  PacketWriter packets = packetsFor(scan.points.fields);
  open_.emplace(OpenScan{std::move(scan), std::move(packets), {}, StoredPlaces(kind_), {}});
  return open_->packets.begin(out_);
}

Result<void> Writer::write(const PointBlock& block) {
  if (!open_) return failure(ErrorKind::internal, "points outside a scan", out_.file().string());
  if (block.size() == 0) return {};
  WrittenScan& scan = open_->scan;
  const auto extent = checkBlock(scan.header, block);
  if (!extent) return failure(extent.error());
  if (auto taken = open_->places.take(scan.header, block, *extent); !taken) return taken;
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
    std::size_t stream = open_->places.put(packets, 0, b, from, n);  // in the order of pointFields()
    const auto put = [&](const auto& column) { packets.put(stream++, std::span(column).subspan(from, n)); };
    if (header.has_colour) put(b.red), put(b.green), put(b.blue);
    if (hasGrid(header)) put(b.row), put(b.column);
    putExtras(b, stream, from, n);
    if (auto advanced = packets.advance(out_, n); !advanced) return advanced;
    from += n;
  }
  return {};
}

void Writer::putExtras(const PointBlock& b, std::size_t stream, std::size_t from, std::size_t n) {
  const ScanHeader& header = open_->scan.header;
  PacketWriter& packets = open_->packets;
  const auto put = [&](const auto& column) { packets.put(stream++, std::span(column).subspan(from, n)); };
  if (header.has_returns) {
    return_index_.resize(n);  // the file counts from 0
    for (std::size_t i = 0; i < n; ++i) return_index_[i] = static_cast<std::uint8_t>(b.return_number[from + i] - 1);
    packets.put(stream++, std::span<const std::uint8_t>(return_index_));
    put(b.return_count);
  }
  if (header.has_time) put(b.time_s);
  if (header.has_labels) put(b.product), put(b.material);
  if (!header.has_truth) return;
  const PointTruth& t = b.truth;
  for (const auto* column : {&t.x_m, &t.y_m, &t.z_m, &t.range_m, &t.incidence_rad, &t.received_db}) put(*column);
  put(t.flags);
}

Result<void> Writer::picture(const StationPicture& picture) {
  if (!open_) return failure(ErrorKind::internal, "a picture outside a scan", out_.file().string());
  if (picture.media_type != "image/jpeg" && picture.media_type != "image/png")
    return failure(ErrorKind::internal, "an E57 holds pictures as JPEG or PNG, not " + picture.media_type,
                   picture.name);
  open_->pictures.push_back(picture);
  return {};
}

Result<void> Writer::writePictures() {
  for (const StationPicture& picture : open_->pictures) {
    const auto offset = writeBlob(out_, picture.bytes);
    if (!offset) return failure(offset.error());
    appendPicture(pictures_, picture, *offset, uniqueGuid({}, "picture " + picture.name), open_->scan.guid);
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
  scan.bounds = open_->places.bounds;
  if (hasGrid(scan.header) && open_->lines.ascending)
    if (auto written = writeLines(); !written) return written;
  appendScan(scans_, scan);
  if (auto written = writePictures(); !written) return written;
  if (const auto clamped = open_->places.clamped(); clamped > 0)
    report_.lose(scan.header.name,
                 std::to_string(clamped) + " intensities lay outside the sensor's range and were clamped");
  if (kind_ != Coordinates::cartesian)
    report_.note(scan.header.name, kind_ == Coordinates::scaled ? "coordinates were rounded to 0.1 mm"
                                                                : "coordinates were rounded to 1e-7 of the range");
  open_.reset();
  return {};
}

std::string Writer::document() const {
  XmlWriter xml;
  xml.append("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
  std::string root = "type=\"Structure\" xmlns=\"http://www.astm.org/COMMIT/E57/2010-e57-v1.0\"";
  const std::string prefix = kLabelPrefix;
  if (uses_namespace_) root += " xmlns:" + prefix + "=\"" + kLabelNamespace + "\"";
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
  xml.open("images2D", vector);  // readers refuse a file without it
  xml.append(pictures_.text());
  xml.close("images2D");
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

Result<std::unique_ptr<CloudWriter>> createWriter(const std::filesystem::path& file, Coordinates kind) {
  auto part = PartFile::create(file);
  if (!part) return failure(part.error());
  auto writer = std::make_unique<Writer>(std::move(*part), kind);
  if (auto started = writer->start(); !started) return failure(started.error());
  return writer;
}

}  // namespace standpoint::e57
