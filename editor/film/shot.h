// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/result.h"
#include "editor/film/camera_path.h"
#include "editor/film/film_writer.h"
#include "editor/model/view_state.h"

namespace standpoint {

enum class ShotKind { picture, panorama, turntable, walk_through };

// What the doors call the kinds: "--walk-through", "Walk-through".
struct ShotKindRow {
  ShotKind kind;
  const char* id;
  const char* title;
  const char* help;
  const char* extension;  // that is offered
  bool film;
  int width, height;  // that are offered
};
std::span<const ShotKindRow> shotKinds();
const ShotKindRow& rowOf(ShotKind kind);

struct ShotRequest {
  ShotKind kind = ShotKind::picture;
  std::filesystem::path file;
  int width = 1920, height = 1080;          // pixels; of a panorama the height is half the width
  double rate = 30;                         // pictures per second of a film
  double seconds = 0;                       // of a film; 0: what suits it
  ViewState view;                           // what is seen, and with which camera
  Bounds around;                            // what a turntable turns around
  std::vector<Eigen::Vector3d> way;         // of the feet, for a walk-through
  std::function<void(PixelPicture&)> over;  // draws over a picture before it is written; empty: nothing does
};

// "" when it can be made, else what is wrong with it, to be said beside the field.
std::string whyNotShot(const ShotRequest& request);
double secondsOf(const ShotRequest& request);  // of the film

// Makes one picture or film, a step at a time, because pictures are drawn on the thread that has the context.
class Shoot {
 public:
  static Result<std::unique_ptr<Shoot>> begin(ShotRequest request);

  // Draws the next picture, about as long as a frame. True when the file is there.
  Result<bool> step(SceneView& scene);
  std::size_t done() const { return done_; }  // pictures
  std::size_t all() const { return all_; }
  double fraction() const { return static_cast<double>(done_) / static_cast<double>(all_); }
  const ShotRequest& request() const { return request_; }

 private:
  explicit Shoot(ShotRequest request) : request_(std::move(request)) {}
  Result<void> drawFace(SceneView& scene);
  Result<void> drawPicture(SceneView& scene);

  ShotRequest request_;
  std::size_t done_ = 0, all_ = 1;
  std::optional<WalkThrough> walk_;
  std::unique_ptr<FilmWriter> film_;
  std::array<PixelPicture, 6> faces_;
};

}  // namespace standpoint
