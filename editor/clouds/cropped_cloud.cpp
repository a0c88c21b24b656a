// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clouds/cropped_cloud.h"

#include <algorithm>

#include "pointclouds/formats.h"

namespace standpoint {

namespace {

class CropSink final : public PointSink {
 public:
  CropSink(const CropShape& shape, const Eigen::Vector3d& shift_m, std::uint64_t most)
      : shape_(shape), shift_m_(shift_m), most_(most), maker_(shift_m) {}
  void expect(const PosedScan& scan) { expected_ = scan; }
  Result<void> begin(const ScanHeader& header) override {
    left_out_ = !expected_.scan.empty() && header.name != expected_.scan;
    if (left_out_) return {};
    ScanHeader posed = header;
    if (expected_.local_from_scanner) {
      posed.file_from_scanner = *expected_.local_from_scanner;
      posed.file_from_scanner.translation += shift_m_;
    }
    maker_.begin(posed);
    return {};
  }
  Result<void> write(const PointBlock& block) override {
    if (left_out_) return {};
    for (std::size_t i = 0; i < block.size(); ++i) {
      const Eigen::Vector3d place = maker_.place_m(block, i);
      if (!shape_.keeps(place) || inside_++ % step_ != 0) continue;
      points_.push_back(maker_.make(block, i, place));
      if (points_.size() > most_) halve();
    }
    maker_.count(block.size());
    return {};
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }

  Cloud cloud() {
    Cloud cloud{
        .header = maker_.header(), .shift_m = shift_m_, .points = std::move(points_), .points_in_file = inside_};
    return cloud;
  }

 private:
  void halve() {
    const std::size_t kept = (points_.size() + 1) / 2;
    for (std::size_t i = 0; i < kept; ++i) points_[i] = points_[2 * i];
    points_.resize(kept);
    step_ *= 2;
  }
  CropShape shape_;
  Eigen::Vector3d shift_m_;
  std::uint64_t most_, inside_ = 0, step_ = 1;
  CloudPointMaker maker_;
  PosedScan expected_;
  bool left_out_ = false;  // the scan that is being read
  std::vector<CloudPoint> points_;
};

void recolour(Cloud& cloud, const CloudColouring& colouring) {
  cloud.colouring = colouring;
  cloud.colours.clear();
  cloud.colours.reserve(cloud.points.size());
  for (const auto& p : cloud.points) cloud.colours.push_back(colourOf(p, p.position_m[2], colouring));
}

}  // namespace

bool CropShape::keeps(const Eigen::Vector3d& local) const {
  const Eigen::Vector3d off = local - centre;
  return off.squaredNorm() <= radius_m * radius_m && (!slice || std::abs(slice->dot(off)) <= half_slice_m);
}

Result<Cloud> croppedCloud(std::span<const PosedScan> scans, const CropShape& shape, const Eigen::Vector3d& shift_m,
                           std::uint64_t most, Progress& progress) {
  CropSink sink(shape, shift_m, most);
  for (const auto& scan : scans) {
    const CloudFormat* format = readableCloudFormat(scan.file);
    if (format == nullptr) return failure(ErrorKind::unusable, "unsupported point-cloud format", scan.file.string());
    sink.expect(scan);
    TRY(format->read(scan.file, sink, progress));
  }
  Cloud cloud = sink.cloud();
  recolour(cloud, colouringOf(cloud.points, cloud.header.channels));
  return cloud;
}

void colourAlike(Cloud& one, Cloud& other) {
  std::vector<CloudPoint> both = one.points;
  both.insert(both.end(), other.points.begin(), other.points.end());
  const auto colouring = colouringOf(both, one.header.channels & other.header.channels);
  recolour(one, colouring);
  recolour(other, colouring);
}

void highlight(Cloud& cloud, std::uint8_t flags) {
  constexpr PointColour kStandsOut = {255, 140, 20, 255};
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    if ((cloud.points[i].flags & flags) != 0) cloud.colours[i] = kStandsOut;
}

}  // namespace standpoint
