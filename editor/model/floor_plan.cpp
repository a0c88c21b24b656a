// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/floor_plan.h"

#include <algorithm>
#include <cmath>

#include "editor/model/model.h"
#include "survey/stations/storeys.h"

namespace standpoint {

namespace {

constexpr double kSameHeight_m = 0.01;

// Index of the storey whose floor is the highest that is not above `height_m`, else the lowest.
std::size_t storeyAt(const std::vector<StoreyLevel>& storeys, double height_m) {
  std::size_t found = 0;
  for (std::size_t i = 0; i < storeys.size(); ++i)
    if (storeys[i].elevation_m <= height_m) found = i;
  return found;
}

std::size_t nextStorey(const Model& model, const std::vector<StoreyLevel>& storeys) {
  const auto& cut = model.visibility.cut_height_m;
  if (cut && looksStraightDown(model.view.camera) && !model.walk.active()) {
    const std::size_t shown = storeyAt(storeys, *cut - kCutAboveFloor_m + kSameHeight_m);
    return (shown + 1) % storeys.size();
  }
  constexpr double kStep_m = 0.5;  // half a flight of stairs belongs to the storey below
  if (model.walk.active()) return storeyAt(storeys, model.walk.feet().z() + kStep_m);
  const auto from_ground = storeysFromGround(*model.environment(), model.shift_m().z());
  return from_ground.empty() ? 0 : storeyAt(storeys, from_ground.front().floor_m + kStep_m);
}

}  // namespace

void lookAtNextPlan(Model& model) {
  if (!model.environment()) return;
  const auto& storeys = model.storeys();
  const Bounds shown = model.buildingBounds();
  const double cut = !storeys.empty() ? storeys[nextStorey(model, storeys)].elevation_m + kCutAboveFloor_m
                                      : (shown.min.z() + shown.max.z()) / 2;
  if (model.walk.active()) {
    model.view.tool = Tool::select;
    followWalking(model);
  }
  model.visibility.cut_height_m = cut;
  look(model.view.camera, StandardView::top);
  model.view.camera.orthographic = true;
  frame(model.view.camera, shown, model.view.size.x() / std::max(model.view.size.y(), 1.0));
}

}  // namespace standpoint
