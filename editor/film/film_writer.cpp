// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/film/film_writer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

extern "C" {
#include <x264.h>
}

#include <fmt/format.h>

#include "editor/film/mp4_file.h"

namespace standpoint {

namespace {

constexpr std::uint32_t kRateBase = 1000;
constexpr double kKeyEvery_s = 2;  // as far as a player has to decode from to jump
constexpr float kRateFactor = 20;  // x264's constant rate factor: lower is better and larger
constexpr int kMostFilmPixels = 8192;

struct CloseEncoder {
  void operator()(x264_t* encoder) const { x264_encoder_close(encoder); }
};

std::span<const std::uint8_t> withoutLength(const x264_nal_t& nal) {
  return std::span(nal.p_payload, static_cast<std::size_t>(nal.i_payload)).subspan(4);
}

// Luma and chroma of BT.709 in limited range, from 8 bits (Rec. ITU-R BT.709-6, items 3.2 to 3.4).
struct Sums {
  double r = 0, g = 0, b = 0;
};
double luma(const Sums& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }
std::uint8_t lumaByte(const Sums& c) { return static_cast<std::uint8_t>(std::lround(16 + luma(c) * 219 / 255)); }
std::uint8_t blueByte(const Sums& c) {
  return static_cast<std::uint8_t>(std::lround(128 + (c.b - luma(c)) / 1.8556 * 224 / 255));
}
std::uint8_t redByte(const Sums& c) {
  return static_cast<std::uint8_t>(std::lround(128 + (c.r - luma(c)) / 1.5748 * 224 / 255));
}

class X264Writer : public FilmWriter {
 public:
  X264Writer(Mp4File file, std::unique_ptr<x264_t, CloseEncoder> encoder, Mp4File::Track track)
      : file_(std::move(file)), encoder_(std::move(encoder)), track_(std::move(track)) {
    x264_picture_alloc(&picture_, X264_CSP_I420, track_.width, track_.height);
  }
  ~X264Writer() override { x264_picture_clean(&picture_); }
  X264Writer(const X264Writer&) = delete;
  X264Writer& operator=(const X264Writer&) = delete;

  Result<void> append(const PixelPicture& picture) override {
    if (picture.width != track_.width || picture.height != track_.height)
      return failure(ErrorKind::internal, "a picture of another size than the film's");
    fill(picture);
    picture_.i_pts = pictures_++;
    return encode(&picture_);
  }

  Result<void> finish() override {
    while (x264_encoder_delayed_frames(encoder_.get()) > 0) TRY(encode(nullptr));
    return file_.finish(track_);
  }

 private:
  void fill(const PixelPicture& picture) {
    const auto sumOf = [&](int x, int y) {
      const auto& p = picture.rgba[static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                                   static_cast<std::size_t>(x)];
      return Sums{double(p[0]), double(p[1]), double(p[2])};
    };
    auto& planes = picture_.img;
    for (int y = 0; y < track_.height; ++y)
      for (int x = 0; x < track_.width; ++x) planes.plane[0][y * planes.i_stride[0] + x] = lumaByte(sumOf(x, y));
    for (int y = 0; y < track_.height / 2; ++y)
      for (int x = 0; x < track_.width / 2; ++x) {
        Sums mean;
        for (const auto& s :
             {sumOf(2 * x, 2 * y), sumOf(2 * x + 1, 2 * y), sumOf(2 * x, 2 * y + 1), sumOf(2 * x + 1, 2 * y + 1)})
          mean = {mean.r + s.r / 4, mean.g + s.g / 4, mean.b + s.b / 4};
        planes.plane[1][y * planes.i_stride[1] + x] = blueByte(mean);
        planes.plane[2][y * planes.i_stride[2] + x] = redByte(mean);
      }
  }

  Result<void> encode(x264_picture_t* picture) {
    x264_nal_t* nals = nullptr;
    int count = 0;
    x264_picture_t encoded;
    const int bytes = x264_encoder_encode(encoder_.get(), &nals, &count, picture, &encoded);
    if (bytes < 0) return failure(ErrorKind::internal, "the video encoder has failed");
    if (bytes == 0) return {};
    return file_.append(std::span(nals[0].p_payload, static_cast<std::size_t>(bytes)), encoded.b_keyframe != 0);
  }

  Mp4File file_;
  std::unique_ptr<x264_t, CloseEncoder> encoder_;
  Mp4File::Track track_;
  x264_picture_t picture_{};
  std::int64_t pictures_ = 0;
};

x264_param_t settings(int width, int height, std::uint32_t rate) {
  x264_param_t p;
  x264_param_default_preset(&p, "veryfast", nullptr);
  p.i_log_level = X264_LOG_NONE;
  p.i_csp = X264_CSP_I420;
  p.i_width = width;
  p.i_height = height;
  p.i_fps_num = p.i_timebase_den = rate;
  p.i_fps_den = p.i_timebase_num = kRateBase;
  p.i_keyint_max = std::max(1, static_cast<int>(std::lround(kKeyEvery_s * rate / kRateBase)));
  p.i_bframe = 0;  // pictures are stored in the order in which they are shown
  p.b_vfr_input = 0;
  p.b_annexb = 0;  // lengths instead of start codes
  p.b_repeat_headers = 0;
  p.rc.i_rc_method = X264_RC_CRF;
  p.rc.f_rf_constant = kRateFactor;
  p.vui.i_colorprim = p.vui.i_transfer = p.vui.i_colmatrix = 1;  // BT.709
  p.vui.b_fullrange = 0;
  x264_param_apply_profile(&p, "high");
  return p;
}

}  // namespace

Result<std::unique_ptr<FilmWriter>> FilmWriter::create(const std::filesystem::path& file, int width, int height,
                                                       double rate) {
  if (width < 16 || height < 16 || width > kMostFilmPixels || height > kMostFilmPixels || width % 2 != 0 ||
      height % 2 != 0)
    return failure(ErrorKind::usage,
                   fmt::format("invalid size {}x{}: use even numbers from 16 to {}", width, height, kMostFilmPixels));
  if (!(rate >= 1 && rate <= 240))
    return failure(ErrorKind::usage, fmt::format("invalid rate {}: use 1 to 240 pictures per second", rate));
  Mp4File::Track track{width, height, static_cast<std::uint32_t>(std::lround(rate * kRateBase)), kRateBase, {}, {}};
  auto asked = settings(width, height, track.rate);
  std::unique_ptr<x264_t, CloseEncoder> encoder(x264_encoder_open(&asked));
  if (!encoder) return failure(ErrorKind::internal, "cannot start the video encoder");
  x264_nal_t* nals = nullptr;
  int count = 0;
  x264_encoder_headers(encoder.get(), &nals, &count);
  for (int i = 0; i < count; ++i) {
    const auto set = withoutLength(nals[i]);
    if (nals[i].i_type == NAL_SPS) track.sps.assign(set.begin(), set.end());
    if (nals[i].i_type == NAL_PPS) track.pps.assign(set.begin(), set.end());
  }
  if (track.sps.size() < 4 || track.pps.empty())
    return failure(ErrorKind::internal, "the video encoder has no parameter sets");
  TRY_ASSIGN(auto mp4, Mp4File::create(file));
  return std::make_unique<X264Writer>(std::move(mp4), std::move(encoder), std::move(track));
}

}  // namespace standpoint
