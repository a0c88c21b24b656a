// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/stairs.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "editor/model/model.h"
#include "editor/walking/stair_way.h"
#include "editor/words/words.h"

namespace standpoint {

namespace {

constexpr double kStairSpeed_mps = 2.6;

// Where the straight way from outside meets the box; nothing from inside, or where it misses.
std::optional<Eigen::Vector3d> entryOf(const Bounds& box, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  double enters = 0, leaves = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double way = to[axis] - from[axis];
    if (std::abs(way) < 1e-9) {
      if (from[axis] < box.min[axis] || from[axis] > box.max[axis]) return std::nullopt;
      continue;
    }
    const double low = (box.min[axis] - from[axis]) / way, high = (box.max[axis] - from[axis]) / way;
    enters = std::max(enters, std::min(low, high));
    leaves = std::min(leaves, std::max(low, high));
  }
  if (enters <= 0 || enters >= leaves) return std::nullopt;
  return from + enters * (to - from);
}

// The storey that begins there; null: none does.
const StoreyLevel* storeyAt(const Model& model, double height_m) {
  constexpr double kNear_m = 1;
  const auto& storeys = model.storeys();
  const auto nearest = std::min_element(storeys.begin(), storeys.end(), [&](const auto& a, const auto& b) {
    return std::abs(a.elevation_m - height_m) < std::abs(b.elevation_m - height_m);
  });
  return nearest != storeys.end() && std::abs(nearest->elevation_m - height_m) < kNear_m ? &*nearest : nullptr;
}

void take(Model& model, const StairAhead& stair) {
  const auto way = stairWay(model.walk.ground(), model.walk.feet(), stair.box, stair.elevation_m);
  if (!way.corners.empty()) {
    rememberView(model);
    const bool counts = model.recording.record.active();  // who records walks as he would
    return model.walk.goAlong(way.corners, counts ? model.walk.speed_mps(false) : kStairSpeed_mps);
  }
  if (!way.low) return model.say(trf("No walkable way to {} by this stair", stair.storey));
  const Eigen::Vector3d at = way.low->tread + model.shift_m();
  model.say(trf("No way to {} by this stair: headroom {:.2f} m at {:.2f}  {:.2f}  {:.2f} m", stair.storey,
                way.low->headroom_m, at.x(), at.y(), at.z()));
}

}  // namespace

std::vector<StairAhead> stairsAhead(const Model& model, const ViewState& state) {
  constexpr double kFarthest_m = 15, kChest_m = 1.2, kOff_m = 0.05, kWithin_m = 0.3;
  std::vector<StairAhead> ahead;
  if (!model.walk.active() || model.walk.goesByItself()) return ahead;
  const Eigen::Vector3d eye = model.view.camera.eye(), feet = model.walk.feet();
  for (const auto& [product, box] : model.room_labels.stairsOf(model.session.document().imported)) {
    const double low = box.min.z(), high = box.max.z();
    const bool up = feet.z() < (low + high) / 2;
    const auto* storey = storeyAt(model, up ? high : low);
    if (storey == nullptr || feet.z() < low - kChest_m || feet.z() > high + kChest_m) continue;
    Eigen::Vector3d anchor = (box.min + box.max) / 2;
    anchor.z() = std::clamp(feet.z() + kChest_m, low, high - kWithin_m);  // whoever is upstairs looks down on it
    const auto entry = entryOf(box, eye, anchor);
    if (!entry || (*entry - eye).norm() > kFarthest_m) continue;
    if ((anchor - eye).dot(model.view.camera.forward()) <= 0) continue;
    const Eigen::Vector3d before = *entry - kOff_m * (*entry - eye).normalized();
    const auto& name = model.environment()->spatial[static_cast<std::size_t>(storey->node)].name;
    if (name.empty() || !model.picker.sees(eye, before, state)) continue;
    ahead.push_back({product, box, name, storey->elevation_m, up, anchor, (*entry - eye).norm()});
  }
  std::stable_sort(ahead.begin(), ahead.end(), [](const auto& a, const auto& b) { return a.range_m < b.range_m; });
  return ahead;
}

std::string whyNoStair(const Model& model) {
  if (!model.walk.active()) return "Walk first";
  return stairsAhead(model, model.viewState()).empty() ? "Walk to where a stair is in sight first" : "";
}

void takeStair(Model& model) {
  if (const auto ahead = stairsAhead(model, model.viewState()); !ahead.empty()) take(model, ahead.front());
}

void takeStair(Model& model, std::uint32_t product) {
  for (const auto& stair : stairsAhead(model, model.viewState()))
    if (stair.product == product) return take(model, stair);
}

}  // namespace standpoint
