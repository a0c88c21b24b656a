// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/selection_view.h"

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <optional>

#include <Eigen/Geometry>

#include "editor/model/model.h"
#include "editor/model/walking.h"

namespace standpoint {

namespace {

// By a grid of rays through its part of the picture: how many of them meet the selection first.
int raysOnSelection(const Model& model, const Bounds& box) {
  constexpr int kRays = 16;
  const auto& view = model.view;
  Eigen::AlignedBox2d part;
  for (const auto& corner : cornersOf(box))
    if (const auto pixel = project(view.camera, corner, view.size)) part.extend(*pixel);
  part = part.intersection(Eigen::AlignedBox2d(Eigen::Vector2d::Zero(), view.size));
  if (part.isEmpty()) return 0;
  const auto state = model.viewState();
  int seen = 0;
  for (int i = 0; i < kRays; ++i)
    for (int k = 0; k < kRays; ++k) {
      const Eigen::Vector2d along((i + 0.5) / kRays, (k + 0.5) / kRays);
      const Eigen::Vector2d pixel = part.min() + along.cwiseProduct(part.sizes());
      const auto hit = model.picker.pick(rayThrough(view.camera, pixel, view.size), state);
      if (hit && model.selection.contains(hit->product)) ++seen;
    }
  return seen;
}

struct Sight {
  Camera camera;
  std::optional<double> cut_height_m;
  int rays = 0;
};

Sight sightFrom(Model& model, const Bounds& box, const Camera& camera, std::optional<double> cut_height_m) {
  model.view.camera = camera;
  model.visibility.cut_height_m = cut_height_m;
  model.bringIntoView(box);
  return {model.view.camera, cut_height_m, raysOnSelection(model, box)};
}

// From all around, the direction that is looked in already first.
Sight bestAround(Model& model, const Bounds& box, const Camera& before, std::optional<double> cut_height_m,
                 std::initializer_list<double> elevations_rad) {
  constexpr int kDirections = 12;
  Sight best;
  for (const double elevation_rad : elevations_rad)
    for (int i = 0; i < kDirections; ++i) {
      Camera camera = before;
      camera.orthographic = false;
      camera.view_angle_rad = Camera().view_angle_rad;
      camera.elevation_rad = elevation_rad;
      camera.azimuth_rad = azimuthBeside(before.azimuth_rad, i, kDirections);
      const auto sight = sightFrom(model, box, camera, cut_height_m);
      if (sight.rays > best.rays) best = sight;
    }
  return best;
}

}  // namespace

void showSelection(Model& model) {
  constexpr double kMostOfIt = 0.5, kOver_m = 0.02;
  const Bounds box = model.selectionBounds();
  if (box.empty() || model.cloud() || model.preview.outcome() != nullptr || !model.picker.ready())
    return model.frameSelection();
  rememberView(model);
  stopWalking(model);
  stopFlying(model);
  const Camera before = model.view.camera;
  const auto cut_before = model.visibility.cut_height_m;
  const double middle_m = (box.min.z() + box.max.z()) / 2;
  const Sight sights[] = {sightFrom(model, box, before, cut_before),
                          bestAround(model, box, before, std::nullopt, {0.3, 0.6}),
                          bestAround(model, box, before, box.max.z() + kOver_m, {0.6, 1.0}),
                          bestAround(model, box, before, middle_m, {0.6, 1.0})};
  const int most = std::max_element(std::begin(sights), std::end(sights), [](const Sight& a, const Sight& b) {
                     return a.rays < b.rays;
                   })->rays;
  const auto* const chosen =
      std::find_if(std::begin(sights), std::end(sights), [&](const Sight& s) { return s.rays >= kMostOfIt * most; });
  model.view.camera = chosen->camera;
  model.visibility.cut_height_m = cut_before;
  model.visibility.cutForSight(chosen->cut_height_m);
}

}  // namespace standpoint
