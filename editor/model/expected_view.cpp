// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/expected_view.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <tbb/parallel_for.h>

#include "editor/model/picker.h"

namespace standpoint {

namespace {

using Rgba = std::array<std::uint8_t, 4>;

// Five stops of viridis, and of a scale that is calm where noise is low; rounded.
constexpr std::array<std::array<double, 3>, 5> kIntensityStops = {
    {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}}};
constexpr std::array<std::array<double, 3>, 5> kNoiseStops = {
    {{222, 235, 247}, {158, 202, 225}, {253, 208, 120}, {240, 120, 70}, {150, 20, 60}}};

Rgba shaded(const Rgba& colour, float fraction) {
  const auto of = [&](std::uint8_t c) { return static_cast<std::uint8_t>(static_cast<float>(c) * fraction + 0.5F); };
  return {of(colour[0]), of(colour[1]), of(colour[2]), colour[3]};
}

bool sameLook(const ExpectedRequest& a, const ExpectedRequest& b) {
  return a.scene == b.scene && a.view.camera == b.view.camera && a.view.hidden == b.view.hidden &&
         a.view.cut_height_m == b.view.cut_height_m && a.width == b.width && a.height == b.height;
}

}  // namespace

const char* fateName(ReturnFate fate) {
  switch (fate) {
    case ReturnFate::returned: return "detected";
    case ReturnFate::too_weak: return "too weak";
    case ReturnFate::seen_through: return "transparent";
    case ReturnFate::hidden: return "hidden";
    case ReturnFate::too_near: return "too close";
    case ReturnFate::too_far: return "too far";
  }
  return "";
}

Rgba fateColour(ReturnFate fate) {
  switch (fate) {
    case ReturnFate::returned: return {126, 178, 120, 255};
    case ReturnFate::too_weak: return {214, 64, 56, 255};
    case ReturnFate::seen_through: return {98, 160, 214, 255};
    case ReturnFate::hidden: return {112, 117, 126, 255};
    case ReturnFate::too_near: return {190, 110, 200, 255};
    case ReturnFate::too_far: return {232, 150, 62, 255};
  }
  return {};
}

Rgba scaleColour(ExpectedQuantity quantity, double fraction) {
  const auto& stops = quantity == ExpectedQuantity::noise ? kNoiseStops : kIntensityStops;
  const double at = std::clamp(fraction, 0.0, 1.0) * (stops.size() - 1);
  const auto stop = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  Rgba colour = {0, 0, 0, 255};
  for (std::size_t k = 0; k < 3; ++k)
    colour[k] = static_cast<std::uint8_t>(
        std::lround(std::lerp(stops[stop][k], stops[stop + 1][k], at - static_cast<double>(stop))));
  return colour;
}

Rgba expectedColour(ExpectedQuantity quantity, const ExpectedReturn& expected) {
  if (quantity == ExpectedQuantity::fate || expected.fate != ReturnFate::returned) return fateColour(expected.fate);
  return scaleColour(quantity,
                     quantity == ExpectedQuantity::noise ? expected.sigma_m / kNoiseFullScale_m : expected.intensity);
}

const std::shared_ptr<const Expectation>& KeptExpectation::of(const std::shared_ptr<const RayScene>& scene,
                                                              const std::shared_ptr<const MaterialChoice>& materials,
                                                              const Instrument& instrument) {
  if (scene == scene_ && materials == materials_ && instrument.id == instrument_) return expectation_;
  scene_ = scene;
  materials_ = materials;
  instrument_ = instrument.id;
  expectation_.reset();
  const auto settings = resolveSettings(instrument, {});
  if (!scene || !settings) return expectation_;
  auto assignment = materials ? std::shared_ptr<const MaterialAssignment>(materials, &materials->result.assignment)
                              : std::make_shared<const MaterialAssignment>();
  return expectation_ =
             std::make_shared<const Expectation>(scene, std::move(assignment), ReturnLaw(instrument, *settings));
}

ExpectedView::~ExpectedView() { drop(); }

void ExpectedView::want(const ExpectedRequest& request) {
  const std::lock_guard lock(mutex_);
  if (wanted_ == request) return;
  wanted_ = request;
  ++revision_;
  if (!worker_.joinable()) worker_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
  changed_.notify_all();
}

void ExpectedView::drop() {
  {
    const std::lock_guard lock(mutex_);
    if (!worker_.joinable()) return;
    ++revision_;
    wanted_.reset();
    picture_.reset();
  }
  worker_.request_stop();
  changed_.notify_all();
  worker_.join();
  looked_.reset();
  rasters_ = {};
  done_ = revision_;
}

void ExpectedView::wait() {
  std::unique_lock lock(mutex_);
  if (worker_.joinable()) changed_.wait(lock, [this] { return done_ == revision_; });
}

