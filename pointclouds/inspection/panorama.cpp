// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/inspection/panorama.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "pointclouds/formats.h"
#include "pointclouds/statistics/cloud_sample.h"

namespace standpoint {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

class PanoramaSink final : public PointSink {
 public:
  PanoramaSink(Panorama& panorama, std::optional<std::size_t> wanted) : panorama_(panorama), wanted_(wanted) {}
  Result<void> begin(const ScanHeader& header) override {
    const bool stands = stationOf(header).has_value();
    panorama_.scans.push_back(header.name);
    taking_ = !found_ && (wanted_ ? panorama_.scans.size() == *wanted_ + 1 : stands);
    if (!taking_) return {};
    found_ = true;
    stands_ = stands;
    panorama_.scan = panorama_.scans.size() - 1;
    panorama_.file_from_scanner = header.file_from_scanner;
    panorama_.has_intensity = header.intensity_max > header.intensity_min;
    const auto pixels = static_cast<std::size_t>(panorama_.width) * static_cast<std::size_t>(panorama_.height);
    panorama_.range_m.assign(pixels, 0);
    panorama_.intensity.assign(pixels, kNone);
    if (header.has_colour) panorama_.colour.assign(pixels, {0, 0, 0});
    return {};
  }
  Result<void> write(const PointBlock& block) override {
    if (!taking_) return {};
    panorama_.points += block.size();
    for (std::size_t i = 0; i < block.size(); ++i) {
      const Eigen::Vector3d p(block.x_m[i], block.y_m[i], block.z_m[i]);
      const auto range_m = static_cast<float>(p.norm());
      if (range_m <= 0) continue;
      const Eigen::Vector2i pixel = panorama_.pixel(p);
      const std::size_t at = panorama_.at(pixel.x(), pixel.y());
      float& nearest = panorama_.range_m[at];
      if (nearest > 0 && nearest <= range_m) continue;
      nearest = range_m;
      if (panorama_.has_intensity) panorama_.intensity[at] = block.intensity[i];
      if (!panorama_.colour.empty()) panorama_.colour[at] = {block.red[i], block.green[i], block.blue[i]};
    }
    return {};
  }
  Result<void> end() override {
    taking_ = false;
    return {};
  }
  Result<void> close() override { return {}; }
  bool found() const { return found_; }
  bool stands() const { return stands_; }

 private:
  Panorama& panorama_;
  std::optional<std::size_t> wanted_;
  bool taking_ = false, found_ = false, stands_ = false;
};

// The pixels are somewhat fewer than the points, so that few stay empty.
Result<int> fittingWidth(const CloudFormat& format, const std::filesystem::path& file,
                         std::optional<std::size_t> scan) {
  TRY_ASSIGN(const auto info, format.info(file));
  std::uint64_t points = 0;
  for (std::size_t i = 0; i < info.scans.size(); ++i)
    if (!scan || i == *scan) points = std::max(points, info.scans[i].points);
  return std::clamp(static_cast<int>(0.8 * std::sqrt(2 * static_cast<double>(points))) / 2 * 2, 256, 3072);
}

}  // namespace

Eigen::Vector3d Panorama::direction(int x, int y) const {
  const double azimuth = kPi - (x + 0.5) / width * 2 * kPi, elevation = kPi / 2 - (y + 0.5) / height * kPi;
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}

Eigen::Vector2i Panorama::pixel(const Eigen::Vector3d& direction) const {
  const double azimuth = std::atan2(direction.y(), direction.x());
  const double elevation = std::atan2(direction.z(), direction.head<2>().norm());
  return {std::clamp(static_cast<int>((kPi - azimuth) / (2 * kPi) * width), 0, width - 1),
          std::clamp(static_cast<int>((kPi / 2 - elevation) / kPi * height), 0, height - 1)};
}

std::optional<Eigen::Vector3d> Panorama::point(int x, int y) const {
  if (x < 0 || y < 0 || x >= width || y >= height || range_m[at(x, y)] <= 0) return std::nullopt;
  return file_from_scanner * (direction(x, y) * static_cast<double>(range_m[at(x, y)]));
}

Result<Panorama> readPanorama(const std::filesystem::path& file, const PanoramaOptions& options, Progress& progress) {
  const CloudFormat* const format = readableCloudFormat(file);
  if (format == nullptr || format->read == nullptr)
    return failure(ErrorKind::usage, "unsupported point-cloud format", file.string());
  Panorama panorama;
  panorama.width = options.width;
  if (panorama.width == 0) {
    TRY_ASSIGN(panorama.width, fittingWidth(*format, file, options.scan));
  }
  panorama.height = panorama.width / 2;
  PanoramaSink sink(panorama, options.scan);
  TRY_ASSIGN(panorama.report, format->read(file, sink, progress));
  if (!sink.found() && options.scan)
    return failure(ErrorKind::unusable, "the file has no scan " + std::to_string(*options.scan + 1), file.string());
  if (!sink.found() || !sink.stands())
    return failure(ErrorKind::unusable, "no scanner position in the file: a panorama needs one", file.string());
  if (panorama.points == 0) return failure(ErrorKind::unusable, "the scan is empty", file.string());
  return panorama;
}

PanoramaShades shadesOf(const Panorama& panorama, PanoramaChannel channel) {
  PanoramaShades shades;
  const bool range = channel == PanoramaChannel::range;
  shades.shade.assign(panorama.range_m.size(), kNone);
  for (std::size_t i = 0; i < shades.shade.size(); ++i)
    if (panorama.range_m[i] > 0) shades.shade[i] = range ? panorama.range_m[i] : panorama.intensity[i];
  std::vector<float> values;
  std::copy_if(shades.shade.begin(), shades.shade.end(), std::back_inserter(values),
               [](float x) { return !std::isnan(x); });
  if (values.empty()) return shades;
  const auto at = [&](double fraction) {
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return static_cast<double>(*place);
  };
  shades.low = at(0.02);
  shades.high = at(0.98);
  const double span = std::max(shades.high - shades.low, 1e-12);
  for (auto& shade : shades.shade)
    shade = std::isnan(shade) ? kNone : static_cast<float>(std::clamp((shade - shades.low) / span, 0.0, 1.0));
  return shades;
}

}  // namespace standpoint
