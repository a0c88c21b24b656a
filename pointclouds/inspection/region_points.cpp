// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/inspection/region_points.h"

#include <algorithm>
#include <limits>

#include "pointclouds/formats.h"
#include "pointclouds/statistics/cloud_sample.h"
#include "pointclouds/statistics/coverage.h"

namespace standpoint {

namespace {

class RegionSink final : public PointSink {
 public:
  RegionSink(RegionPoints& region, const Ball& ball, std::size_t most)
      : region_(region), ball_(ball), most_(std::max<std::size_t>(2, most)) {}
  Result<void> begin(const ScanHeader& header) override {
    pose_ = header.file_from_scanner;
    stands_ = stationOf(header).has_value();
    return {};
  }
  Result<void> write(const PointBlock& block) override {
    for (std::size_t i = 0; i < block.size(); ++i) {
      const Eigen::Vector3d in_scanner(block.x_m[i], block.y_m[i], block.z_m[i]);
      const Eigen::Vector3d place = pose_ * in_scanner;
      ++region_.read;
      if ((place - ball_.centre).squaredNorm() > ball_.radius_m * ball_.radius_m) continue;
      const std::uint64_t hash = mixed(region_.inside++);
      if (hash > limit_) continue;
      const double range_m = in_scanner.norm();
      Eigen::Vector3d beam = Eigen::Vector3d::Zero();
      if (stands_ && range_m > 0) beam = pose_.rotation * in_scanner / range_m;
      region_.points.push_back({place, beam});
      hash_.push_back(hash);
      if (hash_.size() > most_) halve();
    }
    return {};
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }

 private:
  void halve() {
    limit_ /= 2;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < hash_.size(); ++i) {
      if (hash_[i] > limit_) continue;
      hash_[kept] = hash_[i];
      region_.points[kept++] = region_.points[i];
    }
    hash_.resize(kept);
    region_.points.resize(kept);
  }

  RegionPoints& region_;
  Ball ball_;
  std::size_t most_;
  std::uint64_t limit_ = std::numeric_limits<std::uint64_t>::max();
  std::vector<std::uint64_t> hash_;
  Pose pose_;
  bool stands_ = false;
};

}  // namespace

Result<RegionPoints> readRegion(const std::filesystem::path& file, const Ball& ball, Progress& progress,
                                std::size_t most) {
  const CloudFormat* const format = readableCloudFormat(file);
  if (format == nullptr || format->read == nullptr)
    return failure(ErrorKind::usage, "unsupported point-cloud format", file.string());
  RegionPoints region;
  RegionSink sink(region, ball, most);
  TRY_ASSIGN(region.report, format->read(file, sink, progress));
  return region;
}

}  // namespace standpoint
