// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>

#include "core/part_file.h"
#include "pointclouds/files/block_check.h"
#include "pointclouds/files/number_text.h"
#include "pointclouds/text/text_points.h"

namespace standpoint::text_points {
namespace {

enum class Kind { pts, xyz, csv };

constexpr std::size_t kBuffered = 1 << 20;
constexpr unsigned kPlaceDecimals = 5;  // 0.01 mm, of a national grid's millions of metres, too
constexpr std::size_t kCountDigits = 20;

// One scan in the file's frame, a line for each point.
class Writer final : public CloudWriter {
 public:
  Writer(PartFile file, Kind kind) : file_(std::move(file)), kind_(kind) {}
  Result<void> begin(const ScanHeader& header) override;
  Result<void> write(const PointBlock& block) override;
  Result<void> end() override;
  Result<void> close() override;

 private:
  std::string countLine() const;
  std::string columnNames() const;
  void appendPoint(const PointBlock& block, std::size_t i);
  void appendColumns(const PointBlock& block, std::size_t i);
  void appendIntensity(float value);
  template <class T>
  void next(T value) {
    text_ += kind_ == Kind::csv ? ',' : ' ';
    if constexpr (std::is_same_v<T, float>)
      appendFloat(text_, value);
    else
      appendNumber(text_, value);
  }
  Result<void> flushFrom(std::size_t enough);

