// SPDX-License-Identifier: GPL-3.0-or-later
// What another scan saw past was not there when that was made.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "core/portable_math.h"
#include "core/units.h"
#include "pointclouds/filters/filters.h"
#include "pointclouds/formats.h"
#include "pointclouds/statistics/cloud_sample.h"

namespace standpoint {
namespace {

constexpr double kFinest_rad = 0.05 * kRadPerDeg, kWithoutGrid_rad = 0.2 * kRadPerDeg;
constexpr double kSpacings = 1.2;  // of a scan's points in a cell

// Ranges about a scanner by direction: of each cell the shortest.
class RangeImage {
 public:
  RangeImage(const ScanHeader& header, const std::optional<double>& cell_rad)
      : station_(*stationOf(header)), file_from_scanner_(header.file_from_scanner) {
    double step = kWithoutGrid_rad;
    if (header.rows > 0 && header.columns > 0)
      step = kSpacings * std::max(kRadPerTurn / header.columns, kRadPerTurn / 2 / header.rows);
    step = cell_rad.value_or(std::max(step, kFinest_rad));
    columns_ = std::max(8, static_cast<int>(kRadPerTurn / step)), rows_ = std::max(4, columns_ / 2);
    nearest_m_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_),
                      std::numeric_limits<float>::infinity());
  }
  const Eigen::Vector3d& station() const { return station_; }

  void add(const PointBlock& block) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      const Eigen::Vector3d local(block.x_m[i], block.y_m[i], block.z_m[i]);
      const Eigen::Vector3d way = file_from_scanner_ * local - station_;
      const auto range = static_cast<float>(way.norm());
      if (!(range > 0)) continue;
      float& nearest = nearest_m_[cellOf(way)];
      nearest = std::min(nearest, range);
    }
  }

  // Is all that it saw in that direction and beside it farther than the place by more than a distance? In the direction
  // itself it saw something.
  bool sawPast(const Eigen::Vector3d& place, double distance_m) const {
    const Eigen::Vector3d way = place - station_;
    const double range = way.norm();
    if (!(range > 0)) return false;
    const std::size_t cell = cellOf(way);
    if (!std::isfinite(nearest_m_[cell])) return false;
    const int row = static_cast<int>(cell / static_cast<std::size_t>(columns_));
    const int column = static_cast<int>(cell % static_cast<std::size_t>(columns_));
    for (int r = std::max(0, row - 1); r <= std::min(rows_ - 1, row + 1); ++r)
      for (int c = -1; c <= 1; ++c) {
        const int beside = (column + c + columns_) % columns_;
        const std::size_t at =
            static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(beside);
        if (static_cast<double>(nearest_m_[at]) <= range + distance_m) return false;
      }
    return true;
  }

 private:
  std::size_t cellOf(const Eigen::Vector3d& way) const {
    const double across = std::sqrt(way.x() * way.x() + way.y() * way.y());
    const double column = (portable::turnOf(way.y(), way.x()) + 0.5) * columns_;
    const double row = (portable::turnOf(way.z(), across) * 2 + 0.5) * rows_;
    return static_cast<std::size_t>(std::clamp(static_cast<int>(row), 0, rows_ - 1)) *
               static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(std::clamp(static_cast<int>(column), 0, columns_ - 1));
  }

  Eigen::Vector3d station_;
  Pose file_from_scanner_;
  int columns_ = 0, rows_ = 0;
  std::vector<float> nearest_m_;
};

// Makes an image of each scan of a file.
class ImageSink final : public PointSink {
 public:
  explicit ImageSink(const std::optional<double>& cell_rad) : cell_rad_(cell_rad) {}
  Result<void> begin(const ScanHeader& header) override {
    open_ = stationOf(header).has_value();
    if (open_) images_.emplace_back(header, cell_rad_);
    return {};
  }
  Result<void> write(const PointBlock& block) override {
    if (open_) images_.back().add(block);
    return {};
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }
  std::vector<RangeImage> images_;

 private:
  std::optional<double> cell_rad_;
  bool open_ = false;
};

// Against another file, or each scan against the others of its own file.
class MovingFilter final : public PointFilter {
 public:
  explicit MovingFilter(const MovingOptions& options) : options_(options) {
    if (options.cell_deg) cell_rad_ = *options.cell_deg * kRadPerDeg;
  }

  Result<void> know(const FilterCloud& cloud) override {
    if (!options_.against) {
      if (cloud.scans.size() < 2)
        return failure(ErrorKind::unusable,
                       "one scan alone says nothing of what moved; name another with moving:against=FILE");
      return {};
    }
    const CloudFormat* format = cloudFormatFor(*options_.against);
    if (format == nullptr) return failure(ErrorKind::usage, "unknown cloud format", *options_.against);
    ImageSink sink(cell_rad_);
    TRY(format->read(*options_.against, sink, *cloud.progress));
    images_ = std::move(sink.images_);
    if (images_.empty())
      return failure(ErrorKind::unusable, "no scanner position: what it saw past is unknown", *options_.against);
    return {};
  }
  Result<void> beginScan(const ScanHeader& header) override {
    if (!stationOf(header))
      return failure(ErrorKind::unusable, "no scanner position: what it saw past is unknown", header.name);
    file_from_scanner_ = header.file_from_scanner;
    if (!options_.against && !judges_) images_.emplace_back(header, cell_rad_);
    return {};
  }
  Result<void> see(const PointBlock& block, std::uint64_t first, Remaining& remaining) override {
    if (!options_.against && !judges_) {
      images_.back().add(block);
      return {};
    }
    for (std::size_t i = 0; i < block.size(); ++i) {
      if (!remaining.has(first + i)) continue;
      const Eigen::Vector3d place = file_from_scanner_ * Eigen::Vector3d(block.x_m[i], block.y_m[i], block.z_m[i]);
      std::uint64_t votes = 0;
      for (std::size_t k = 0; k < images_.size() && votes < options_.votes; ++k)
        if ((options_.against || k != scan_) && images_[k].sawPast(place, options_.distance_m)) ++votes;
      if (votes >= options_.votes) remaining.take(first + i);
    }
    return {};
  }
  Result<void> endScan(Remaining&) override {
    ++scan_;
    return {};
  }
  Result<bool> endPass(Remaining&) override {
    scan_ = 0;
    return !options_.against && !std::exchange(judges_, true);
  }

 private:
  MovingOptions options_;
  std::optional<double> cell_rad_;
  std::size_t scan_ = 0;
  bool judges_ = false;
  Pose file_from_scanner_;
  std::vector<RangeImage> images_;
};

}  // namespace

MadeFilter makeMovingFilter(const MovingOptions& options) { return std::make_unique<MovingFilter>(options); }

}  // namespace standpoint
