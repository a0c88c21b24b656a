// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/camera/panorama.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>

#include <jpeglib.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "scanners/camera/panorama_rays.h"
#include "scanners/instruments/chosen_effect.h"

namespace standpoint {
namespace {

using std::numbers::pi;
constexpr float kMiddleGrey = 0.18F;  // that an exposure brings the mean brightness to
constexpr float kAdaptation = 0.6F;   // how much of that it does: a dark wall stays darker than a white one
constexpr float kWarmth = 0.25F;      // more red and less blue, at the ends of a white balance
constexpr double kBlend_rad = 3 * pi / 180;

// How much a row counts for the exposure: its area, and what the metering makes of its place. Half of the weight lies
// within 14 degrees of the horizon, or above 52 degrees.
double meteredWeight(PictureMetering metering, double polar_rad) {
  const double area = std::sin(polar_rad);  // a row near a pole is short
  switch (metering) {
    case PictureMetering::even: break;
    case PictureMetering::horizon: return area * std::pow(std::sin(polar_rad), 6);
    case PictureMetering::zenith: return area * std::pow(std::max(0.0, std::cos(polar_rad)), 2);
  }
  return area;
}

// The exposure of each column, from the mean brightness of each shot: sectors of azimuth.
std::vector<float> exposures(const std::vector<Light>& pixels, std::uint32_t width, std::uint32_t height,
                             const PanoramaCamera& camera, PictureMetering metering) {
  const bool hdr = camera.hdr;
  const int shots = camera.shots;
  const auto given = static_cast<float>(std::exp2(camera.stops));
  if (!camera.metered) return std::vector<float>(width, given);
  const auto count = static_cast<std::size_t>(hdr ? 1 : std::max(1, shots));
  std::vector<double> sum(count, 0), weight(count, 0);
  for (std::uint32_t y = 0; y < height; ++y) {
    const double area = meteredWeight(metering, (y + 0.5) * pi / height);
    for (std::uint32_t x = 0; x < width; ++x) {
      const std::size_t shot = x * count / width;
      sum[shot] += area * static_cast<double>(pixels[std::size_t{y} * width + x].min(1).mean());
      weight[shot] += area;
    }
  }
  std::vector<float> gain;
  for (std::size_t k = 0; k < count; ++k)
    gain.push_back(
        given * std::clamp(std::pow(kMiddleGrey / std::max(0.01F, static_cast<float>(sum[k] / weight[k])), kAdaptation),
                           0.25F, 4.0F));
  std::vector<float> of_column(width);
  const double shot_wide = static_cast<double>(width) / static_cast<double>(count);
  const double blend = std::min(kBlend_rad * width / (2 * pi), 0.5 * shot_wide);
  for (std::uint32_t x = 0; x < width; ++x) {
    const std::size_t shot = std::min(count - 1, static_cast<std::size_t>(x / shot_wide));
    const double from = x + 0.5 - static_cast<double>(shot) * shot_wide, to = shot_wide - from;
    const std::size_t other = from < to ? (shot + count - 1) % count : (shot + 1) % count;
    const auto fraction = static_cast<float>(std::max(0.0, 0.5 - std::min(from, to) / blend));  // half at the seam
    of_column[x] = (1 - fraction) * gain[shot] + fraction * gain[other];
  }
  return of_column;
}

std::uint32_t shotsOf(const PanoramaCamera& camera) { return static_cast<std::uint32_t>(std::max(1, camera.shots)); }

// Of a shot's columns, traced some at once; those that are traced together are of one shot.
std::uint32_t firstOf(std::uint32_t shot, std::uint32_t shots, std::uint32_t width) {
  if (shot >= shots) return width;
  const auto first = static_cast<std::uint32_t>(std::uint64_t{shot} * width / shots);
  return (first + PanoramaRays::kAtOnce - 1) / PanoramaRays::kAtOnce * PanoramaRays::kAtOnce;
}

class ColouringSink final : public PointSink {
 public:
  ColouringSink(PointSink& to, std::shared_ptr<const Panorama> panorama) : to_(to), panorama_(std::move(panorama)) {}
  Result<void> begin(const ScanHeader& header) override {
    header_ = header;
    header_.has_colour = true;
    return to_.begin(header_);
  }
  Result<void> write(const PointBlock& block) override {
    coloured_ = block;
    for (auto* channel : {&coloured_.red, &coloured_.green, &coloured_.blue}) channel->resize(block.size());
    for (std::size_t i = 0; i < block.size(); ++i) {
      const auto& colour = panorama_->at({block.x_m[i], block.y_m[i], block.z_m[i]});
      coloured_.red[i] = colour[0], coloured_.green[i] = colour[1], coloured_.blue[i] = colour[2];
    }
    return to_.write(coloured_);
  }
  Result<void> picture(const StationPicture& picture) override { return to_.picture(picture); }
  Result<void> end() override {
    TRY_ASSIGN(auto picture,
               pictureOf(*panorama_, header_, header_.acquisition_start_gps_s + header_.acquisition_seconds));
    if (auto given = to_.picture(picture); !given) return given;
    return to_.end();
  }
  Result<void> close() override { return to_.close(); }

