// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/labels/room_labels.h"

#include <algorithm>
#include <map>

#include "core/readable_name.h"

namespace standpoint {

namespace {

constexpr double kAboveFloor_m = 1.0;  // under the cut of a plan, over most furniture

bool isStair(const Product& product) { return product.ifc_class.starts_with("IfcStair"); }

// Boxes of stairs: who looks down sees their steps, which a name on them would hide.
std::vector<Bounds> stairBoxes(const Environment& environment) {
  std::vector<Bounds> boxes;
  const auto all = productBounds(environment);
  for (std::size_t p = 0; p < all.size(); ++p)
    if (isStair(environment.products[p]) && !all[p].empty()) boxes.push_back(all[p]);
  return boxes;
}

// In a room's floor plan, of a stair that stands in the room or comes up into it.
bool onStair(const Eigen::Vector3d& place, const SpaceBody& space, const std::vector<Bounds>& stairs) {
  return std::any_of(stairs.begin(), stairs.end(), [&](const Bounds& b) {
    return b.min.z() < space.box.max.z() && b.max.z() > space.box.min.z() && place.x() > b.min.x() &&
           place.x() < b.max.x() && place.y() > b.min.y() && place.y() < b.max.y();
  });
}

// Of a grid over the floor plan, a place whose nearest one outside of the room is about the farthest.
Eigen::Vector3d middleOf(const SpaceBody& space, const std::vector<Bounds>& stairs) {
  constexpr int kSteps = 12;
  const Eigen::Vector3d span = space.box.max - space.box.min;
  const double z = space.box.min.z() + std::min(kAboveFloor_m, span.z() / 2);
  const auto place = [&](int column, int row) {
    return Eigen::Vector3d(space.box.min.x() + span.x() * (column + 0.5) / kSteps,
                           space.box.min.y() + span.y() * (row + 0.5) / kSteps, z);
  };
  std::vector<Eigen::Vector3d> inside, outside;
  for (int row = -1; row <= kSteps; ++row)  // with a frame of places that are outside of it for sure
    for (int column = -1; column <= kSteps; ++column)
      (space.contains(place(column, row)) ? inside : outside).push_back(place(column, row));
  std::vector<Eigen::Vector3d> free, taken = outside;
  for (const auto& p : inside) (onStair(p, space, stairs) ? taken : free).push_back(p);
  if (!free.empty()) inside = std::move(free), outside = std::move(taken);  // a stairwell is nothing but stairs
  std::vector<double> clear;                                                // from the nearest place outside, squared
  for (const auto& p : inside) {
    clear.push_back(1e300);
    for (const auto& q : outside) clear.back() = std::min(clear.back(), (p - q).squaredNorm());
  }
  constexpr double kNearlyAsClear = 0.8;  // then the middle counts: along a corridor all places are alike
  const double least = inside.empty() ? 0 : kNearlyAsClear * *std::max_element(clear.begin(), clear.end());
  const Eigen::Vector3d middle(space.box.min.x() + span.x() / 2, space.box.min.y() + span.y() / 2, z);
  Eigen::Vector3d best = middle;
  double nearest = 1e300;
  for (std::size_t i = 0; i < inside.size(); ++i)
    if (const double off = (inside[i] - middle).squaredNorm(); clear[i] >= least && off < nearest)
      nearest = off, best = inside[i];
  return best;
}

}  // namespace

std::vector<RoomLabel> roomLabels(const Environment& environment) {
  std::vector<RoomLabel> labels;
  const auto stairs = stairBoxes(environment);
  for (const auto& space : spaceBodies(environment)) {
    const auto& product = environment.products[space.product];
    const std::string longer = longNameOf(product);
    const Eigen::Vector3d span = space.box.max - space.box.min;
    const bool both = !longer.empty() && longer != product.name;
    const std::string& name = both ? longer : product.name;
    if (name.empty()) continue;
    labels.push_back({space.product, both ? product.name : "", name, middleOf(space, stairs), span.x() * span.y()});
  }
  std::stable_sort(labels.begin(), labels.end(),
                   [](const RoomLabel& a, const RoomLabel& b) { return a.floor_area_m2 > b.floor_area_m2; });
  return labels;
}

std::vector<StairLabel> stairLabels(const Environment& environment) {
  constexpr double kLeastRise_m = 1;
  const auto boxes = productBounds(environment);
  std::map<std::uint32_t, Bounds> stairs;  // by the product that is the whole stair
  for (std::uint32_t p = 0; p < boxes.size(); ++p) {
    if (!isStair(environment.products[p]) || boxes[p].empty()) continue;
    const std::int32_t whole = environment.products[p].whole;
    const bool is_part = whole >= 0 && isStair(environment.products[static_cast<std::size_t>(whole)]);
    stairs[is_part ? static_cast<std::uint32_t>(whole) : p].extend(boxes[p]);
  }
  std::vector<StairLabel> labels;
  for (const auto& [product, box] : stairs)
    if (box.max.z() - box.min.z() > kLeastRise_m) labels.push_back({product, box});
  return labels;
}

void RoomLabels::follow(const std::shared_ptr<const Environment>& environment) const {
  if (environment_ == environment) return;
  environment_ = environment;
  labels_ = environment ? roomLabels(*environment) : std::vector<RoomLabel>();
  stairs_ = environment ? stairLabels(*environment) : std::vector<StairLabel>();
  spaces_ = environment ? spaceBodies(*environment) : std::vector<SpaceBody>();
}

const std::vector<RoomLabel>& RoomLabels::of(const std::shared_ptr<const Environment>& environment) const {
  follow(environment);
  return labels_;
}

const std::vector<StairLabel>& RoomLabels::stairsOf(const std::shared_ptr<const Environment>& environment) const {
  follow(environment);
  return stairs_;
}

const SpaceBody* RoomLabels::roomAt(const std::shared_ptr<const Environment>& environment,
                                    const Eigen::Vector3d& place) const {
  follow(environment);
  for (const double aside_m : {0.0, 0.1, 0.5})
    for (int way = 0; way < 6; ++way) {
      const Eigen::Vector3d near = place + (way % 2 == 0 ? aside_m : -aside_m) * Eigen::Vector3d::Unit(2 - way / 2);
      if (const auto product = spaceAt(spaces_, near))
        return &*std::find_if(spaces_.begin(), spaces_.end(), [&](const auto& s) { return s.product == *product; });
    }
  return nullptr;
}

}  // namespace standpoint
