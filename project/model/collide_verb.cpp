// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "core/readable_name.h"
#include "optimizer/walk/doors.h"
#include "project/answers.h"
#include "project/model/model_verbs.h"

namespace standpoint {

namespace {

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

std::size_t passableDoors(const CollideResult& result) {
  return static_cast<std::size_t>(
      std::count_if(result.doors.begin(), result.doors.end(), [](const Door& d) { return d.passable; }));
}

// Storeys whose doors stand on nothing: what is missing is not a threshold but the slab.
void reportMissingSlabs(const Environment& environment, const CollideResult& result, const CollideOptions& options,
                        double shift_z_m, Report& report) {
  struct Storey {
    std::size_t doors = 0;
    std::vector<double> on_nothing;  // lower edges
  };
  std::map<std::string, Storey> storeys;
  const Obstacles obstacles(result.shapes);
  for (const auto& door : result.doors) {
    auto& storey = storeys[environment.products[door.product].storey];
    ++storey.doors;
    const auto passage = door.floor ? std::nullopt : passageOf(environment, door.product);
    if (passage && floorSides(environment, obstacles, *passage, options) == 0)
      storey.on_nothing.push_back(passage->middle.z() + shift_z_m);
  }
  for (auto& [name, storey] : storeys) {
    auto& heights = storey.on_nothing;
    if (heights.empty()) continue;
    std::sort(heights.begin(), heights.end());
    report.warn(name.empty() ? "collide" : name,
                name.empty()
                    ? fmt::format("the floor slab at {:.2f} m is missing: {} of {} doors have no floor on either side; "
                                  "add a model with a floor at that height",
                                  heights[heights.size() / 2], heights.size(), storey.doors)
                    : fmt::format("the floor slab at {:.2f} m is missing: {} of {} doors of storey '{}' have no floor "
                                  "on either side; add a model with a floor at that height",
                                  heights[heights.size() / 2], heights.size(), storey.doors, name));
  }
}

// In the frame of the file, unlike what the optimizer reports.
void reportTightPlaces(const Environment& environment, const CollideResult& result, const CollideOptions& options,
                       const Eigen::Vector3d& shift_m, Report& report) {
  for (const auto& room : result.rooms) {
    if (!room.tight_place) continue;
    const auto& low = *room.tight_place;
    const auto& product = environment.products[room.product];
    const Eigen::Vector3d p = low.position + shift_m;
    const auto where = fmt::format("({:.2f}, {:.2f}, {:.2f})", p.x(), p.y(), p.z());
    const bool too_low = low.passes_height_m < options.agent_height_m - 1e-6;
    report.warn(product.id,
                too_low ? fmt::format("room {} cannot be reached: headroom {:.2f} m at {}, agent {:.2f} m; a body of "
                                      "{:.1f} m with a radius of {:.2f} m passes",
                                      readableName(product), low.headroom_m, where, options.agent_height_m,
                                      low.passes_height_m, low.passes_radius_m)
                        : fmt::format("room {} cannot be reached: too narrow at {} for a radius of {:.2f} m; {:.2f} m "
                                      "passes",
                                      readableName(product), where, options.agent_radius_m, low.passes_radius_m));
  }
}

CollideAnswer answerOf(const Environment& environment, const CollideResult& result, const Eigen::Vector3d& shift_m) {
  CollideAnswer answer;
  for (std::size_t i = 0; i < result.products.size(); ++i)
    if (result.products[i].shapes != 0)
      answer.products.push_back({identityOf(environment.products[i]), result.products[i]});
  for (const auto& d : result.doors) {
    answer.doors.push_back({identityOf(environment.products[d.product]), d});
    answer.doors.back().position += shift_m;
  }
  for (const auto& r : result.rooms) {
    answer.rooms.push_back({identityOf(environment.products[r.product]), r});
    answer.rooms.back().position += shift_m;
    if (auto& low = answer.rooms.back().tight_place) low->position += shift_m;
  }
  answer.shapes = result.shapes.size();
  answer.walkable_area_m2 = result.walkable_area_m2;
  answer.doors_passable = passableDoors(result);
  return answer;
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

const AnswerFields<CollideProduct>& answerFields(const CollideProduct* product) {
  using A = CollideProduct;
  static const auto fields =
      withBases<A>({{"shapes", &A::shapes}, {"triangles", &A::triangles}, {"max_deviation_m", &A::max_deviation_m}},
                   answerFields(static_cast<const ProductIdentity*>(product)));
  return fields;
}

const AnswerFields<CollideDoor>& answerFields(const CollideDoor* door) {
  using A = CollideDoor;
  static const auto fields = withBases<A>({{"floor", &A::floor},
                                           {"passable", &A::passable},
                                           {"closed", &A::closed},
                                           {"led_through", &A::led_through},
                                           {"clear_width_m", &A::clear_width_m},
                                           {"at", &A::position}},
                                          answerFields(static_cast<const ProductIdentity*>(door)));
  return fields;
}

const AnswerFields<TightPlace>& answerFields(const TightPlace*) {
  using A = TightPlace;
  static const AnswerFields<A> fields = {{"at", &A::position},
                                         {"headroom_m", &A::headroom_m},
                                         {"passes_height_m", &A::passes_height_m},
                                         {"passes_radius_m", &A::passes_radius_m}};
  return fields;
}

const AnswerFields<CollideRoom>& answerFields(const CollideRoom* room) {
  using A = CollideRoom;
  static const auto fields = withBases<A>({{"walkable_m2", &A::walkable_m2},
                                           {"reached", &A::reached},
                                           {"at", &A::position},
                                           {"tight_place", &A::tight_place}},
                                          answerFields(static_cast<const ProductIdentity*>(room)));
  return fields;
}

const AnswerFields<CollideAnswer>& answerFields(const CollideAnswer*) {
  using A = CollideAnswer;
  static const AnswerFields<A> fields = {{"products", &A::products},
                                         {"shapes", &A::shapes},
                                         {"walkable_area_m2", &A::walkable_area_m2},
                                         {"doors", &A::doors},
                                         {"doors_passable", &A::doors_passable},
                                         {"rooms", &A::rooms}};
  return fields;
}

Result<Answered<CollideAnswer>> runCollide(const Document& document, const CollideVerbOptions& options,
                                           Progress& progress) {
  CollideOptions typed{options.agent_radius_m, options.agent_height_m, {}, {}};
  TRY(setDoors(document, options, typed));
  progress.stage("Collision shapes");
  // From the model as it came: walls that are still prisms give few convex pieces, and no doorway has been simplified.
  const auto& environment = *document.imported;
  const Eigen::Vector3d shift_m = document.georeference ? document.georeference->shift_m : Eigen::Vector3d::Zero();
  TRY_ASSIGN(auto result, collide(environment, typed, progress));
  Answered<CollideAnswer> outcome{document, answerOf(environment, result, shift_m), result.report};
  reportTightPlaces(environment, result, typed, shift_m, outcome.report);
  reportMissingSlabs(environment, result, typed, shift_m.z(), outcome.report);
  outcome.description =
      fmt::format("Created {} collision shapes; {:.1f} m² walkable, {} of {} doors passable", result.shapes.size(),
                  result.walkable_area_m2, passableDoors(result), result.doors.size());
  outcome.document.collision = std::make_shared<const CollideResult>(std::move(result));
  return outcome;
}

}  // namespace standpoint
