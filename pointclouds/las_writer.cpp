// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>

#include "pointclouds/block_check.h"
#include "pointclouds/file_access.h"
#include "pointclouds/las.h"
#include "pointclouds/las_classes.h"
#include "pointclouds/las_record.h"
#include "pointclouds/scan_text.h"

namespace standpoint::las {
namespace {

constexpr std::size_t kHeaderBytes = 375, kRecordHead = 54, kExtendedHead = 60, kExtraBytes = 192;
constexpr std::size_t kAtOnce = 65536;
constexpr double kScale_m = 1e-4;
constexpr std::uint16_t kAdjustedTime = 1, kWktBit = 16;

template <class T>
void append(std::vector<std::uint8_t>& bytes, T value) {
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof value);
  store(bytes.data() + at, value);
}

void putText(std::uint8_t* to, std::size_t room, const std::string& text) {
  std::memcpy(to, text.data(), std::min(room, text.size()));
}

// Variable-length records before the points, and the extended one behind them.
void appendRecordHead(std::vector<std::uint8_t>& bytes, const char* user, std::uint16_t id, std::uint64_t length,
                      bool extended, const char* description) {
  const std::size_t at = bytes.size();
  bytes.resize(at + (extended ? kExtendedHead : kRecordHead));
  putText(bytes.data() + at + 2, 16, user);
  store(bytes.data() + at + 18, id);
  if (extended)
    store(bytes.data() + at + 20, length);
  else
    store(bytes.data() + at + 20, static_cast<std::uint16_t>(length));
  putText(bytes.data() + at + (extended ? 28 : 22), 32, description);
}

struct Layout {
  bool colour = false, labels = false, grid = false, truth = false;
  ExtraPlaces extras;
  std::uint32_t record_bytes = 0;
};

Layout layoutFor(const ScanHeader& header) {
  Layout layout{
      .colour = header.has_colour, .labels = header.has_labels, .grid = hasGrid(header), .truth = header.has_truth};
  layout.extras.end = layout.colour ? 36 : 30;
  for (std::size_t i = 0; i < kExtraKinds; ++i) {
    const auto kind = static_cast<Extra>(i);
    const bool wanted = kind <= Extra::material ? layout.labels : kind <= Extra::column ? layout.grid : layout.truth;
    if (!wanted) continue;
    layout.extras.at[i] = layout.extras.end;
    layout.extras.end += kExtras[i].bytes;
  }
  layout.record_bytes = layout.extras.end;
  return layout;
}

class Writer final : public CloudWriter {
 public:
  explicit Writer(PartFile file) : file_(std::move(file)) {}
  Result<void> begin(const ScanHeader& header) override;
  Result<void> write(const PointBlock& block) override;
  Result<void> end() override;
  Result<void> close() override;

 private:
  Result<void> start(const ScanHeader& header);
  std::vector<std::uint8_t> extraRecords() const;
  void listDifferences(const ScanHeader& header);
  Result<void> putPoint(const PointBlock& block, std::size_t i, std::uint8_t* record);
  void putTruth(const PointBlock& block, std::size_t i, std::uint8_t* record);
  std::int32_t step(double value, std::size_t axis);
  void putDate(std::uint8_t* header) const;
  std::array<std::uint8_t, kHeaderBytes> headerBytes(std::uint64_t extended_at) const;

