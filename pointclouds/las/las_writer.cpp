// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/part_file.h"
#include "pointclouds/files/block_check.h"
#include "pointclouds/files/scan_text.h"
#include "pointclouds/las/las.h"
#include "pointclouds/las/las_packer.h"

namespace standpoint::las {
namespace {

constexpr std::size_t kAtOnce = 65536;

class Writer final : public CloudWriter {
 public:
  Writer(PartFile file, bool near_infrared) : file_(std::move(file)), near_infrared_(near_infrared) {}
  Result<void> begin(const ScanHeader& header) override;
  Result<void> write(const PointBlock& block) override;
  Result<void> end() override;
  Result<void> close() override;

 private:
  Result<void> start(const ScanHeader& header);
  void listDifferences(const ScanHeader& header);

  PartFile file_;
  bool near_infrared_;
  Layout layout_;
  RecordPacker packer_;
  WrittenFile written_;
  std::string wkt_;
  std::uint64_t scan_points_ = 0;
  std::uint16_t station_ = 0;
  std::optional<ScanHeader> header_;
  JointTable table_;
  std::vector<std::string> lines_;  // of all scans
  std::vector<std::uint8_t> bytes_;
};

// The first scan decides what a record holds, and where the integers begin.
Result<void> Writer::start(const ScanHeader& header) {
  layout_ = layoutFor(header, near_infrared_);
  wkt_ = header.coordinate_metadata;
  written_.system = header.sensor_vendor + (header.sensor_vendor.empty() ? "" : " ") + header.sensor_model;
  std::array<double, 3> offset;
  for (std::size_t k = 0; k < 3; ++k) offset[k] = std::round(header.file_from_scanner.translation[static_cast<int>(k)]);
  packer_.start(layout_, offset);
  std::vector<std::uint8_t> bytes(kHeaderBytes);
  const auto extras = extraRecords(layout_, offset);
  if (!extras.empty()) {
    appendRecordHead(bytes, "LASF_Spec", 4, extras.size(), false, "Extra bytes");
    bytes.insert(bytes.end(), extras.begin(), extras.end());
    ++written_.records;
  }
  constexpr std::size_t kLongest = std::numeric_limits<std::uint16_t>::max() - 1;
  if (wkt_.size() > kLongest) {
    report_.lose(header.name, "its coordinate reference system is too long for LAS");
    wkt_.clear();
  }
  if (!wkt_.empty()) {
    appendRecordHead(bytes, "LASF_Projection", 2112, wkt_.size() + 1, false, "OGC WKT");
    bytes.insert(bytes.end(), wkt_.begin(), wkt_.end());
    bytes.push_back(0);
    ++written_.records;
  }
  if (near_infrared_)
    report_.warn(header.name, layout_.colour ? "point format 8 has unused fields: near infrared is 0"
                                             : "point format 8 has unused fields: near infrared and colours are 0");
  written_.points_at = bytes.size();
  return file_.append(bytes);
}

void Writer::listDifferences(const ScanHeader& header) {
  std::string lost;
  const auto lose = [&](bool more, const char* what) {
    if (more) lost += (lost.empty() ? "" : ", ") + std::string(what);
  };
  lose(header.has_colour && !layout_.colour, "colours");
  lose(header.has_labels && !layout_.labels, "labels");
  lose(hasGrid(header) && !layout_.grid, "row and column");
  lose(header.has_channel && !layout_.channel, "channels");
  lose(header.has_truth && !layout_.truth, "true values");
  if (!lost.empty()) report_.lose(header.name, "the LAS record follows the first scan, which has no " + lost);
  if (!header.coordinate_metadata.empty() && header.coordinate_metadata != wkt_)
    report_.lose(header.name, "coordinate reference system differs from the file's; LAS supports only one");
}

Result<void> Writer::begin(const ScanHeader& header) {
  if (header_) return failure(ErrorKind::internal, "a scan starts before the previous one has ended", header.name);
  if (auto checked = checkHeader(header); !checked) return checked;
  if (station_ == std::numeric_limits<std::uint16_t>::max())
    return failure(ErrorKind::unusable, "a LAS file supports up to 65535 stations", "scan " + header.name);
  if (station_++ == 0)
    if (auto started = start(header); !started) return started;
  listDifferences(header);
  header_ = header;
  if (header.acquisition_start_gps_s > 0)
    written_.created_gps_s =
        std::max(written_.created_gps_s, header.acquisition_start_gps_s + header.acquisition_seconds);
  packer_.begin(header, station_, header.has_labels && layout_.labels ? table_.add(header) : JointTable::Offset{});
  scan_points_ = 0;
  return {};
}

Result<void> Writer::write(const PointBlock& block) {
  if (!header_) return failure(ErrorKind::internal, "points outside a scan", file_.file().string());
  if (block.size() == 0) return {};
  TRY(checkBlock(*header_, block));
  for (std::size_t from = 0; from < block.size(); from += kAtOnce) {
    const std::size_t n = std::min(kAtOnce, block.size() - from);
    bytes_.assign(n * layout_.record_bytes, 0);
    for (std::size_t i = 0; i < n; ++i)
      if (auto put = packer_.put(block, from + i, bytes_.data() + i * layout_.record_bytes); !put) return put;
    if (auto written = file_.append(bytes_); !written) return written;
  }
  scan_points_ += block.size();
  return {};
}

Result<void> Writer::end() {
  if (!header_) return failure(ErrorKind::internal, "a scan ends that was not started", file_.file().string());
  lines_.push_back("scan\t" + std::to_string(scan_points_) + (header_->has_time ? "\ttime" : ""));
  ScanHeader own = *header_;
  own.coordinate_metadata.clear();
  for (std::string& line : scanLines(own)) lines_.push_back(std::move(line));
  const auto lose = [&](std::uint64_t n, const char* what) {
    if (n > 0) report_.lose(header_->name, what + (": " + std::to_string(n)));
  };
  lose(packer_.clamped, "intensities outside the sensor's range, clamped");
  lose(packer_.beyond_returns, "points of pulses with more than 15 returns, the limit of LAS");
  lose(packer_.beyond_truth, "true coordinates beyond 214 km, clamped");
  header_.reset();
  return {};
}

Result<void> Writer::close() {
  if (header_) return failure(ErrorKind::internal, "the file is closed inside a scan", file_.file().string());
  if (station_ == 0) return failure(ErrorKind::unusable, "no complete scan to write", file_.file().string());
  std::string text;
  for (const std::string& line : lines_) text += line + "\n";
  for (const std::string& line : tableLines(table_.products, table_.materials)) text += line + "\n";
  packer_.count(written_);
  written_.extended_at = file_.size();
  std::vector<std::uint8_t> record;
  appendRecordHead(record, kOurRecord, kOurRecordId, text.size(), true, "Stations and labels");
  record.insert(record.end(), text.begin(), text.end());
  if (auto written = file_.append(record); !written) return written;
  if (auto written = file_.overwrite(0, headerBytes(layout_, written_)); !written) return written;
  return file_.commit();
}

}  // namespace

Result<std::unique_ptr<CloudWriter>> createWriter(const std::filesystem::path& file, bool near_infrared) {
  TRY_ASSIGN(auto part, PartFile::create(file));
  return std::make_unique<Writer>(std::move(part), near_infrared);
}

}  // namespace standpoint::las