 private:
  PointSink& to_;
  std::shared_ptr<const Panorama> panorama_;
  ScanHeader header_;
  PointBlock coloured_;
};

}  // namespace

const std::array<std::uint8_t, 3>& Panorama::at(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d p = point - camera_m;
  const double azimuth = std::atan2(p.y(), p.x()), elevation = std::atan2(p.z(), std::hypot(p.x(), p.y()));
  const auto cell = [](double at, std::uint32_t size) {
    return static_cast<std::size_t>(std::clamp(at * size, 0.0, static_cast<double>(size) - 1));
  };
  return pixels[cell(0.5 - elevation / pi, height) * width + cell(0.5 - azimuth / (2 * pi), width)];
}

PictureMetering meteringOf(const Instrument& instrument, const SettingValues& values) {
  return static_cast<PictureMetering>(
      static_cast<int>(chosenEffect(instrument, values, "picture_metering").value_or(0)));
}

Result<Panorama> takePanorama(const RayScene& scene, const Instrument& instrument, const Pose& local_from_scanner,
                              int threads, Report& report, Progress& progress, PictureMetering metering,
                              const PictureTimes& times) {
  Panorama panorama;
  panorama.width = instrument.camera.columns;
  panorama.height = panorama.width / 2;
  panorama.camera_m = {0, 0, instrument.camera.offset_up_m};
  const std::uint32_t width = panorama.width, height = panorama.height;
  const PanoramaRays rays(static_cast<const EmbreeScene&>(scene),
                          {local_from_scanner.rotation, local_from_scanner * panorama.camera_m}, width,
                          instrument.camera.flash, report);
  std::vector<Light> light(std::size_t{width} * height);
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  const auto forEachRow = [&](const auto& work) {
    arena.execute([&] {
      tbb::parallel_for(std::uint32_t{0}, height, [&](std::uint32_t y) {
        if (!progress.cancelled()) work(y, std::size_t{y} * width);
      });
    });
  };
  // Shot by shot, as where bodies get is worked out for a short time.
  const std::uint32_t shots = shotsOf(instrument.camera);
  tbb::enumerable_thread_specific<TimedScene> in_motion([&] { return rays.inMotion(); });
  std::atomic<std::uint32_t> rows_done{0};
  for (std::uint32_t shot = 0; shot < shots; ++shot) {
    const double time_s = times.begins_s + times.lasts_s * (shot + 0.5) / shots;
    const std::uint32_t end = firstOf(shot + 1, shots, width);
    forEachRow([&](std::uint32_t y, std::size_t at) {
      TimedScene& timed = in_motion.local();
      for (std::uint32_t x = firstOf(shot, shots, width); x < end; x += PanoramaRays::kAtOnce)
        rays.trace(y, x, time_s, timed, &light[at + x]);
      progress.advance(static_cast<double>(++rows_done) / height / shots);
    });
  }
  TRY(progress.check());
  const std::vector<float> exposure = exposures(light, width, height, instrument.camera, metering);
  const auto warmth = static_cast<float>(instrument.camera.warmth);
  const Light balance(1 + kWarmth * warmth, 1, 1 - kWarmth * warmth);
  panorama.pixels.resize(light.size());
  forEachRow([&](std::uint32_t, std::size_t at) {
    for (std::size_t x = 0; x < width; ++x) {
      const Light l = light[at + x] * balance * exposure[x];
      panorama.pixels[at + x] = {srgbOf(l[0]), srgbOf(l[1]), srgbOf(l[2])};
    }
  });
  TRY(progress.check());
  return panorama;
}

Result<StationPicture> pictureOf(const Panorama& panorama, const ScanHeader& header, double acquired_gps_s) {
  StationPicture picture;
  picture.name = header.name + " panorama";
  picture.media_type = "image/jpeg";
  picture.width = panorama.width, picture.height = panorama.height;
  picture.pixel_width = 2 * pi / panorama.width, picture.pixel_height = pi / panorama.height;
  picture.file_from_camera = {header.file_from_scanner.rotation, header.file_from_scanner * panorama.camera_m};
  picture.acquired_gps_s = acquired_gps_s;
  // libjpeg's own handler ends the program on an error; writing into memory, all that can fail is the memory itself.
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &bytes, &size);
  jpeg.image_width = panorama.width, jpeg.image_height = panorama.height;
  jpeg.input_components = 3, jpeg.in_color_space = JCS_RGB;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, 90, TRUE);
  jpeg_start_compress(&jpeg, TRUE);
  while (jpeg.next_scanline < jpeg.image_height) {
    auto* row = const_cast<JSAMPROW>(panorama.pixels[std::size_t{jpeg.next_scanline} * panorama.width].data());
    jpeg_write_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  picture.bytes.assign(bytes, bytes + size);
  std::free(bytes);
  return picture;
}

std::unique_ptr<PointSink> colouring(PointSink& sink, std::shared_ptr<const Panorama> panorama) {
  return std::make_unique<ColouringSink>(sink, std::move(panorama));
}

}  // namespace standpoint
