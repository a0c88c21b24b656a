// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/cloud.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "pointclouds/formats.h"

namespace standpoint {

namespace {

// A colour alone shows no form: part of the intensity is mixed in.
std::uint8_t shaded(std::uint8_t colour, std::uint8_t grey) {
  return static_cast<std::uint8_t>(colour * (96 + grey * 159 / 255) / 255);
}

class SampleSink : public PointSink {
 public:
  SampleSink(Cloud& cloud, std::uint64_t step, const Eigen::Vector3d& shift_m) : cloud_(cloud), step_(step), shift_m_(shift_m) {}

  Result<void> begin(const ScanHeader& header) override {
    pose_ = header.file_from_scanner;
    pose_.translation -= shift_m_;
    low_ = header.intensity_min;
    span_ = header.intensity_max - header.intensity_min;
    coloured_ = header.has_colour;
    return {};
  }

  Result<void> write(const PointBlock& block) override {
    for (std::uint64_t i = (step_ - seen_ % step_) % step_; i < block.size(); i += step_) {
      const Eigen::Vector3d p = pose_ * Eigen::Vector3d(block.x_m[i], block.y_m[i], block.z_m[i]);
      for (int k = 0; k < 3; ++k) cloud_.positions.push_back(static_cast<float>(p[k]));
      shares_.push_back(span_ > 0 ? static_cast<float>((block.intensity[i] - low_) / span_) : NAN);
      if (coloured_)
        cloud_.colours.push_back({block.red[i], block.green[i], block.blue[i], 255});
      else
        cloud_.colours.push_back({255, 255, 255, 255});
    }
    seen_ += block.size();
    return {};
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }

  // Shades the colours by intensity, from what nearly all points have at least to what nearly all have at most: formats
  // state the sensor's possible range, of which a scan fills a corner. Without any intensity height stands for it.
  void shade() {
    if (std::all_of(shares_.begin(), shares_.end(), [](float s) { return std::isnan(s); }))
      for (std::size_t i = 0; i < shares_.size(); ++i) shares_[i] = cloud_.positions[3 * i + 2];
    std::vector<float> sorted;
    std::copy_if(shares_.begin(), shares_.end(), std::back_inserter(sorted), [](float s) { return !std::isnan(s); });
    if (sorted.empty()) return;
    const auto at = [&](double share) {
      const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(sorted.size() - 1));
      std::nth_element(sorted.begin(), middle, sorted.end());
      return *middle;
    };
    const float low = at(0.02), high = at(0.98), span = std::max(high - low, 1e-12F);
    for (std::size_t i = 0; i < shares_.size(); ++i) {
      const float share = std::isnan(shares_[i]) ? 0.5F : std::clamp((shares_[i] - low) / span, 0.0F, 1.0F);
      const auto grey = static_cast<std::uint8_t>(std::lround(40 + 215 * share));
      for (std::size_t k = 0; k < 3; ++k) cloud_.colours[i][k] = shaded(cloud_.colours[i][k], grey);
    }
  }

 private:
  Cloud& cloud_;
  std::uint64_t step_, seen_ = 0;
  Eigen::Vector3d shift_m_;
  Pose pose_;
  double low_ = 0, span_ = 1;
  bool coloured_ = false;
  std::vector<float> shares_;
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
  sink.shade();
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
    result_ = sampleCloud(file, shift_m, kMostShownPoints, *progress_);
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
