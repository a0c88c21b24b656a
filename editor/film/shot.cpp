// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/film/shot.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "editor/film/panorama.h"
#include "editor/film/picture_file.h"

namespace standpoint {

namespace {

constexpr double kTurn_s = 12;
constexpr double kLongest_s = 3600;
constexpr int kLeastPixels = 64, kMostPixels = 8192, kMostColumns = 16384;

constexpr std::array kShotKinds = {
    ShotKindRow{ShotKind::picture, "picture", "Picture", "of the view, as PNG or JPEG", ".png", false, 1920, 1080},
    ShotKindRow{ShotKind::panorama, "panorama", "360° panorama",
                "of all that is around a place, as a spherical picture (equirectangular)", ".jpg", false, 4096, 2048},
    ShotKindRow{ShotKind::turntable, "turntable", "Turntable", "film of one turn around the model, as MP4", ".mp4",
                true, 1280, 720},
    ShotKindRow{ShotKind::walk_through, "walk-through", "Walk-through",
                "film of a walk through the model, from station to station or from room to room, as MP4", ".mp4", true,
                1280, 720}};

std::string whyNotSize(const ShotRequest& r) {
  if (r.kind == ShotKind::panorama)
    return r.width == 2 * r.height && r.width >= 2 * kLeastPixels && r.width <= kMostColumns
               ? ""
               : fmt::format("A panorama is twice as wide as high, up to {0}x{1} pixels", kMostColumns,
                             kMostColumns / 2);
  const auto fits = [](int pixels) { return pixels >= kLeastPixels && pixels <= kMostPixels; };
  if (!fits(r.width) || !fits(r.height)) return fmt::format("Use {0}x{0} to {1}x{1} pixels", kLeastPixels, kMostPixels);
  if (rowOf(r.kind).film && (r.width % 2 != 0 || r.height % 2 != 0)) return "A film needs even numbers of pixels";
  return "";
}

// What fits a single picture of the screen does not fit pictures that are put together: what a picture's own corners
// and edges decide would show where they meet.
ViewState forPanorama(ViewState view) {
  view.still_light = true;
  view.grid = false;
  view.graphics.level = std::min(view.graphics.level, GraphicsLevel::medium);
  return view;
}

}  // namespace

std::span<const ShotKindRow> shotKinds() { return kShotKinds; }

const ShotKindRow& rowOf(ShotKind kind) {
  return *std::find_if(kShotKinds.begin(), kShotKinds.end(), [&](const auto& row) { return row.kind == kind; });
}

double secondsOf(const ShotRequest& request) {
  if (request.seconds > 0) return request.seconds;
  return request.kind == ShotKind::walk_through ? WalkThrough(request.way).seconds() : kTurn_s;
}

std::string whyNotShot(const ShotRequest& r) {
  if (!r.view.environment && !r.view.cloud) return "Import a model first";
  const auto extension = r.file.extension();
  const bool film = rowOf(r.kind).film;
  if (film && extension != ".mp4") return "The file name must end in .mp4";
  if (!film && extension != ".png" && extension != ".jpg" && extension != ".jpeg")
    return "The file name must end in .png or .jpg";
  if (auto why = whyNotSize(r); !why.empty()) return why;
  if (!film) return "";
  if (!(r.rate >= 1 && r.rate <= 240)) return "Use 1 to 240 pictures per second";
  if (!(r.seconds >= 0 && r.seconds <= kLongest_s)) return fmt::format("Use at most {:.0f} seconds", kLongest_s);
  if (r.kind == ShotKind::walk_through && WalkThrough(r.way).length_m() < 0.5)
    return "There is no way to walk: add two stations, or a model with rooms";
  return "";
}

Result<std::unique_ptr<Shoot>> Shoot::begin(ShotRequest request) {
  if (auto why = whyNotShot(request); !why.empty())
    return failure(ErrorKind::usage, std::move(why), request.file.string());
  std::unique_ptr<Shoot> shoot(new Shoot(std::move(request)));
  auto& r = shoot->request_;
  if (r.kind == ShotKind::panorama) {
    shoot->all_ = kFaces;
    r.view = forPanorama(r.view);
  }
  if (r.kind == ShotKind::walk_through) shoot->walk_.emplace(r.way);
  if (rowOf(r.kind).film) {
    shoot->all_ = static_cast<std::size_t>(std::max(1.0, std::round(secondsOf(r) * r.rate)));
    TRY_ASSIGN(shoot->film_, FilmWriter::create(r.file, r.width, r.height, r.rate));
  }
  return shoot;
}

Result<bool> Shoot::step(SceneView& scene) {
  if (done_ == all_) return true;
  TRY(request_.kind == ShotKind::panorama ? drawFace(scene) : drawPicture(scene));
  return ++done_ == all_;
}

Result<void> Shoot::drawFace(SceneView& scene) {
  const Eigen::Vector3d eye = request_.view.camera.eye();
  const double azimuth = request_.view.camera.azimuth_rad;
  const int size = faceSize(request_.width);
  ViewState view = request_.view;
  view.camera = faceCamera(static_cast<int>(done_), eye, azimuth, size);
  TRY_ASSIGN(faces_[done_], scene.pixels(view, size, size));
  if (done_ + 1 < all_) return {};
  return writePicture(panoramaOf(faces_, azimuth, request_.width, request_.height), request_.file,
                      PictureShape::spherical);
}

Result<void> Shoot::drawPicture(SceneView& scene) {
  ViewState view = request_.view;
  const double share = static_cast<double>(done_) / static_cast<double>(all_);  // a turn that is repeated goes on
  if (request_.kind == ShotKind::turntable)
    view.camera =
        turntableAt(view.camera, request_.around, static_cast<double>(request_.width) / request_.height, share);
  if (walk_) view.camera = walk_->at(share);
  TRY_ASSIGN(auto picture, scene.pixels(view, request_.width, request_.height));
  if (request_.over) request_.over(picture);
  if (!film_) return writePicture(picture, request_.file);
  TRY(film_->append(picture));
  return done_ + 1 < all_ ? Result<void>() : film_->finish();
}

}  // namespace standpoint
