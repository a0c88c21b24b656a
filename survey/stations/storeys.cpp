// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/stations/storeys.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <tuple>

#include "core/winding_number.h"
#include "survey/stations/station_places.h"

namespace standpoint {

namespace {

constexpr double kGroundBand_m = 1.5;  // storeys that lie so little apart are one level with steps between
constexpr double kDatum_m = 1;         // of the height 0, that plans call the ground floor's
constexpr double kBelowFloor_m = 0.4;  // a space may begin at the lower side of its slab …
constexpr double kAboveFloor_m = 1.2;  // … and a floor be built up, or have a step

bool isDoor(const Product& p) { return p.ifc_class.starts_with("IfcDoor"); }

bool isOuter(const Product& p) {
  return std::any_of(p.properties.begin(), p.properties.end(),
                     [](const Property& q) { return q.name == "IsExternal" && q.value == "true"; });
}

// The node of the storey that a product is in; -1 for what is in none.
std::int32_t storeyOf(const Environment& environment, const Product& product) {
  for (auto n = product.container; n >= 0; n = environment.spatial[static_cast<std::size_t>(n)].parent)
    if (environment.spatial[static_cast<std::size_t>(n)].ifc_class == "IfcBuildingStorey") return n;
  return -1;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Found {
  StoreyFloor storey;
  Bounds all;                                 // of what it contains
  std::vector<double> space_feet, door_feet;  // lower ends
  std::size_t outer_doors = 0;
};

void take(Found& found, const Product& product, std::uint32_t index, const Bounds& box) {
  if (box.empty()) return;
  if (product.ifc_class == "IfcSpace") {
    found.storey.spaces.push_back(index);
    found.space_feet.push_back(box.min.z());
    found.storey.box.extend(box);
  }
  if (!product.inScene()) return;
  found.all.extend(box);
  if (!isDoor(product)) return;
  found.storey.doors.push_back(index);
  found.door_feet.push_back(box.min.z());
  found.outer_doors += static_cast<std::size_t>(isOuter(product));
}

std::vector<Found> storeysOf(const Environment& environment, double shift_z_m) {
  std::map<std::int32_t, Found> by_node;
  const auto boxes = productBounds(environment);
  for (std::uint32_t i = 0; i < environment.products.size(); ++i) {
    const auto& product = environment.products[i];
    const auto node = product.excluded ? -1 : storeyOf(environment, product);
    if (node >= 0) take(by_node[node], product, i, boxes[i]);
  }
  const bool has_spaces =
      std::any_of(by_node.begin(), by_node.end(), [](const auto& one) { return !one.second.storey.spaces.empty(); });
  std::vector<Found> all;
  for (auto& [node, found] : by_node) {
    auto& storey = found.storey;
    const auto& its = environment.spatial[static_cast<std::size_t>(node)];
    if (found.all.empty()) continue;
    storey.name = its.name;
    storey.rooms = has_spaces ? storey.spaces.size() : storey.doors.size();
    storey.floor_m = !found.space_feet.empty()  ? median(found.space_feet)
                     : !found.door_feet.empty() ? median(found.door_feet)
                                                : its.elevation_m - shift_z_m;
    if (storey.box.empty()) storey.box = found.all;
    all.push_back(std::move(found));
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Found& a, const Found& b) { return a.storey.floor_m < b.storey.floor_m; });
  return all;
}

// `storeys` from below.
double groundLevel(const std::vector<Found>& storeys, double shift_z_m) {
  const auto more = [](const Found& a, const Found& b) { return a.storey.rooms < b.storey.rooms; };
  const auto outer = std::find_if(storeys.begin(), storeys.end(), [](const Found& f) { return f.outer_doors > 0; });
  const Found* at_datum = nullptr;
  for (const auto& f : storeys)
    if (std::abs(f.storey.floor_m + shift_z_m) <= kDatum_m && (at_datum == nullptr || more(*at_datum, f)))
      at_datum = &f;
  if (outer != storeys.end() && (at_datum == nullptr || at_datum->outer_doors == 0)) return outer->storey.floor_m;
  if (at_datum != nullptr) return at_datum->storey.floor_m;
  return std::max_element(storeys.begin(), storeys.end(), more)->storey.floor_m;
}

std::vector<Eigen::Vector3d> placed(const Mesh& mesh, const Eigen::Affine3d& world_from_mesh) {
  std::vector<Eigen::Vector3d> positions;
  for (const auto& p : mesh.positions) positions.emplace_back(world_from_mesh * p.cast<double>());
  return positions;
}

// The shape of a room, asked for many places.
struct RoomShape {
  std::vector<Eigen::Vector3d> positions;
  const std::vector<Triangle>* triangles = nullptr;
  Bounds box;
  bool holds(const Eigen::Vector3d& p) const {
    if ((p.array() < box.min.array()).any() || (p.array() > box.max.array()).any()) return false;
    return std::abs(windingNumber(positions, *triangles, p)) > 0.5;
  }
};

std::vector<RoomShape> roomsOf(const StoreyFloor& storey, const Environment& environment) {
  std::vector<RoomShape> rooms;
  for (const auto& instance : environment.instances) {
    if (!std::binary_search(storey.spaces.begin(), storey.spaces.end(), instance.product)) continue;
    const auto& mesh = *environment.meshes[instance.mesh];
    rooms.push_back({placed(mesh, instance.world_from_mesh), &mesh.triangles, {}});
    for (const auto& p : rooms.back().positions) rooms.back().box.extend(p);
  }
  return rooms;
}

}  // namespace

bool isMadeForStanding(const Product& product) {
  constexpr std::array<std::string_view, 10> kClasses = {"IfcSlab",       "IfcStair", "IfcRamp",       "IfcSite",
                                                         "IfcGeographic", "IfcCivil", "IfcEarthworks", "IfcPave",
                                                         "IfcCourse",     "IfcPlate"};
  if (product.ifc_class.empty()) return true;
  if (product.ifc_class == "IfcCovering") return product.predefined_type == "FLOORING";
  if (product.predefined_type == "ROOF") return false;
  return std::any_of(kClasses.begin(), kClasses.end(),
                     [&](std::string_view c) { return product.ifc_class.starts_with(c); });
}

std::vector<StoreyFloor> storeysFromGround(const Environment& environment, double shift_z_m) {
  const auto found = storeysOf(environment, shift_z_m);
  if (found.empty()) return {};
  const double ground = groundLevel(found, shift_z_m);
  // Beside the ground the number of rooms decides, elsewhere how far it is.
  const auto rank = [&](const StoreyFloor& s) {
    const double above = s.floor_m - ground, count = static_cast<double>(s.rooms);
    const bool level = std::abs(above) <= kGroundBand_m;
    const int turn = level && s.rooms > 0 ? 0 : above < -kGroundBand_m ? 4 : (s.rooms > 0 ? 1 : level ? 2 : 3);
    return std::tuple(turn, level ? -count : 0, std::abs(above));
  };
  std::vector<StoreyFloor> storeys;
  for (const auto& f : found) storeys.push_back(f.storey);
  std::stable_sort(storeys.begin(), storeys.end(),
                   [&](const StoreyFloor& a, const StoreyFloor& b) { return rank(a) < rank(b); });
  return storeys;
}

std::vector<Eigen::Vector3d> placesIn(const StoreyFloor& storey, const RayScene& scene, double height_m) {
  constexpr int kSteps = 20;
  const auto rooms = roomsOf(storey, scene.environment());
  const Eigen::Vector3d size = storey.box.max - storey.box.min;
  std::vector<Eigen::Vector3d> all, in_rooms;
  for (int j = 0; j < kSteps; ++j)
    for (int i = 0; i < kSteps; ++i) {
      const Eigen::Vector3d from(storey.box.min.x() + size.x() * (i + 0.5) / kSteps,
                                 storey.box.min.y() + size.y() * (j + 0.5) / kSteps, storey.floor_m + kAboveFloor_m);
      const auto hit = scene.intersect(from, -Eigen::Vector3d::UnitZ(), kAboveFloor_m + kBelowFloor_m);
      if (!hit || !isMadeForStanding(scene.environment().products[hit->product]) ||
          !isRoomAbove(scene, hit->position, height_m))
        continue;
      all.push_back(hit->position);
      const Eigen::Vector3d body = hit->position + Eigen::Vector3d(0, 0, 1);
      if (std::any_of(rooms.begin(), rooms.end(), [&](const RoomShape& room) { return room.holds(body); }))
        in_rooms.push_back(hit->position);
    }
  return in_rooms.empty() ? all : in_rooms;
}

}  // namespace standpoint
