// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/cloud.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "editor/words/words.h"
#include "pointclouds/formats.h"

namespace standpoint {

namespace {

// A colour alone shows no form: part of the intensity is mixed in.
std::uint8_t greyed(std::uint8_t colour, std::uint8_t grey) {
  return static_cast<std::uint8_t>(colour * (96 + grey * 159 / 255) / 255);
}

}  // namespace

Result<void> CloudSampler::begin(const ScanHeader& header) {
  pose_ = header.file_from_scanner;
  pose_.translation -= shift_m_;
  low_ = header.intensity_min;
  span_ = header.intensity_max - header.intensity_min;
  coloured_ = header.has_colour;
  return {};
}

Result<void> CloudSampler::write(const PointBlock& block) {
  for (std::uint64_t i = (step_ - seen_ % step_) % step_; i < block.size(); i += step_) {
    const Eigen::Vector3d p = pose_ * Eigen::Vector3d(block.x_m[i], block.y_m[i], block.z_m[i]);
    for (int k = 0; k < 3; ++k) positions_.push_back(static_cast<float>(p[k]));
    fractions_.push_back(span_ > 0 ? static_cast<float>((block.intensity[i] - low_) / span_) : NAN);
    if (coloured_)
      colours_.push_back({block.red[i], block.green[i], block.blue[i], 255});
    else
      colours_.push_back({255, 255, 255, 255});
  }
  seen_ += block.size();
  while (colours_.size() > most_) halve();
  return {};
}

void CloudSampler::halve() {
  const std::size_t kept = (colours_.size() + 1) / 2;
  for (std::size_t i = 0; i < kept; ++i) {
    std::copy_n(positions_.begin() + static_cast<std::ptrdiff_t>(6 * i), 3,
                positions_.begin() + static_cast<std::ptrdiff_t>(3 * i));
    fractions_[i] = fractions_[2 * i];
    colours_[i] = colours_[2 * i];
  }
  positions_.resize(3 * kept);
  fractions_.resize(kept);
  colours_.resize(kept);
  step_ *= 2;
}

Cloud CloudSampler::shaded() const {
  Cloud cloud{{}, positions_, colours_, seen_};
  auto fractions = fractions_;
  if (std::all_of(fractions.begin(), fractions.end(), [](float s) { return std::isnan(s); }))
    for (std::size_t i = 0; i < fractions.size(); ++i) fractions[i] = positions_[3 * i + 2];
  std::vector<float> sorted;
  std::copy_if(fractions.begin(), fractions.end(), std::back_inserter(sorted), [](float s) { return !std::isnan(s); });
  if (sorted.empty()) return cloud;
  const auto at = [&](double fraction) {
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(sorted.size() - 1));
    std::nth_element(sorted.begin(), middle, sorted.end());
    return *middle;
  };
  const float low = at(0.02), high = at(0.98), span = std::max(high - low, 1e-12F);
  for (std::size_t i = 0; i < fractions.size(); ++i) {
    const float fraction = std::isnan(fractions[i]) ? 0.5F : std::clamp((fractions[i] - low) / span, 0.0F, 1.0F);
    const auto grey = static_cast<std::uint8_t>(std::lround(40 + 215 * fraction));
    for (std::size_t k = 0; k < 3; ++k) cloud.colours[i][k] = greyed(cloud.colours[i][k], grey);
  }
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
  Cloud cloud = sink.shaded();
  cloud.file = file;
  return cloud;
}

void CloudLoader::start(const std::filesystem::path& file, const Eigen::Vector3d& shift_m, std::function<void()> wake) {
  task_.reset();
  task_ = std::make_unique<Task<Cloud>>(
      trf("Show {}", file.filename().string()),
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
