// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/expected_view.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include <tbb/parallel_for.h>

#include "editor/colours/colour_scale.h"
#include "editor/model/picker.h"

namespace standpoint {

namespace {

using Rgba = std::array<std::uint8_t, 4>;

// Calm where noise is low.
constexpr ColourStops kNoiseStops = {
    {{225, 238, 250}, {110, 170, 215}, {253, 208, 120}, {240, 120, 70}, {150, 20, 60}}};

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

// After Okabe and Ito, who chose colours that all people tell apart.
Rgba fateColour(ReturnFate fate) {
  switch (fate) {
    case ReturnFate::returned: return {0, 158, 115, 255};
    case ReturnFate::too_weak: return {213, 94, 0, 255};
    case ReturnFate::seen_through: return {86, 180, 233, 255};
    case ReturnFate::hidden: return {112, 117, 126, 255};
    case ReturnFate::too_near: return {222, 150, 190, 255};
    case ReturnFate::too_far: return {240, 228, 66, 255};
  }
  return {};
}

Rgba scaleColour(ExpectedQuantity quantity, double fraction) {
  return quantity == ExpectedQuantity::noise ? colourAlong(kNoiseStops, fraction) : viridis(fraction);
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

// What the works hand from one to the next: the camera's rays, and the picture, which others look at meanwhile.
class ExpectedView::Drawing {
 public:
  Result<Finest> draw(const ExpectedRequest& request, Progress& progress);
  std::shared_ptr<const PixelPicture> picture(const Camera& camera) const;

 private:
  struct Seen {
    Eigen::Vector3f position = Eigen::Vector3f::Zero(), normal = Eigen::Vector3f::Zero();
    std::uint32_t product = 0, instance = 0, triangle = 0;
    bool any = false;
  };
  // What the camera sees, a ray for each square of `step` pixels.
  struct Raster {
    int step = 0, width = 0, height = 0;
    std::vector<Seen> seen;
  };
  static constexpr std::array<int, 3> kSteps = {6, 2, 1};

  static Result<void> look(const ExpectedRequest& request, Raster& raster, const Progress& progress);
  static Result<std::shared_ptr<const PixelPicture>> paint(const ExpectedRequest& request, const Raster& raster,
                                                           const Progress& progress);

  mutable std::mutex mutex_;
  std::shared_ptr<const PixelPicture> picture_;
  Camera picture_camera_;
  // The running work's own.
  std::optional<ExpectedRequest> looked_;  // what rasters_ were made for
  std::array<Raster, kSteps.size()> rasters_;
};

ExpectedView::ExpectedView(std::function<void()> wake) : latest_("Expected returns", std::move(wake)) {}

void ExpectedView::want(const ExpectedRequest& request) {
  if (latest_.wants(request)) {
    latest_.poll();
    return;
  }
  if (!drawing_) drawing_ = std::make_shared<Drawing>();
  latest_.want(request, [request, drawing = drawing_](Progress& progress) { return drawing->draw(request, progress); });
}

void ExpectedView::drop() {
  latest_.drop();
  drawing_.reset();
}

std::shared_ptr<const PixelPicture> ExpectedView::picture(const Camera& camera) const {
  return drawing_ ? drawing_->picture(camera) : nullptr;
}

std::shared_ptr<const PixelPicture> ExpectedView::Drawing::picture(const Camera& camera) const {
  const std::lock_guard lock(mutex_);
  return picture_ && picture_camera_ == camera ? picture_ : nullptr;
}

Result<ExpectedView::Finest> ExpectedView::Drawing::draw(const ExpectedRequest& request, Progress& progress) {
  if (!looked_ || !sameLook(*looked_, request)) rasters_ = {};
  looked_ = request;
  for (std::size_t i = 0; i < kSteps.size(); ++i) {
    rasters_[i].step = kSteps[i];
    TRY(look(request, rasters_[i], progress));
    TRY_ASSIGN(auto painted, paint(request, rasters_[i], progress));
    {
      const std::lock_guard lock(mutex_);
      picture_ = std::move(painted);
      picture_camera_ = request.view.camera;
    }
    if (i + 1 < kSteps.size()) progress.advance(static_cast<double>(i + 1) / kSteps.size());  // the end wakes by itself
  }
  return Finest{};
}

Result<void> ExpectedView::Drawing::look(const ExpectedRequest& request, Raster& raster, const Progress& progress) {
  if (!raster.seen.empty()) return {};
  raster.width = (request.width + raster.step - 1) / raster.step;
  raster.height = (request.height + raster.step - 1) / raster.step;
  std::vector<Seen> seen(static_cast<std::size_t>(raster.width) * static_cast<std::size_t>(raster.height));
  tbb::parallel_for(0, raster.height, [&](int y) {
    if (progress.cancelled()) return;
    for (int x = 0; x < raster.width; ++x) {
      const auto ray = rayThrough(request.view.camera, {(x + 0.5) * raster.step, (y + 0.5) * raster.step},
                                  {request.width, request.height});
      const auto hit = firstShown(*request.scene, ray, request.view);
      if (hit)
        seen[static_cast<std::size_t>(y) * static_cast<std::size_t>(raster.width) + static_cast<std::size_t>(x)] = {
            hit->position.cast<float>(), hit->normal.cast<float>(), hit->product, hit->instance, hit->triangle, true};
    }
  });
  TRY(progress.check());
  raster.seen = std::move(seen);
  return {};
}

// A little of the camera's light, and lines where the product or the direction of the surface changes, to tell forms
// apart.
Result<std::shared_ptr<const PixelPicture>> ExpectedView::Drawing::paint(const ExpectedRequest& request,
                                                                         const Raster& raster,
                                                                         const Progress& progress) {
  auto picture = std::make_shared<PixelPicture>();
  picture->width = raster.width;
  picture->height = raster.height;
  picture->rgba.resize(raster.seen.size());
  const Eigen::Vector3f forward = request.view.camera.forward().cast<float>();
  const auto width = static_cast<std::size_t>(raster.width);
  const auto parted = [&](const Seen& a, const Seen& b) {
    return a.any != b.any || a.product != b.product || a.normal.dot(b.normal) < 0.87F;
  };
  tbb::parallel_for(std::size_t{0}, static_cast<std::size_t>(raster.height), [&](std::size_t y) {
    if (progress.cancelled()) return;
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
  TRY(progress.check());
  return picture;
}

}  // namespace standpoint