std::shared_ptr<const PixelPicture> ExpectedView::picture(const Camera& camera) const {
  const std::lock_guard lock(mutex_);
  return picture_ && picture_camera_ == camera ? picture_ : nullptr;
}

bool ExpectedView::superseded(std::uint64_t revision) const {
  const std::lock_guard lock(mutex_);
  return revision != revision_;
}

bool ExpectedView::publish(const std::shared_ptr<const PixelPicture>& picture, const ExpectedRequest& request,
                           std::uint64_t revision) {
  const std::lock_guard lock(mutex_);
  if (revision != revision_) return false;
  picture_ = picture;
  picture_camera_ = request.view.camera;
  return true;
}

void ExpectedView::work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return wanted_ && done_ != revision_; })) {
    const auto request = *wanted_;
    const auto revision = revision_;
    lock.unlock();
    if (!looked_ || !sameLook(*looked_, request)) rasters_ = {};
    looked_ = request;
    std::shared_ptr<const PixelPicture> painted;
    for (std::size_t i = 0; i < kSteps.size(); ++i) {
      rasters_[i].step = kSteps[i];
      painted = look(request, revision, rasters_[i]) ? paint(request, revision, rasters_[i]) : nullptr;
      if (!painted || !publish(painted, request, revision)) break;
      if (wake_) wake_();
    }
    lock.lock();
    if (painted && revision == revision_) done_ = revision;
    changed_.notify_all();
  }
}

bool ExpectedView::look(const ExpectedRequest& request, std::uint64_t revision, Raster& raster) const {
  if (!raster.seen.empty()) return true;
  raster.width = (request.width + raster.step - 1) / raster.step;
  raster.height = (request.height + raster.step - 1) / raster.step;
  std::vector<Seen> seen(static_cast<std::size_t>(raster.width) * static_cast<std::size_t>(raster.height));
  std::atomic<bool> late{false};
  tbb::parallel_for(0, raster.height, [&](int y) {
    if (late.load(std::memory_order_relaxed)) return;
    if (superseded(revision)) late.store(true);
    for (int x = 0; x < raster.width; ++x) {
      const auto ray = rayThrough(request.view.camera, {(x + 0.5) * raster.step, (y + 0.5) * raster.step},
                                  {request.width, request.height});
      const auto hit = firstShown(*request.scene, ray, request.view);
      if (hit)
        seen[static_cast<std::size_t>(y) * static_cast<std::size_t>(raster.width) + static_cast<std::size_t>(x)] = {
            hit->position.cast<float>(), hit->normal.cast<float>(), hit->product, hit->instance, hit->triangle, true};
    }
  });
  if (late) return false;
  raster.seen = std::move(seen);
  return true;
}

// A little of the camera's light, and lines where the product or the direction of the surface changes, to tell forms
// apart.
std::shared_ptr<const PixelPicture> ExpectedView::paint(const ExpectedRequest& request, std::uint64_t revision,
                                                        const Raster& raster) const {
  auto picture = std::make_shared<PixelPicture>();
  picture->width = raster.width;
  picture->height = raster.height;
  picture->rgba.resize(raster.seen.size());
  const Eigen::Vector3f forward = request.view.camera.forward().cast<float>();
  const auto width = static_cast<std::size_t>(raster.width);
  const auto parted = [&](const Seen& a, const Seen& b) {
    return a.any != b.any || a.product != b.product || a.normal.dot(b.normal) < 0.87F;
  };
  std::atomic<bool> late{false};
  tbb::parallel_for(std::size_t{0}, static_cast<std::size_t>(raster.height), [&](std::size_t y) {
    if (late.load(std::memory_order_relaxed)) return;
    if (superseded(revision)) late.store(true);
    for (std::size_t x = 0; x < width; ++x) {
      const Seen& seen = raster.seen[y * width + x];
      if (!seen.any) continue;
      const SurfacePlace place{seen.position.cast<double>(), seen.normal.cast<double>(), seen.instance, seen.triangle};
      const Rgba colour = request.coverage
                              ? coverageColour(*request.coverage, coverageAt(request.scans, place, request.wanted))
                              : expectedColour(request.quantity, request.expectation->from(request.station, place));
      float light = 0.72F + 0.28F * std::abs(seen.normal.dot(forward));
      const bool edge =
          (x + 1 < width && parted(seen, raster.seen[y * width + x + 1])) ||
          (y + 1 < static_cast<std::size_t>(raster.height) && parted(seen, raster.seen[(y + 1) * width + x]));
      if (request.view.edges && edge) light *= 0.6F;
      picture->rgba[y * width + x] = shaded(colour, light);
    }
  });
  return late ? nullptr : picture;
}

}  // namespace standpoint
