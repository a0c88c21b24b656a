// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/model_verbs.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "project/answers.h"

namespace standpoint {

namespace {

using nlohmann::json;

// Which doors stand closed is a setting of each door: what was set last, or now with --closed.
Result<void> setDoors(const Document& document, const json& options, CollideOptions& typed) {
  const auto doors = options.at("doors").get<std::string>();
  typed.doors = doors == "closed" ? DoorState::closed : doors == "as-set" ? DoorState::as_set : DoorState::open;
  if (typed.doors != DoorState::as_set) {
    if (options.contains("closed")) return failure(ErrorKind::usage, "requires --doors as-set", "closed");
    return {};
  }
  typed.closed.assign(document.imported->products.size(), false);
  if (!options.contains("closed")) {
    if (document.collision)
      for (const auto& door : document.collision->doors) typed.closed[door.product] = door.closed;
    return {};
  }
  for (const auto& selector : options.at("closed").get<std::vector<std::string>>()) {
    bool any = false;
    for (const auto product : select(*document.imported, selector)) {
      typed.closed[product] = true;
      any = any || document.imported->products[product].ifc_class.starts_with("IfcDoor");
    }
    if (!any) return failure(ErrorKind::usage, fmt::format("{} matches no door", selector), "closed");
  }
  return {};
}

}  // namespace

Result<Outcome> collideDocument(const Document& document, const CollideOptions& options, Progress& progress) {
  progress.stage("Collision shapes");
  // From the model as it came: walls that are still prisms give few convex pieces, and no doorway has been simplified.
  const auto& environment = *document.imported;
  const Eigen::Vector3d shift = document.georeference ? document.georeference->shift_m : Eigen::Vector3d::Zero();
  auto result = collide(environment, options, progress);
  if (!result) return failure(result.error());
  Outcome outcome{document, json::object(), result->report, {}};
  json rows = json::array();
  for (std::size_t i = 0; i < result->products.size(); ++i) {
    const auto& c = result->products[i];
    if (c.shapes == 0) continue;
    json row = identity(environment.products[i]);
    row["shapes"] = c.shapes;
    row["triangles"] = c.triangles;
    row["max_deviation_m"] = c.max_deviation_m;
    rows.push_back(std::move(row));
  }
  json doors = json::array();
  std::size_t passable = 0;
  for (const auto& d : result->doors) {
    json row = identity(environment.products[d.product]);
    row["floor"] = d.floor;
    row["passable"] = d.passable;
    row["closed"] = d.closed;
    row["led_through"] = d.led_through;
    row["clear_width_m"] = d.clear_width_m;
    row["at"] = toJson(d.position + shift);
    doors.push_back(std::move(row));
    passable += d.passable ? 1 : 0;
  }
  json rooms = json::array();
  for (const auto& r : result->rooms) {
    json row = identity(environment.products[r.product]);
    row["walkable_m2"] = r.walkable_m2;
    row["reached"] = r.reached;
    row["at"] = toJson(r.position + shift);
    rooms.push_back(std::move(row));
  }
  outcome.answer = {
      {"products", std::move(rows)}, {"shapes", result->shapes.size()}, {"walkable_area_m2", result->walkable_area_m2},
      {"doors", std::move(doors)},   {"doors_passable", passable},      {"rooms", std::move(rooms)}};
  outcome.description = fmt::format("Created {} collision shapes; {:.1f} m² walkable, {} of {} doors passable",
                                    result->shapes.size(), result->walkable_area_m2, passable, result->doors.size());
  outcome.document.collision = std::make_shared<const CollideResult>(*std::move(result));
  return outcome;
}

Result<Outcome> runCollide(const Document& document, const json& options, Progress& progress) {
  CollideOptions typed;
  typed.agent_radius_m = options.at("agent-radius").get<double>();
  typed.agent_height_m = options.at("agent-height").get<double>();
  if (auto set = setDoors(document, options, typed); !set) return failure(set.error());
  return collideDocument(document, typed, progress);
}

}  // namespace standpoint
