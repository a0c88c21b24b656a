// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/cloud.h"

#include <algorithm>
#include <cmath>

#include "pointclouds/formats.h"

namespace standpoint {

namespace {

constexpr std::uint64_t kMostShown = 600000;   // what software rendering still turns smoothly

class SampleSink : public PointSink {
 public:
  SampleSink(Cloud& cloud, std::uint64_t step, const Eigen::Vector3d& shift_m) : cloud_(cloud), step_(step), shift_m_(shift_m) {}

  Result<void> begin(const ScanHeader& header) override {
    pose_ = header.file_from_scanner;
    pose_.translation -= shift_m_;
    low_ = header.intensity_min;
    span_ = std::max(header.intensity_max - header.intensity_min, 1e-12);
    return {};
  }

  Result<void> write(const PointBlock& block) override {
    const bool coloured = block.red.size() == block.size();
    for (std::size_t i = (step_ - seen_ % step_) % step_; i < block.size(); i += step_) {
      const Eigen::Vector3d p = pose_ * Eigen::Vector3d(block.x_m[i], block.y_m[i], block.z_m[i]);
      for (int k = 0; k < 3; ++k) cloud_.positions.push_back(static_cast<float>(p[k]));
      const double share = i < block.intensity.size() ? (block.intensity[i] - low_) / span_ : 0.5;
      const auto grey = static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0)));
      if (coloured)
        cloud_.colours.push_back({shade(block.red[i], grey), shade(block.green[i], grey), shade(block.blue[i], grey), 255});
      else
        cloud_.colours.push_back({grey, grey, grey, 255});
    }
    seen_ += block.size();
    return {};
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }

 private:
  // A colour alone shows no form: part of the intensity is mixed in.
  static std::uint8_t shade(std::uint8_t colour, std::uint8_t grey) { return static_cast<std::uint8_t>(colour * (96 + grey * 159 / 255) / 255); }

  Cloud& cloud_;
  std::uint64_t step_, seen_ = 0;
  Eigen::Vector3d shift_m_;
  Pose pose_;
  double low_ = 0, span_ = 1;
};

}  // namespace

Result<Cloud> sampleCloud(const std::filesystem::path& file, const Eigen::Vector3d& shift_m, std::uint64_t most, Progress& progress) {
  const CloudFormat* format = cloudFormatFor(file);
  if (format == nullptr || format->read == nullptr) return failure(ErrorKind::unusable, "this kind of cloud cannot be read", file.string());
  auto info = format->info(file);
  if (!info) return failure(info.error());
  Cloud cloud;
  cloud.file = file;
  for (const auto& scan : info->scans) cloud.points_in_file += scan.points;
  SampleSink sink(cloud, cloud.points_in_file / most + 1, shift_m);
  auto report = format->read(file, sink, progress);
  if (!report) return failure(report.error());
  return cloud;
}

CloudLoader::~CloudLoader() { stop(); }

void CloudLoader::stop() {
  if (progress_) progress_->cancel();
  if (worker_.joinable()) worker_.join();
}

void CloudLoader::start(const std::filesystem::path& file, const Eigen::Vector3d& shift_m, std::function<void()> wake) {
  stop();
  progress_ = std::make_unique<Progress>();
  done_.store(false);
  worker_ = std::thread([this, file, shift_m, wake = std::move(wake)] {
    result_ = sampleCloud(file, shift_m, kMostShown, *progress_);
    done_.store(true);
    if (wake) wake();
  });
}

std::optional<Result<Cloud>> CloudLoader::take() {
  if (!worker_.joinable() || !done_.load()) return std::nullopt;
  worker_.join();
  return std::move(result_);
}

}  // namespace standpoint