  PartFile file_;
  Layout layout_;
  std::string wkt_, system_;
  std::uint64_t points_at_ = 0, points_ = 0, scan_points_ = 0;
  std::uint32_t records_ = 0;    // before the points
  std::uint16_t station_ = 0;
  double created_gps_s_ = 0;
  std::array<double, 3> offset_{};
  std::array<std::int32_t, 3> low_{}, high_{};
  std::array<std::uint64_t, 15> by_return_{};
  std::uint64_t clamped_ = 0, beyond_returns_ = 0, beyond_truth_ = 0;
  std::optional<ScanHeader> header_;
  JointTable table_;
  JointTable::Offset offset_in_table_;
  std::vector<std::uint8_t> class_of_product_;
  std::vector<std::string> lines_;   // of all scans
  std::vector<std::uint8_t> bytes_;
};

std::vector<std::uint8_t> Writer::extraRecords() const {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < kExtraKinds; ++i) {
    if (!layout_.extras.at[i]) continue;
    std::array<std::uint8_t, kExtraBytes> extra{};
    extra[2] = kExtras[i].type;
    putText(extra.data() + 4, 31, kExtras[i].name);
    putText(extra.data() + 160, 31, kExtras[i].description);
    const auto kind = static_cast<Extra>(i);
    if (kind >= Extra::true_x && kind <= Extra::true_z) {
      extra[3] = 8 | 16;  // scale and offset count
      store(extra.data() + 112, kScale_m);
      store(extra.data() + 136, offset_[i - static_cast<std::size_t>(Extra::true_x)]);
    }
    bytes.insert(bytes.end(), extra.begin(), extra.end());
  }
  return bytes;
}

// The first scan decides what a record holds, and where the integers begin.
Result<void> Writer::start(const ScanHeader& header) {
  layout_ = layoutFor(header);
  wkt_ = header.coordinate_metadata;
  system_ = header.sensor_vendor + (header.sensor_vendor.empty() ? "" : " ") + header.sensor_model;
  for (std::size_t k = 0; k < 3; ++k)
    offset_[k] = std::round(header.file_from_scanner.translation[static_cast<int>(k)]);
  std::vector<std::uint8_t> bytes(kHeaderBytes);
  const auto extras = extraRecords();
  if (!extras.empty()) {
    appendRecordHead(bytes, "LASF_Spec", 4, extras.size(), false, "Extra bytes");
    bytes.insert(bytes.end(), extras.begin(), extras.end());
    ++records_;
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
    ++records_;
  }
  points_at_ = bytes.size();
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
  lose(header.has_truth && !layout_.truth, "true values");
  if (!lost.empty()) report_.lose(header.name, "the first scan decides what a LAS record holds, and has no " + lost);
  if (!header.coordinate_metadata.empty() && header.coordinate_metadata != wkt_)
    report_.lose(header.name, "its coordinate reference system differs from the file's, of which LAS has one");
}

Result<void> Writer::begin(const ScanHeader& header) {
  if (header_) return failure(ErrorKind::internal, "a scan begins before the last one has ended", header.name);
  if (auto checked = checkHeader(header); !checked) return checked;
  if (station_ == std::numeric_limits<std::uint16_t>::max())
    return failure(ErrorKind::unusable, "a LAS file holds at most 65535 stations", "scan " + header.name);
  if (station_++ == 0)
    if (auto started = start(header); !started) return started;
  listDifferences(header);
  header_ = header;
  if (header.acquisition_start_gps_s > 0)
    created_gps_s_ = std::max(created_gps_s_, header.acquisition_start_gps_s + header.acquisition_seconds);
  offset_in_table_ = header.has_labels && layout_.labels ? table_.add(header) : JointTable::Offset{};
  class_of_product_.clear();
  for (const LabelledProduct& product : header.products) class_of_product_.push_back(classOf(product.ifc_class));
  scan_points_ = clamped_ = beyond_returns_ = beyond_truth_ = 0;
  return {};
}

std::int32_t Writer::step(double value, std::size_t axis) {
  constexpr double kLeast = std::numeric_limits<std::int32_t>::min(), kMost = std::numeric_limits<std::int32_t>::max();
  return static_cast<std::int32_t>(std::clamp(std::round((value - offset_[axis]) / kScale_m), kLeast, kMost));
}

void Writer::putTruth(const PointBlock& b, std::size_t i, std::uint8_t* record) {
  const ExtraPlaces& at = layout_.extras;
  const PointTruth& t = b.truth;
  const Eigen::Vector3d p = header_->file_from_scanner * Eigen::Vector3d(t.x_m[i], t.y_m[i], t.z_m[i]);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int32_t value = step(p[static_cast<int>(k)], k);
    beyond_truth_ += std::abs(static_cast<double>(value)) >= 2147483647.0;
    store(record + *at.at[static_cast<std::size_t>(Extra::true_x) + k], value);
  }
  store(record + *at[Extra::true_range], t.range_m[i]);
  store(record + *at[Extra::incidence], t.incidence_rad[i]);
  store(record + *at[Extra::received_power], t.received_db[i]);
  record[*at[Extra::flags]] = t.flags[i];
}

