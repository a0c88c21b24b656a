// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "project/answers.h"
#include "project/model/model_verbs.h"

namespace standpoint {

namespace {

using nlohmann::json;

// Which doors are closed is a setting of each door: what was set last, or now with --closed.
Result<void> setDoors(const Document& document, const CollideVerbOptions& options, CollideOptions& typed) {
  typed.doors = options.doors;
  if (typed.doors != DoorState::as_set) {
    if (!options.closed.empty()) return failure(ErrorKind::usage, "requires --doors as-set", "closed");
    return {};
  }
  typed.closed.assign(document.imported->products.size(), false);
  if (options.closed.empty()) {
    if (document.collision)
      for (const auto& door : document.collision->doors) typed.closed[door.product] = door.closed;
    return {};
  }
  for (const auto& selector : options.closed) {
    bool any = false;
    for (const auto product : select(*document.imported, selector)) {
      typed.closed[product] = true;
      any = any || document.imported->products[product].ifc_class.starts_with("IfcDoor");
    }
    if (!any) return failure(ErrorKind::usage, fmt::format("{} matches no door", selector), "closed");
  }
  return {};
}

json productRows(const Environment& environment, const CollideResult& result) {
  json rows = json::array();
  for (std::size_t i = 0; i < result.products.size(); ++i) {
    const auto& c = result.products[i];
    if (c.shapes == 0) continue;
    json row = identity(environment.products[i]);
    row["shapes"] = c.shapes;
    row["triangles"] = c.triangles;
    row["max_deviation_m"] = c.max_deviation_m;
    rows.push_back(std::move(row));
  }
  return rows;
}

json doorRows(const Environment& environment, const CollideResult& result, const Eigen::Vector3d& shift_m) {
  json rows = json::array();
  for (const auto& d : result.doors) {
    json row = identity(environment.products[d.product]);
    row["floor"] = d.floor;
    row["passable"] = d.passable;
    row["closed"] = d.closed;
    row["led_through"] = d.led_through;
    row["clear_width_m"] = d.clear_width_m;
    row["at"] = toJson(d.position + shift_m);
    rows.push_back(std::move(row));
  }
  return rows;
}

json roomRows(const Environment& environment, const CollideResult& result, const Eigen::Vector3d& shift_m) {
  json rows = json::array();
  for (const auto& r : result.rooms) {
    json row = identity(environment.products[r.product]);
    row["walkable_m2"] = r.walkable_m2;
    row["reached"] = r.reached;
    row["at"] = toJson(r.position + shift_m);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::ptrdiff_t passableDoors(const CollideResult& result) {
  return std::count_if(result.doors.begin(), result.doors.end(), [](const Door& d) { return d.passable; });
}

json answerOf(const Environment& environment, const CollideResult& result, const Eigen::Vector3d& shift_m) {
  return {{"products", productRows(environment, result)}, {"shapes", result.shapes.size()},
          {"walkable_area_m2", result.walkable_area_m2},  {"doors", doorRows(environment, result, shift_m)},
          {"doors_passable", passableDoors(result)},      {"rooms", roomRows(environment, result, shift_m)}};
}

}  // namespace

std::span<const Choice<DoorState>> choices(DoorState) {
  static constexpr std::array kDoors = {Choice<DoorState>{"open", DoorState::open},
                                        Choice<DoorState>{"closed", DoorState::closed},
                                        Choice<DoorState>{"as-set", DoorState::as_set}};
  return kDoors;
}

const Fields<CollideVerbOptions>& collideFields() {
  using O = CollideVerbOptions;
  static const Fields<O> fields = {
      {"agent-radius",
       &O::agent_radius_m,
       "radius of the person walking",
       {.unit = "m", .minimum = 0.05, .maximum = 2}},
      {"agent-height", &O::agent_height_m, "height of the person walking", {.unit = "m", .minimum = 0.3, .maximum = 5}},
      {"doors", &O::doors, "state of the doors; as-set: closed are those of last time, or those of --closed"},
      {"closed", &O::closed, "selectors of the closed doors, with --doors as-set: #id, name:…, storey:…"}};
  return fields;
}

Result<Outcome> runCollide(const Document& document, const CollideVerbOptions& options, Progress& progress) {
  CollideOptions typed{options.agent_radius_m, options.agent_height_m, {}, {}};
  TRY(setDoors(document, options, typed));
  progress.stage("Collision shapes");
  // From the model as it came: walls that are still prisms give few convex pieces, and no doorway has been simplified.
  const auto& environment = *document.imported;
  const Eigen::Vector3d shift_m = document.georeference ? document.georeference->shift_m : Eigen::Vector3d::Zero();
  TRY_ASSIGN(auto result, collide(environment, typed, progress));
  Outcome outcome{document, answerOf(environment, result, shift_m), result.report, {}};
  outcome.description =
      fmt::format("Created {} collision shapes; {:.1f} m² walkable, {} of {} doors passable", result.shapes.size(),
                  result.walkable_area_m2, passableDoors(result), result.doors.size());
  outcome.document.collision = std::make_shared<const CollideResult>(std::move(result));
  return outcome;
}

}  // namespace standpoint
