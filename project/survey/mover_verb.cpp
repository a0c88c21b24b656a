// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/motion/carriers.h"
#include "core/motion/mechanisms.h"
#include "core/units.h"
#include "optimizer/walk/door_leaves.h"
#include "project/answers.h"
#include "project/survey/clicked_places.h"
#include "project/survey/survey_verbs.h"
#include "survey/movers/crowd.h"
#include "survey/movers/moving_world.h"
#include "survey/trajectories/carried_motion.h"

namespace standpoint {

namespace {

constexpr double kPersonHeight_m = 1.8, kVehicleHeight_m = 1.5;
// What a crowd leaves free of those who make no way themselves; unsourced.
constexpr double kTripodRoom_m = 0.45, kWalkerRoom_m = 0.4, kVehicleRoom_m = 2;

constexpr std::array<const char*, 5> kKinds = {"person", "vehicle", "door", "turning", "sliding"};

const char* textOf(MoverKind kind) { return kKinds[static_cast<std::size_t>(kind)]; }

bool isOf(const Mover& mover, const std::string& name) {
  return mover.name == name || (mover.name.starts_with(name + " ") &&
                                mover.name.find_first_not_of("0123456789", name.size() + 1) == std::string::npos);
}

// By id or GlobalId, else by a name that no other product in the scene has.
auto productNamed(const Environment& environment, const std::string& wanted) {
  const auto& products = environment.products;
  const auto by_id = std::find_if(products.begin(), products.end(), [&](const Product& p) {
    return p.inScene() && (p.id == wanted || p.global_id == wanted);
  });
  if (by_id != products.end()) return by_id;
  const auto named = [&](const Product& p) { return p.inScene() && p.name == wanted; };
  const auto first = std::find_if(products.begin(), products.end(), named);
  if (first == products.end()) return first;
  return std::find_if(std::next(first), products.end(), named) == products.end() ? first : products.end();
}

Result<std::vector<std::string>> productsOf(const Environment& environment, const std::vector<std::string>& wanted,
                                            bool doors) {
  if (wanted.empty()) return failure(ErrorKind::usage, "name what moves by its id, GlobalId or name", "--product");
  const DoorLeaves leaves = doors ? doorLeaves(environment) : DoorLeaves{};
  std::vector<std::string> ids;
  for (const std::string& id : wanted) {
    const auto product = productNamed(environment, id);
    if (product == environment.products.end())
      return failure(ErrorKind::usage, fmt::format("the model has no product '{}' in the scene", id), "--product");
    const auto number = static_cast<std::uint32_t>(product - environment.products.begin());
    const auto of_product = [&](const DoorLeaf& leaf) { return leaves.doors[leaf.door].product == number; };
    if (doors && std::none_of(leaves.leaves.begin(), leaves.leaves.end(), of_product))
      return failure(ErrorKind::usage, fmt::format("'{}' is no door with a leaf that could be told from its frame", id),
                     "--product");
    ids.push_back(product->id);
  }
  return ids;
}

double radiusOf(const Mover& mover) {
  if (mover.kind == MoverKind::vehicle) return kVehicleRoom_m;
  return mover.way_m.empty() ? kWalkerRoom_m : kBodyDiameter_m / 2;
}

// Who carries a scanner along that trajectory, from the movers' 0 s on.
Result<CrowdObstacle> obstacleOf(const Document& document, const std::string& name, double& until_s, Report& report,
                                 Progress& progress) {
  constexpr const char* kOption = "--gives-way-to";
  const auto& trajectories = document.job->trajectories;
  const auto trajectory = std::find_if(trajectories.begin(), trajectories.end(),
                                       [&](const CarriedTrajectory& t) { return t.name == name; });
  if (trajectory == trajectories.end())
    return failure(ErrorKind::usage, fmt::format("unknown trajectory '{}'", name), kOption);
  const Carrier* const carrier = carrierOf(trajectory->carrier);
  if (carrier == nullptr || carrier->id == "uav")
    return failure(ErrorKind::usage, fmt::format("nobody on the floor carries a scanner along '{}'", name), kOption);
  TRY_ASSIGN(const auto carried, carriedMotion(*trajectory, *document.georeference, report, progress));
  const double height = carriedHeight_m(trajectory->carrier, trajectory->height_m);
  const PoseFunctionPtr path = operatorPath(carried.path, height, carrier->id == "hand");
  until_s = std::max(until_s, carried.seconds());
  return CrowdObstacle{std::make_shared<const TimedPose>(path, 0, false),
                       carrier->id == "vehicle" ? kVehicleRoom_m : kWalkerRoom_m};
}

// What a crowd makes way for: tripods, people and vehicles that are there already, and those who carry a scanner.
Result<std::vector<CrowdObstacle>> inTheWay(const Document& document, const MoverOptions& options, double& until_s,
                                            Report& report, Progress& progress) {
  std::vector<CrowdObstacle> obstacles;
  for (const Station& station : document.job->stations) {
    Pose floor = station.true_pose;
    floor.translation.z() -= station.instrument_height_m;
    obstacles.push_back({std::make_shared<const ConstantPose>(floor), kTripodRoom_m});
  }
  for (const Mover& mover : document.job->movers) {
    if (mover.kind != MoverKind::person && mover.kind != MoverKind::vehicle) continue;
    TRY_ASSIGN(auto path, moverPath(mover));
    obstacles.push_back({std::move(path), radiusOf(mover)});
  }
  for (const std::string& name : options.gives_way_to) {
    TRY_ASSIGN(auto carrier, obstacleOf(document, name, until_s, report, progress));
    obstacles.push_back(std::move(carrier));
  }
  return obstacles;
}

Result<std::vector<Mover>> crowd(const Document& document, const MoverOptions& options, Report& report,
                                 Progress& progress) {
  const Mesh* const walkable = document.walkable();
  if (walkable == nullptr || walkable->triangles.empty())
    return failure(ErrorKind::unusable,
                   "a crowd walks on the walkable surface, and there is none; make it with 'collide' first");
  CrowdWish wish{.name = *options.add, .count = options.count, .speed_mps = options.speed_mps.value_or(0)};
  wish.seed = options.seed;
  TRY_ASSIGN(const auto obstacles, inTheWay(document, options, wish.until_s, report, progress));
  return crowdOn(*walkable, wish, obstacles, report, progress);
}

Result<Mover> machine(const Document& document, const MoverOptions& options, Mover mover) {
  TRY_ASSIGN(mover.products, productsOf(*document.environment(), options.products, mover.kind == MoverKind::door));
  const bool slides = mover.kind == MoverKind::sliding;
  if (slides && (options.turn_dps || options.angle_deg))
    return failure(ErrorKind::usage, "what slides has --speed and --way", "--turn");
  if (!slides && (options.speed_mps || options.way_m))
    return failure(ErrorKind::usage, "what turns has --turn and --angle", "--speed");
  mover.speed = slides ? options.speed_mps.value_or(0) : options.turn_dps.value_or(0) * kRadPerDeg;
  mover.extent = slides ? options.way_m.value_or(0) : options.angle_deg.value_or(0) * kRadPerDeg;
  if (mover.kind == MoverKind::door) {
    if (!options.angle_deg) mover.extent = kRadPerTurn / 4;
    return mover;
  }
  if (slides && mover.extent == 0) return failure(ErrorKind::usage, "say how far it slides", "--way");
  if (options.axis) mover.axis = *options.axis;
  if (!(mover.axis.norm() > 1e-9)) return failure(ErrorKind::usage, "the axis has no direction", "--axis");
  mover.axis.normalize();
  if (!slides && !options.axis_at)
    return failure(ErrorKind::usage, "say where its axis is, as X,Y,Z in the model's own frame", "--axis-at");
  if (options.axis_at) mover.axis_at_m = *options.axis_at - document.georeference->shift_m;
  return mover;
}

Result<std::vector<Mover>> newMovers(const Document& document, const MoverOptions& options, Report& report,
                                     Progress& progress) {
  if (options.kind == "crowd") return crowd(document, options, report, progress);
  if (!options.gives_way_to.empty())
    return failure(ErrorKind::usage, "only a crowd gives way; specify --kind crowd", "--gives-way-to");
  Mover mover{.name = *options.add};
  const auto kind = std::find(kKinds.begin(), kKinds.end(), options.kind);
  if (kind != kKinds.end()) mover.kind = static_cast<MoverKind>(kind - kKinds.begin());
  mover.repeats = options.repeat;
  mover.begins_s = options.begin_s;
  mover.seed = options.seed;
  if (mover.kind != MoverKind::person && mover.kind != MoverKind::vehicle) {
    if (!options.through.empty()) return failure(ErrorKind::usage, "only people and vehicles have a way", "--through");
    TRY_ASSIGN(mover, machine(document, options, mover));
    return std::vector<Mover>{mover};
  }
  if (options.through.size() < 2)
    return failure(ErrorKind::usage, "specify at least two places as X,Y or X,Y,Z", "--through");
  if (!options.products.empty())
    return failure(ErrorKind::usage, "people and vehicles have bodies of their own", "--product");
  mover.speed = options.speed_mps.value_or(0);
  TRY_ASSIGN(const auto scene, RayScene::build(document.environment(), progress));
  const double height = mover.kind == MoverKind::person ? kPersonHeight_m : kVehicleHeight_m;
  TRY_ASSIGN(mover.waypoints, waypointsOf(options.through, *scene, *document.georeference, height, "--through"));
  TRY(moverPath(mover));
  return std::vector<Mover>{mover};
}

MoverRow rowOf(const Mover& mover) {
  MoverRow row{mover.name, textOf(mover.kind), mover.waypoints.size(), mover.products.size(), mover.begins_s, {}};
  if (mover.kind != MoverKind::person && mover.kind != MoverKind::vehicle) {
    const double speed = mover.speed > 0 ? mover.speed : usualSpeed(mover.kind);
    if (mover.extent != 0 && !mover.repeats) row.seconds = 1.5 * std::abs(mover.extent) / speed;
    return row;
  }
  if (const auto path = moverPath(mover); path && !mover.repeats) row.seconds = (*path)->last_s() - (*path)->first_s();
  return row;
}

}  // namespace

const Fields<MoverOptions>& moverFields() {
  using O = MoverOptions;
  static const Fields<O> fields = {
      {"add", &O::add, "name of a new mover"},
      {"kind",
       &O::kind,
       "what it is; a crowd is people who walk about at random on the walkable surface",
       {.choices = {"person", "crowd", "vehicle", "door", "turning", "sliding"}}},
      {"through", &O::through,
       "places on the floor that a person or a vehicle passes, X,Y or X,Y,Z in the model's own frame; X,Y:SECONDS "
       "stops there"},
      {"product", &O::products, "ids, GlobalIds or unique names of the doors, or of what turns or slides"},
      {"axis-at", &O::axis_at, "a place on the axis of what turns, in the model's own frame", {.unit = "m"}},
      {"axis", &O::axis, "direction of the axis of what turns, or in which something slides; without it upwards"},
      {"speed",
       &O::speed_mps,
       "at most; without it 1.34 on foot, 8.3 of a vehicle",
       {.unit = "m/s", .minimum = 0.01, .maximum = 100}},
      {"turn",
       &O::turn_dps,
       "how fast it turns, at most; without it 45",
       {.unit = "deg/s", .minimum = 0.01, .maximum = 36000}},
      {"angle",
       &O::angle_deg,
       "how far it turns, and a door 90 without it; 0: on and on",
       {.unit = "deg", .minimum = -3600, .maximum = 3600}},
      {"way", &O::way_m, "how far it slides", {.unit = "m", .minimum = -1000, .maximum = 1000}},
      {"repeat", &O::repeat, "there and back again and again"},
      {"begin", &O::begin_s, "when it begins, by the movers' clock", {.unit = "s", .minimum = -1e6, .maximum = 1e6}},
      {"count", &O::count, "people in a crowd", {.minimum = 1, .maximum = 1000}},
      {"gives-way-to", &O::gives_way_to,
       "trajectories whose carriers a crowd gives way to, from 0 s of the movers' clock on"},
      {"seed", &O::seed, "of a crowd's ways and of strides", {.minimum = 0, .maximum = 9007199254740991.0}},
      {"remove", &O::remove, "name of a mover, or of a crowd, to remove"}};
  return fields;
}

const AnswerFields<MoverRow>& answerFields(const MoverRow*) {
  using A = MoverRow;
  static const AnswerFields<A> fields = {{"name", &A::name},           {"kind", &A::kind},
                                         {"waypoints", &A::waypoints}, {"products", &A::products},
                                         {"begins_s", &A::begins_s},   {"seconds", &A::seconds}};
  return fields;
}

const AnswerFields<MoverAnswer>& answerFields(const MoverAnswer*) {
  using A = MoverAnswer;
  static const AnswerFields<A> fields = {{"movers", &A::movers}};
  return fields;
}

Result<Answered<MoverAnswer>> runMover(const Document& document, const MoverOptions& options, Progress& progress) {
  progress.stage("Movers");
  if (options.add && options.remove) return failure(ErrorKind::usage, "specify one of --add NAME, --remove NAME");
  if (!options.add && (!options.through.empty() || !options.products.empty()))
    return failure(ErrorKind::usage, "name the new mover with --add NAME", "--add");
  Answered<MoverAnswer> outcome{document};
  Job job = *document.job;
  const std::string name = options.add ? *options.add : options.remove.value_or("");
  const bool known = std::any_of(job.movers.begin(), job.movers.end(), [&](const Mover& m) { return isOf(m, name); });
  if (options.add) {
    if (name.empty() || name.find_first_of("/\\:,\"\n") != std::string::npos)
      return failure(ErrorKind::usage, fmt::format("'{}' cannot be a mover's name", name), "--add");
    if (known) return failure(ErrorKind::usage, fmt::format("there is a mover '{}' already", name), "--add");
    TRY_ASSIGN(auto made, newMovers(document, options, outcome.report, progress));
    std::move(made.begin(), made.end(), std::back_inserter(job.movers));
    outcome.description = "Added mover " + name;
  } else if (options.remove) {
    if (!known) {
      std::string names;
      for (const auto& m : job.movers) names += (names.empty() ? "" : ", ") + m.name;
      return failure(ErrorKind::usage,
                     fmt::format("unknown mover '{}'; available: {}", name, names.empty() ? "none" : names),
                     "--remove");
    }
    std::erase_if(job.movers, [&](const Mover& m) { return isOf(m, name); });
    outcome.description = "Removed mover " + name;
  }
  for (const auto& m : job.movers) outcome.answer.movers.push_back(rowOf(m));
  if (options.add || options.remove) outcome.document.job = std::make_shared<const Job>(std::move(job));
  return outcome;
}

}  // namespace standpoint
