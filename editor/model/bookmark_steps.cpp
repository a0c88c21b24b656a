// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/bookmark_steps.h"

#include <cmath>

#include "core/units.h"
#include "editor/model/model.h"
#include "editor/words/words.h"
#include "project/model/bookmarks.h"

namespace standpoint {

namespace {

Camera cameraOf(const Bookmark& bookmark) {
  Camera camera;
  camera.distance_m = bookmark.distance_m;
  camera.azimuth_rad = -bookmark.azimuth_rad;
  camera.elevation_rad = -bookmark.elevation_rad;
  camera.view_angle_rad = bookmark.view_angle_rad;
  camera.orthographic = bookmark.parallel;
  camera.target = bookmark.eye + camera.forward() * camera.distance_m;
  return camera;
}

}  // namespace

void addBookmark(Model& model) {
  const auto& camera = model.view.camera;
  const auto name = freeBookmarkName(model.session.document());
  const Eigen::Vector3d shift = model.shift_m();
  BookmarkOptions options{.add = name};
  options.at = camera.eye() + shift;
  options.azimuth_deg = -camera.azimuth_rad / kRadPerDeg;
  options.elevation_deg = -camera.elevation_rad / kRadPerDeg;
  options.distance_m = camera.distance_m;
  options.view_angle_deg = camera.view_angle_rad / kRadPerDeg;
  options.parallel = camera.orthographic;
  if (model.visibility.cut_height_m) options.cut_m = *model.visibility.cut_height_m + shift.z();
  options.on_foot = model.walk.active();
  model.session.start(options, trf("Add bookmark {}", name));
}

void goToBookmark(Model& model, std::size_t bookmark) {
  const auto& bookmarks = model.session.document().bookmarks;
  if (!bookmarks || bookmark >= bookmarks->size()) return;
  const Bookmark& wanted = (*bookmarks)[bookmark];
  if (wanted.on_foot) return walkFromEye(model, wanted.eye, cameraOf(wanted));
  rememberView(model);
  stopWalking(model);
  stopFlying(model);
  model.view.camera = cameraOf(wanted);
  model.visibility.cut_height_m = wanted.cut_height_m;
}

}  // namespace standpoint