Result<void> Writer::putPoint(const PointBlock& b, std::size_t i, std::uint8_t* record) {
  const ScanHeader& header = *header_;
  const Eigen::Vector3d p = header.file_from_scanner * Eigen::Vector3d(b.x_m[i], b.y_m[i], b.z_m[i]);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int32_t value = step(p[static_cast<int>(k)], k);
    if (std::abs(static_cast<double>(value)) >= 2147483647.0)
      return failure(ErrorKind::unusable,
                     "a point lies more than 214 km from the first station, which integers of 0.1 mm do not reach",
                     "scan " + header.name);
    low_[k] = points_ == 0 ? value : std::min(low_[k], value);
    high_[k] = points_ == 0 ? value : std::max(high_[k], value);
    store(record + 4 * k, value);
  }
  if (hasIntensity(header)) {
    const double share = (b.intensity[i] - header.intensity_min) / (header.intensity_max - header.intensity_min);
    clamped_ += share < 0 || share > 1;
    store(record + 12, static_cast<std::uint16_t>(std::lround(std::clamp(share, 0.0, 1.0) * 65535)));
  }
  const std::uint8_t number = header.has_returns ? b.return_number[i] : 1,
                     count = header.has_returns ? b.return_count[i] : 1;
  beyond_returns_ += count > 15;
  record[14] = static_cast<std::uint8_t>(std::min<int>(number, 15) | std::min<int>(count, 15) << 4);
  ++by_return_[std::min<std::size_t>(number, 15) - 1];
  const bool surfaceless = header.has_truth && (b.truth.flags[i] & (point_flag::kNoise | point_flag::kWeather)) != 0;
  record[16] = surfaceless ? kLowNoise : header.has_labels ? class_of_product_[b.product[i]] : 1;
  store(record + 20, station_);
  if (header.acquisition_start_gps_s > 0 || header.has_time)   // the large numbers first: steps of 6e-8 s are left
    store(record + 22, header.acquisition_start_gps_s - kAdjustedGps_s + (header.has_time ? b.time_s[i] : 0.0));
  if (layout_.colour && header.has_colour) {
    store(record + 30, static_cast<std::uint16_t>(b.red[i] * 257));
    store(record + 32, static_cast<std::uint16_t>(b.green[i] * 257));
    store(record + 34, static_cast<std::uint16_t>(b.blue[i] * 257));
  }
  const ExtraPlaces& at = layout_.extras;
  if (layout_.labels && header.has_labels) {
    store(record + *at[Extra::product], b.product[i] + offset_in_table_.product);
    store(record + *at[Extra::material], b.material[i] + offset_in_table_.material);
  }
  if (layout_.grid && hasGrid(header)) {
    store(record + *at[Extra::row], b.row[i]);
    store(record + *at[Extra::column], b.column[i]);
  }
  if (layout_.truth && header.has_truth) putTruth(b, i, record);
  ++points_;
  return {};
}

Result<void> Writer::write(const PointBlock& block) {
  if (!header_) return failure(ErrorKind::internal, "points outside a scan", file_.file().string());
  if (block.size() == 0) return {};
  if (const auto extent = checkBlock(*header_, block); !extent) return failure(extent.error());
  for (std::size_t from = 0; from < block.size(); from += kAtOnce) {
    const std::size_t n = std::min(kAtOnce, block.size() - from);
    bytes_.assign(n * layout_.record_bytes, 0);
    for (std::size_t i = 0; i < n; ++i)
      if (auto put = putPoint(block, from + i, bytes_.data() + i * layout_.record_bytes); !put) return put;
    if (auto written = file_.append(bytes_); !written) return written;
  }
  scan_points_ += block.size();
  return {};
}

