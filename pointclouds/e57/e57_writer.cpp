// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <set>

#include "core/random.h"
#include "pointclouds/e57/e57.h"
#include "pointclouds/e57/e57_labels.h"
#include "pointclouds/e57/e57_pictures.h"
#include "pointclouds/e57/e57_records.h"
#include "pointclouds/e57/e57_scan_xml.h"
#include "pointclouds/files/block_check.h"
#include "pointclouds/files/raw_bytes.h"

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
    ScanRecords records;
    std::vector<StationPicture> pictures;  // their blobs have no place inside the section of points
  };
  std::string uniqueGuid(const std::string& wanted, const std::string& name);
  std::size_t labelTable(const ScanHeader& header);
  Result<void> writePictures();
  std::string document() const;

  PagedWriter out_;
  Coordinates kind_;
  std::optional<OpenScan> open_;
  XmlWriter scans_, pictures_;
  bool uses_namespace_ = false;
  std::size_t scan_count_ = 0;
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
  if (open_) return failure(ErrorKind::internal, "a scan starts before the previous one has ended", header.name);
  if (auto checked = checkHeader(header); !checked) return checked;
  WrittenScan scan;
  scan.header = header;
  scan.guid = uniqueGuid(header.guid, header.name);
  scan.spherical = kind_ == Coordinates::spherical;
  ++scan_count_;
  if (header.name.empty()) scan.header.name = "Scan " + std::to_string(scan_count_);
  uses_namespace_ |= header.has_labels || header.has_truth || header.has_channel;
  if (header.has_labels) scan.label_table = labelTable(header);
  if (coordinate_metadata_.empty())
    coordinate_metadata_ = header.coordinate_metadata;
  else if (!header.coordinate_metadata.empty() && header.coordinate_metadata != coordinate_metadata_)
    report_.lose(scan.header.name, "coordinate reference system differs from the file's; E57 supports only one");
  if (header.acquisition_start_gps_s > 0)
    created_gps_s_ = std::max(created_gps_s_, header.acquisition_start_gps_s + header.acquisition_seconds);
  ScanRecords records(scan.header, kind_);
  open_.emplace(OpenScan{std::move(scan), std::move(records), {}});
  return open_->records.begin(out_);
}

Result<void> Writer::write(const PointBlock& block) {
  if (!open_) return failure(ErrorKind::internal, "points outside a scan", out_.file().string());
  if (block.size() == 0) return {};
  return open_->records.write(out_, block);
}

Result<void> Writer::picture(const StationPicture& picture) {
  if (!open_) return failure(ErrorKind::internal, "a picture outside a scan", out_.file().string());
  if (picture.media_type != "image/jpeg" && picture.media_type != "image/png")
    return failure(ErrorKind::internal, "E57 supports JPEG and PNG images, not " + picture.media_type, picture.name);
  open_->pictures.push_back(picture);
  return {};
}

Result<void> Writer::writePictures() {
  for (const StationPicture& picture : open_->pictures) {
    TRY_ASSIGN(const auto offset, writeBlob(out_, picture.bytes));
    appendPicture(pictures_, picture, offset, uniqueGuid({}, "picture " + picture.name), open_->scan.guid);
  }
  return {};
}

Result<void> Writer::end() {
  if (!open_) return failure(ErrorKind::internal, "a scan ends that was not started", out_.file().string());
  WrittenScan& scan = open_->scan;
  if (auto finished = open_->records.finish(out_, scan); !finished) return finished;
  appendScan(scans_, scan);
  if (auto written = writePictures(); !written) return written;
  if (const auto clamped = open_->records.clamped(); clamped > 0)
    report_.lose(scan.header.name, std::to_string(clamped) + " intensities outside the sensor's range were clamped");
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
  TRY_ASSIGN(auto part, PartFile::create(file));
  auto writer = std::make_unique<Writer>(std::move(part), kind);
  TRY(writer->start());
  return writer;
}

}  // namespace standpoint::e57
