// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <optional>
#include <string>

#include "core/part_file.h"
#include "pointclouds/files/block_check.h"
#include "pointclouds/files/number_text.h"
#include "pointclouds/ptx/ptx.h"

namespace standpoint::ptx {
namespace {

constexpr std::size_t kBuffered = 1 << 20;
constexpr std::uint64_t kMostCells = std::uint64_t{1} << 32;  // ten times the largest instrument's grid
constexpr std::uint64_t kManyCells = std::uint64_t{1} << 28;  // a damaged header must not fill the disk

std::span<const std::uint8_t> bytesOf(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

void appendRow(std::string& text, const Eigen::Vector3d& v, const char* rest) {
  for (int i = 0; i < 3; ++i) {
    if (i > 0) text += ' ';
    appendNumber(text, v[i] + 0.0);  // no "-0"
  }
  text += rest;
}

// Always as long, so that a count that is known last can be put over it.
std::string countLine(std::uint64_t count) {
  const std::string digits = std::to_string(count);
  return std::string(10 - std::min<std::size_t>(digits.size(), 10), '0') + digits + "\n";
}

class Writer final : public CloudWriter {
 public:
  explicit Writer(PartFile file) : file_(std::move(file)) {}
  Result<void> begin(const ScanHeader& header) override;
  Result<void> write(const PointBlock& block) override;
  Result<void> end() override;
  Result<void> close() override;

 private:
  void appendHeader();
  void appendPoint(const PointBlock& block, std::size_t i);
  Result<void> fillTo(std::uint64_t cell);
  Result<void> flushFrom(std::size_t enough);

  PartFile file_;
  std::string text_;
  std::optional<ScanHeader> header_;
  std::uint64_t start_ = 0;      // of the scan, in the file
  std::uint64_t next_cell_ = 0;  // how many lines the scan has
  std::uint64_t points_ = 0;
  std::uint64_t crowded_ = 0;  // points that found their cell taken
  std::uint64_t clamped_ = 0;  // intensities outside the sensor's range
};

void Writer::appendHeader() {
  if (hasGrid(*header_))
    text_ += std::to_string(header_->columns) + "\n" + std::to_string(header_->rows) + "\n";
  else
    text_ += countLine(0) + "1\n";
  const Eigen::Matrix3d rotation = header_->file_from_scanner.rotation.normalized().toRotationMatrix();
  const Eigen::Vector3d& position = header_->file_from_scanner.translation;
  appendRow(text_, position, "\n");
  for (int axis = 0; axis < 3; ++axis) appendRow(text_, rotation.col(axis), "\n");
  for (int axis = 0; axis < 3; ++axis) appendRow(text_, rotation.col(axis), " 0\n");  // for row vectors
  appendRow(text_, position, " 1\n");
}

Result<void> Writer::begin(const ScanHeader& header) {
  if (header_) return failure(ErrorKind::internal, "a scan starts before the previous one has ended", header.name);
  if (auto checked = checkHeader(header); !checked) return checked;
  if (std::uint64_t{header.rows} * header.columns > kMostCells)
    return failure(ErrorKind::unusable, "the grid has too many cells for a PTX file", "scan " + header.name);
  if (auto flushed = flushFrom(0); !flushed) return flushed;
  start_ = file_.size();
  header_ = header;
  next_cell_ = points_ = crowded_ = clamped_ = 0;
  appendHeader();
  listUnheld(header, "PTX", {}, report_);
  return {};
}

Result<void> Writer::flushFrom(std::size_t enough) {
  if (text_.size() < enough) return {};
  const auto appended = file_.append(bytesOf(text_));
  text_.clear();
  return appended;
}

Result<void> Writer::fillTo(std::uint64_t cell) {
  if (cell > kManyCells && points_ < cell / 1000)
    return failure(ErrorKind::unusable,
                   "the grid is almost empty, so a PTX file would store gigabytes of missing points",
                   "scan " + header_->name);
  const char* missing = header_->has_colour ? "0 0 0 0.5 0 0 0\n" : "0 0 0 0.5\n";
  for (; next_cell_ < cell; ++next_cell_) {
    text_ += missing;
    if (auto flushed = flushFrom(kBuffered); !flushed) return flushed;
  }
  return {};
}

void Writer::appendPoint(const PointBlock& b, std::size_t i) {
  for (const float v : {b.x_m[i], b.y_m[i], b.z_m[i]}) {
    appendFloat(text_, v);
    text_ += ' ';
  }
  // A file without intensities says 0.5 for each of them.
  const double range = header_->intensity_max - header_->intensity_min;
  const double fraction = hasIntensity(*header_) ? (b.intensity[i] - header_->intensity_min) / range : 0.5;
  clamped_ += fraction < 0 || fraction > 1;
  appendFloat(text_, static_cast<float>(std::clamp(fraction, 0.0, 1.0)));
  if (header_->has_colour)
    for (const std::uint8_t colour : {b.red[i], b.green[i], b.blue[i]}) {
      text_ += ' ';
      appendNumber(text_, static_cast<unsigned>(colour));
    }
  text_ += '\n';
}

Result<void> Writer::write(const PointBlock& block) {
  if (!header_) return failure(ErrorKind::internal, "points outside a scan", file_.file().string());
  if (block.size() == 0) return {};
  TRY(checkBlock(*header_, block));
  const bool grid = hasGrid(*header_);
  for (std::size_t i = 0; i < block.size(); ++i) {
    const std::uint64_t cell = grid ? std::uint64_t{block.column[i]} * header_->rows + block.row[i] : next_cell_;
    if (cell + 1 == next_cell_) {
      ++crowded_;
      continue;
    }
    if (cell < next_cell_)
      return failure(ErrorKind::unusable, "PTX requires points column by column from bottom to top",
                     "scan " + header_->name + " column " + std::to_string(block.column[i]) + " row " +
                         std::to_string(block.row[i]));
    if (auto filled = fillTo(cell); !filled) return filled;
    appendPoint(block, i);
    ++points_;
    ++next_cell_;
    if (auto flushed = flushFrom(kBuffered); !flushed) return flushed;
  }
  return {};
}

Result<void> Writer::end() {
  if (!header_) return failure(ErrorKind::internal, "a scan ends that was not started", file_.file().string());
  if (hasGrid(*header_))
    if (auto filled = fillTo(std::uint64_t{header_->rows} * header_->columns); !filled) return filled;
  if (auto flushed = flushFrom(0); !flushed) return flushed;
  if (!hasGrid(*header_))
    if (auto counted = file_.overwrite(start_, bytesOf(countLine(next_cell_))); !counted) return counted;
  if (crowded_ > 0)
    report_.lose(header_->name, std::to_string(crowded_) + " additional returns dropped: a PTX cell holds one point");
  if (clamped_ > 0)
    report_.lose(header_->name, std::to_string(clamped_) + " intensities outside the sensor's range were clamped");
  header_.reset();
  return {};
}

Result<void> Writer::close() {
  if (header_) return failure(ErrorKind::internal, "the file is closed inside a scan", file_.file().string());
  return file_.commit();
}

}  // namespace

Result<std::unique_ptr<CloudWriter>> createWriter(const std::filesystem::path& file) {
  TRY_ASSIGN(auto part, PartFile::create(file));
  return std::make_unique<Writer>(std::move(part));
}

}  // namespace standpoint::ptx
