// SPDX-License-Identifier: GPL-3.0-or-later
// Where rays of another time went through, nothing was then: seen_cells.h.
#include <algorithm>
#include <cmath>
#include <string>

#include "pointclouds/files/number_text.h"
#include "pointclouds/filters/filters.h"
#include "pointclouds/filters/seen_cells.h"
#include "pointclouds/formats.h"
#include "pointclouds/statistics/cloud_sample.h"

namespace standpoint {
namespace {

constexpr double kTooEarly_s = 1e-3;  // that a trajectory may begin or end before the points do

// Looks along the rays of another file.
class OtherRays final : public PointSink {
 public:
  explicit OtherRays(SeenCells& cells) : cells_(cells) {}
  Result<void> begin(const ScanHeader& header) override {
    station_ = stationOf(header);
    file_from_scanner_ = header.file_from_scanner;
    if (!station_)
      return failure(ErrorKind::unusable, "no scanner position: where its rays came from is unknown", header.name);
    return {};
  }
  Result<void> write(const PointBlock& b) override {
    rays_.clear();
    for (std::size_t i = 0; i < b.size(); ++i)
      rays_.push_back({*station_, file_from_scanner_ * Eigen::Vector3d(b.x_m[i], b.y_m[i], b.z_m[i])});
    cells_.look(rays_);
    return {};
  }
  Result<void> end() override {
    cells_.endSlice();
    return {};
  }
  Result<void> close() override { return {}; }

 private:
  SeenCells& cells_;
  Pose file_from_scanner_;
  std::optional<Eigen::Vector3d> station_;
  std::vector<SeenRay> rays_;
};

class SeenThroughFilter final : public PointFilter {
 public:
  explicit SeenThroughFilter(const SeenThroughOptions& options)
      : options_(options), cells_({options.cell_m, options.distance_m}) {}

  Result<void> know(const FilterCloud& cloud) override {
    carrier_ = cloud.carrier;
    progress_ = cloud.progress;
    if (options_.against && cloudFormatFor(*options_.against) == nullptr)
      return failure(ErrorKind::usage, "unknown cloud format", *options_.against);
    if (options_.trajectory && !carrier_)
      return failure(ErrorKind::usage, "the trajectory was not read", *options_.trajectory);
    if (!carrier_ && !options_.against && cloud.scans.size() < 2)
      return failure(ErrorKind::unusable,
                     "rays of one scan alone do not say what moved: use a file with several scans, name another with "
                     "seen-through:against=FILE, or the trajectory of a carried scan with "
                     "seen-through:trajectory=FILE");
    return {};
  }

  Result<void> beginScan(const ScanHeader& header) override {
    name_ = header.name;
    file_from_scanner_ = header.file_from_scanner;
    station_ = stationOf(header);
    slice_ = 0;
    if (carrier_ && !header.has_time)
      return failure(ErrorKind::unusable, "its points have no times; scan along a trajectory, or keep the time", name_);
    if (!carrier_ && !station_)
      return failure(ErrorKind::unusable,
                     "no scanner position: where its rays came from is unknown; of a carried scan name the trajectory "
                     "with seen-through:trajectory=FILE",
                     name_);
    return {};
  }

  Result<void> see(const PointBlock& block, std::uint64_t first, Remaining& remaining) override {
    for (std::size_t i = 0; i < block.size(); ++i) {
      if (!remaining.has(first + i)) continue;
      if (work_ == Work::judge) {
        if (cells_.hasMoved(placeOf(block, i))) remaining.take(first + i);
        continue;
      }
      if (carrier_) TRY(goOnTo(block.time_s[i]));
      const SeenRay ray{carrier_ ? originAt(block.time_s[i]) : *station_, placeOf(block, i)};
      if (!ray.to.allFinite()) continue;
      if (work_ == Work::look)
        rays_.push_back(ray);
      else if (!cells_.add(ray))
        return failure(ErrorKind::unusable,
                       "more than " + std::to_string(SeenCells::kMostCells) + " cells of " +
                           numberText(options_.cell_m) +
                           " m hold points; use larger ones: seen-through:cell=" + numberText(2 * options_.cell_m),
                       name_);
    }
    lookAtRays();
    return {};
  }

  Result<void> endScan(Remaining&) override {
    cells_.endSlice();
    return {};
  }

  Result<bool> endPass(Remaining&) override {
    if (work_ == Work::judge) return false;
    if (work_ == Work::gather) {
      cells_.settle();
      work_ = Work::look;
      return true;
    }
    if (options_.against) {
      OtherRays others(cells_);
      TRY(cloudFormatFor(*options_.against)->read(*options_.against, others, *progress_));
    }
    cells_.judge({options_.rays, options_.votes, options_.share});
    work_ = Work::judge;
    return true;
  }

 private:
  enum class Work { gather, look, judge };

  Eigen::Vector3d placeOf(const PointBlock& block, std::size_t i) const {
    return file_from_scanner_ * Eigen::Vector3d(block.x_m[i], block.y_m[i], block.z_m[i]);
  }
  Eigen::Vector3d originAt(double time_s) const {
    return carrier_->pose(carrier_->first_s() + time_s) * options_.lever_m;
  }

  // To the slice of a point's time; a point that is a slice late counts in this one.
  Result<void> goOnTo(double time_s) {
    const double length_s = carrier_->last_s() - carrier_->first_s();
    if (!(time_s >= -kTooEarly_s && time_s <= length_s + kTooEarly_s))
      return failure(ErrorKind::unusable,
                     "a point of " + numberText(time_s) + " s is not within the trajectory, which is " +
                         numberText(length_s) + " s long",
                     name_);
    const double slice = std::floor(time_s / options_.slice_s);
    if (slice < slice_ - 1)
      return failure(ErrorKind::unusable,
                     "its points are not in the order of their times: sort them, or use a longer seen-through:slice",
                     name_);
    if (slice <= slice_) return {};
    lookAtRays();
    cells_.endSlice();
    slice_ = slice;
    return {};
  }

  void lookAtRays() {
    cells_.look(rays_);
    rays_.clear();
  }

  SeenThroughOptions options_;
  PoseFunctionPtr carrier_;
  Progress* progress_ = nullptr;
  SeenCells cells_;
  Work work_ = Work::gather;
  std::string name_;
  Pose file_from_scanner_;
  std::optional<Eigen::Vector3d> station_;
  double slice_ = 0;  // its number
  std::vector<SeenRay> rays_;
};

}  // namespace

MadeFilter makeSeenThroughFilter(const SeenThroughOptions& options) {
  return std::make_unique<SeenThroughFilter>(options);
}

}  // namespace standpoint
