// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/cloud.h"

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
  Cloud cloud{{}, maker_.header(), points_, colouringOf(points_, maker_.header().channels), {}, seen_};
  cloud.colours.reserve(cloud.points.size());
  for (const auto& p : cloud.points) cloud.colours.push_back(colourOf(p, p.position_m[2], cloud.colouring));
  return cloud;
}

Result<Cloud> sampleCloud(const std::filesystem::path& file, const Eigen::Vector3d& shift_m, std::uint64_t most,
                          Progress& progress) {
  const CloudFormat* format = cloudFormatFor(file);
  if (format == nullptr || format->read == nullptr)
    return failure(ErrorKind::unusable, "unsupported point-cloud format", file.string());
  TRY_ASSIGN(auto info, format->info(file));
  std::uint64_t points = 0;
  for (const auto& scan : info.scans) points += scan.points;
  CloudSampler sink(points / most + 1, most, shift_m);
  TRY(format->read(file, sink, progress));
  Cloud cloud = sink.coloured();
  cloud.file = file;
  return cloud;
}

void CloudLoader::start(const std::filesystem::path& file, const Eigen::Vector3d& shift_m, std::function<void()> wake) {
  task_.reset();
  task_ = std::make_unique<Task<Cloud>>(
      "Show " + file.filename().string(),
      [file, shift_m](Progress& progress) { return sampleCloud(file, shift_m, kMostShownPoints, progress); },
      std::move(wake));
}

std::optional<Result<Cloud>> CloudLoader::take() {
  if (!task_ || !task_->done()) return std::nullopt;
  auto cloud = task_->take();
  task_.reset();
  return cloud;
}

}  // namespace standpoint
