// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clouds/cloud.h"

#include <tbb/parallel_for.h>

#include "pointclouds/formats.h"

namespace standpoint {

Result<void> CloudSampler::begin(const ScanHeader& header) {
  maker_.begin(header);
  return {};
}

Result<void> CloudSampler::write(const PointBlock& block) {
  for (std::uint64_t i = (step_ - seen_ % step_) % step_; i < block.size(); i += step_)
    points_.push_back(maker_.make(block, i));
  maker_.count(block.size());
  seen_ += block.size();
  while (points_.size() > most_) halve();
  return {};
}

void CloudSampler::halve() {
  const std::size_t kept = (points_.size() + 1) / 2;
  for (std::size_t i = 0; i < kept; ++i) points_[i] = points_[2 * i];
  points_.resize(kept);
  step_ *= 2;
}

Cloud CloudSampler::coloured() const {
  Cloud cloud{.header = maker_.header(),
              .shift_m = maker_.header().origin_m,
              .points = points_,
              .colouring = colouringOf(points_, maker_.header().channels),
              .points_in_file = seen_};
  cloud.colours.reserve(cloud.points.size());
  for (const auto& p : cloud.points) cloud.colours.push_back(colourOf(p, p.position_m[2], cloud.colouring));
  return cloud;
}

Result<std::uint64_t> pointsIn(std::span<const std::filesystem::path> files) {
  std::uint64_t points = 0;
  for (const auto& file : files) {
    const CloudFormat* format = cloudFormatFor(file);
    if (format == nullptr || format->read == nullptr)
      return failure(ErrorKind::unusable, "unsupported point-cloud format", file.string());
    TRY_ASSIGN(const auto info, format->info(file));
    for (const auto& scan : info.scans) points += scan.points;
  }
  return points;
}

Result<Cloud> sampleCloud(std::span<const std::filesystem::path> files, std::uint64_t points,
                          const Eigen::Vector3d& shift_m, std::uint64_t most, Progress& progress) {
  CloudSampler sink(points / most + 1, most, shift_m);
  std::vector<std::filesystem::path> of_scans;
  for (const auto& file : files) {
    TRY(cloudFormatFor(file)->read(file, sink, progress));
    of_scans.resize(sink.scans(), file);
  }
  Cloud cloud = sink.coloured();
  if (files.size() == 1)
    cloud.file = files.front();
  else
    cloud.files = std::move(of_scans);
  return cloud;
}

void move(std::span<CloudPoint> points, const Eigen::Vector3d& origin_m, std::span<const Pose> moves) {
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
    auto& p = points[i].position_m;
    if (points[i].station >= moves.size()) return;
    const Eigen::Vector3d place = moves[points[i].station] * (Eigen::Vector3d(p[0], p[1], p[2]) + origin_m) - origin_m;
    for (Eigen::Index k = 0; k < 3; ++k) p[static_cast<std::size_t>(k)] = static_cast<float>(place[k]);
  });
}

Cloud moved(const Cloud& cloud, std::vector<Pose> moves) {
  Cloud other = cloud;
  Pose local_from_file;
  local_from_file.translation = -cloud.shift_m;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    auto& pose = other.header.stations.at(i).file_from_scanner;
    pose = inverse(local_from_file) * moves[i] * local_from_file * pose;
  }
  move(other.points, cloud.pointsOrigin_m(), moves);
  other.moves = std::move(moves);
  return other;
}

}  // namespace standpoint