Result<void> Writer::end() {
  if (!header_) return failure(ErrorKind::internal, "a scan ends that did not begin", file_.file().string());
  lines_.push_back("scan\t" + std::to_string(scan_points_) + (header_->has_time ? "\ttime" : ""));
  ScanHeader own = *header_;
  own.coordinate_metadata.clear();
  for (std::string& line : scanLines(own)) lines_.push_back(std::move(line));
  const auto lose = [&](std::uint64_t n, const char* what) {
    if (n > 0) report_.lose(header_->name, std::to_string(n) + what);
  };
  lose(clamped_, " intensities lay outside the sensor's range and were clamped");
  lose(beyond_returns_, " points are of pulses with more than 15 returns, which LAS cannot say");
  lose(beyond_truth_, " true coordinates lie beyond 214 km and were clamped");
  header_.reset();
  return {};
}

void Writer::putDate(std::uint8_t* header) const {
  using namespace std::chrono;
  if (!(created_gps_s_ > 0 && created_gps_s_ < 4e9)) return;
  const sys_days day = sys_days{year{1980} / January / 6} + days{static_cast<int>(created_gps_s_ / 86400)};
  const year_month_day date{day};
  store(header + 90, static_cast<std::uint16_t>((day - sys_days{date.year() / January / 1}).count() + 1));
  store(header + 92, static_cast<std::uint16_t>(static_cast<int>(date.year())));
}

std::array<std::uint8_t, kHeaderBytes> Writer::headerBytes(std::uint64_t extended_at) const {
  std::array<std::uint8_t, kHeaderBytes> h{};
  putText(h.data(), 4, "LASF");
  store(h.data() + 6, static_cast<std::uint16_t>(kAdjustedTime | kWktBit));
  h[24] = 1, h[25] = 4;
  putText(h.data() + 26, 32, system_);
  putText(h.data() + 58, 32, "Standpoint");
  putDate(h.data());
  store(h.data() + 94, static_cast<std::uint16_t>(kHeaderBytes));
  store(h.data() + 96, static_cast<std::uint32_t>(points_at_));
  store(h.data() + 100, records_);
  h[104] = layout_.colour ? 7 : 6;
  store(h.data() + 105, static_cast<std::uint16_t>(layout_.record_bytes));
  for (std::size_t k = 0; k < 3; ++k) {
    store(h.data() + 131 + 8 * k, kScale_m);
    store(h.data() + 155 + 8 * k, offset_[k]);
    store(h.data() + 179 + 16 * k, high_[k] * kScale_m + offset_[k]);
    store(h.data() + 187 + 16 * k, low_[k] * kScale_m + offset_[k]);
  }
  store(h.data() + 235, extended_at);
  store<std::uint32_t>(h.data() + 243, 1);
  store(h.data() + 247, points_);
  for (std::size_t i = 0; i < by_return_.size(); ++i) store(h.data() + 255 + 8 * i, by_return_[i]);
  return h;
}

Result<void> Writer::close() {
  if (header_) return failure(ErrorKind::internal, "the file is closed inside a scan", file_.file().string());
  if (station_ == 0) return failure(ErrorKind::unusable, "there is no whole scan to write", file_.file().string());
  std::string text;
  for (const std::string& line : lines_) text += line + "\n";
  for (const std::string& line : tableLines(table_.products, table_.materials)) text += line + "\n";
  const std::uint64_t extended_at = file_.size();
  std::vector<std::uint8_t> record;
  appendRecordHead(record, kOurRecord, kOurRecordId, text.size(), true, "Stations and labels");
  record.insert(record.end(), text.begin(), text.end());
  if (auto written = file_.append(record); !written) return written;
  if (auto written = file_.overwrite(0, headerBytes(extended_at)); !written) return written;
  return file_.commit();
}

}  // namespace

Result<std::unique_ptr<CloudWriter>> createWriter(const std::filesystem::path& file) {
  auto part = PartFile::create(file);
  if (!part) return failure(part.error());
  return std::make_unique<Writer>(std::move(*part));
}

}  // namespace standpoint::las