  PartFile file_;
  Kind kind_;
  std::optional<ScanHeader> header_;
  bool ended_ = false;
  std::uint64_t points_ = 0, clamped_ = 0;
  std::string text_;
};

// Always as long: the number of points is known last.
std::string Writer::countLine() const {
  const std::string digits = std::to_string(points_);
  return std::string(kCountDigits - digits.size(), '0') + digits + "\n";
}

std::string Writer::columnNames() const {
  const ScanHeader& h = *header_;
  std::string names = "X,Y,Z";
  if (h.has_colour) names += ",R,G,B";
  if (hasIntensity(h)) names += ",Intensity";
  if (h.has_labels) names += ",Label,Product";
  if (hasGrid(h)) names += ",Row,Column";
  if (h.has_time) names += ",Time";
  if (h.has_channel) names += ",Channel";
  if (h.has_returns) names += ",ReturnNumber,NumberOfReturns";
  if (h.has_truth) names += ",TrueX,TrueY,TrueZ,TrueRange,Incidence,ReceivedPower,Flags";
  return names + "\n";
}

Result<void> Writer::begin(const ScanHeader& header) {
  if (header_) return failure(ErrorKind::internal, "a text file can hold only one scan", file_.file().string());
  if (auto checked = checkHeader(header); !checked) return checked;
  header_ = header;
  const bool all = kind_ == Kind::csv;
  listUnheld(header,
             kind_ == Kind::pts   ? "PTS"
             : kind_ == Kind::xyz ? "XYZ"
                                  : "CSV",
             {.labels = all, .time = all, .channel = all, .returns = all, .truth = all}, report_);
  if (all && header.has_labels) report_.warn(header.name, "CSV stores label numbers without names");
  if (kind_ == Kind::pts) text_ += countLine();
  if (kind_ == Kind::csv) text_ += columnNames();
  return {};
}

// Cyclone's integers in PTS; there and in XYZ intensity stands before the colours, which is how CloudCompare takes it.
void Writer::appendIntensity(float value) {
  if (kind_ != Kind::pts) return next(value);
  const double fraction = (value - header_->intensity_min) / (header_->intensity_max - header_->intensity_min);
  clamped_ += fraction < 0 || fraction > 1;
  next(std::lround(std::clamp(fraction, 0.0, 1.0) * 4095) - 2048);
}

void Writer::appendColumns(const PointBlock& b, std::size_t i) {
  const ScanHeader& h = *header_;
  if (h.has_labels) next(b.material[i]), next(b.product[i]);
  if (hasGrid(h)) next(b.row[i]), next(b.column[i]);
  if (h.has_time) next(b.time_s[i]);
  if (h.has_channel) next(unsigned{b.channel[i]});
  if (h.has_returns) next(unsigned{b.return_number[i]}), next(unsigned{b.return_count[i]});
  if (!h.has_truth) return;
  const PointTruth& t = b.truth;
  const Eigen::Vector3d p = truePose(h) * Eigen::Vector3d(t.x_m[i], t.y_m[i], t.z_m[i]);
  for (int axis = 0; axis < 3; ++axis) text_ += ',', appendFixed(text_, p[axis], kPlaceDecimals);
  next(t.range_m[i]), next(t.incidence_rad[i]), next(t.received_db[i]), next(unsigned{t.flags[i]});
}

void Writer::appendPoint(const PointBlock& b, std::size_t i) {
  const Eigen::Vector3d p = header_->file_from_scanner * Eigen::Vector3d(b.x_m[i], b.y_m[i], b.z_m[i]);
  const char between = kind_ == Kind::csv ? ',' : ' ';
  for (int axis = 0; axis < 3; ++axis) {
    if (axis > 0) text_ += between;
    appendFixed(text_, p[axis], kPlaceDecimals);
  }
  const bool intensity = hasIntensity(*header_);
  if (intensity && kind_ != Kind::csv) appendIntensity(b.intensity[i]);
  if (header_->has_colour)
    for (const std::uint8_t colour : {b.red[i], b.green[i], b.blue[i]}) next(unsigned{colour});
  if (intensity && kind_ == Kind::csv) appendIntensity(b.intensity[i]);
  if (kind_ == Kind::csv) appendColumns(b, i);
  text_ += '\n';
}

Result<void> Writer::flushFrom(std::size_t enough) {
  if (text_.size() < enough) return {};
  const auto appended = file_.append({reinterpret_cast<const std::uint8_t*>(text_.data()), text_.size()});
  text_.clear();
  return appended;
}

Result<void> Writer::write(const PointBlock& block) {
  if (!header_ || ended_) return failure(ErrorKind::internal, "points outside a scan", file_.file().string());
  if (block.size() == 0) return {};
  TRY(checkBlock(*header_, block));
  for (std::size_t i = 0; i < block.size(); ++i) {
    appendPoint(block, i);
    if (auto flushed = flushFrom(kBuffered); !flushed) return flushed;
  }
  points_ += block.size();
  return {};
}

Result<void> Writer::end() {
  if (!header_ || ended_)
    return failure(ErrorKind::internal, "a scan ends that was not started", file_.file().string());
  ended_ = true;
  if (clamped_ > 0)
    report_.lose(header_->name, std::to_string(clamped_) + " intensities outside the sensor's range were clamped");
  if (auto flushed = flushFrom(0); !flushed || kind_ != Kind::pts) return flushed;
  const std::string count = countLine();
  return file_.overwrite(0, {reinterpret_cast<const std::uint8_t*>(count.data()), count.size()});
}

Result<void> Writer::close() {
  if (!ended_) return failure(ErrorKind::unusable, "no complete scan to write", file_.file().string());
  return file_.commit();
}

Result<std::unique_ptr<CloudWriter>> create(const std::filesystem::path& file, Kind kind) {
  TRY_ASSIGN(auto part, PartFile::create(file));
  return std::make_unique<Writer>(std::move(part), kind);
}

}  // namespace

Result<std::unique_ptr<CloudWriter>> createPtsWriter(const std::filesystem::path& file) {
  return create(file, Kind::pts);
}
Result<std::unique_ptr<CloudWriter>> createXyzWriter(const std::filesystem::path& file) {
  return create(file, Kind::xyz);
}
Result<std::unique_ptr<CloudWriter>> createCsvWriter(const std::filesystem::path& file) {
  return create(file, Kind::csv);
}

}  // namespace standpoint::text_points
