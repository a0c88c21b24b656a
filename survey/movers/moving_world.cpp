// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/movers/moving_world.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "core/motion/limbs.h"
#include "core/motion/mechanisms.h"
#include "core/motion/paced_way.h"
#include "core/motion/walked_path.h"
#include "core/random.h"
#include "core/units.h"
#include "optimizer/walk/door_leaves.h"
#include "survey/movers/mover_shapes.h"

namespace standpoint {

namespace {

constexpr double kPause_s = 1;             // where somebody turns back
constexpr double kOperatorBehind_m = 0.4;  // the scanner that is held in front

// Speed and stride are those of somebody who has somewhere to go.
PathLimits limitsOf(const Mover& mover) {
  PathLimits limits{.height_m = 0, .speed_mps = mover.speed > 0 ? mover.speed : usualSpeed(mover.kind)};
  if (mover.kind == MoverKind::person) {
    limits.turn_radps = std::numbers::pi;
    limits.lateral_mps2 = 1.5, limits.acceleration_mps2 = 1.2, limits.jerk_mps3 = 6;
    return limits;
  }
  limits.turn_radps = std::numbers::pi / 4;
  limits.lateral_mps2 = 2, limits.acceleration_mps2 = 1.5, limits.jerk_mps3 = 3, limits.blend_m = 2;
  return limits;
}

PhysicalMaterial matt(const char* id, const char* label, double reflectance) {
  PhysicalMaterial m;
  m.id = id;
  m.label = label;
  m.reflectance = {{550, reflectance}};
  m.sources = {{"reflectance", "unsourced: engineering value", ""}};
  return m;
}

// A world that is being added to.
class Addition {
 public:
  explicit Addition(ScanWorld& world)
      : world_(world), environment_(std::make_shared<Environment>(*world.environment)) {}
  ~Addition() { world_.environment = std::move(environment_); }
  Addition(const Addition&) = delete;
  Addition& operator=(const Addition&) = delete;

  Environment& environment() { return *environment_; }
  std::uint32_t product(const std::string& name, const char* ifc_class) {
    Product p;
    p.id = std::string("mover ") + name;
    p.name = name;
    p.ifc_class = ifc_class;
    environment_->products.push_back(std::move(p));
    return static_cast<std::uint32_t>(environment_->products.size() - 1);
  }
  std::uint32_t surface(const char* name, float grey, const PhysicalMaterial& material) {
    auto& surfaces = environment_->surfaces;
    surfaces.push_back({name, {grey, grey, grey, 1}, "mover", {}, {}});
    materials_.push_back(static_cast<std::int32_t>(world_.assignment.materials.size()));
    world_.assignment.materials.push_back(material);
    surfaces_.push_back(static_cast<std::uint32_t>(surfaces.size() - 1));
    return surfaces_.back();
  }
  std::uint32_t mesh(Mesh mesh, std::uint32_t surface) {
    std::fill(mesh.surface_of_triangle.begin(), mesh.surface_of_triangle.end(), surface);
    environment_->meshes.push_back(std::make_shared<const Mesh>(std::move(mesh)));
    return static_cast<std::uint32_t>(environment_->meshes.size() - 1);
  }
  void assign(std::uint32_t product, std::uint32_t surface) {
    const auto at = std::find(surfaces_.begin(), surfaces_.end(), surface) - surfaces_.begin();
    world_.assignment.surfaces.push_back({product, surface, materials_[static_cast<std::size_t>(at)], "mover", 1});
  }
  void body(std::uint32_t product, std::uint32_t mesh, PoseFunctionPtr how, double from_s) {
    Instance instance;
    instance.mesh = mesh, instance.product = product;
    world_.bodies.push_back({{static_cast<std::uint32_t>(environment_->instances.size())}, std::move(how), from_s});
    environment_->instances.push_back(instance);
  }

 private:
  ScanWorld& world_;
  std::shared_ptr<Environment> environment_;
  std::vector<std::uint32_t> surfaces_;
  std::vector<std::int32_t> materials_;
};

// Somebody's limbs, and what they wear.
class People {
 public:
  explicit People(Addition& to) : to_(to) {}
  void add(const std::string& name, const char* ifc_class, const std::vector<PoseFunctionPtr>& limbs, double begins_s,
           bool repeats) {
    if (meshes_.empty()) {
      surface_ = to_.surface("clothes", 0.45F, matt("clothes", "Clothes", 0.45));
      for (const Limb limb : kLimbs) meshes_.push_back(to_.mesh(limbMesh(limb), surface_));
    }
    const std::uint32_t product = to_.product(name, ifc_class);
    to_.assign(product, surface_);
    for (std::size_t k = 0; k < kLimbs.size(); ++k)
      to_.body(product, meshes_[k], std::make_shared<TimedPose>(limbs[k], begins_s, repeats),
               -std::numeric_limits<double>::infinity());
  }

 private:
  Addition& to_;
  std::uint32_t surface_ = 0;
  std::vector<std::uint32_t> meshes_;
};

// There and, where it repeats, back again.
std::vector<Waypoint> wayOf(const Mover& mover) {
  std::vector<Waypoint> way = mover.waypoints;
  if (!mover.repeats) return way;
  way.back().stop_s = std::max(way.back().stop_s, kPause_s);
  for (std::size_t k = mover.waypoints.size() - 1; k-- > 0;) way.push_back(mover.waypoints[k]);
  return way;
}

Result<std::shared_ptr<const PoseSpline>> onFloor(const Mover& mover) {
  if (!mover.way_m.empty()) {
    auto paced = pacedWay(mover.way_m, kWayStep_s, mover.repeats);
    if (!paced) return failure(paced.error().kind, paced.error().message, mover.name);
    return std::make_shared<const PoseSpline>(std::move(*paced));
  }
  const std::vector<Waypoint> way = wayOf(mover);
  auto walked = walkPath(way, limitsOf(mover));
  if (!walked) return failure(walked.error().kind, walked.error().message, mover.name);
  return std::make_shared<const PoseSpline>(std::move(walked->poses));
}

MotionKey keyOf(const std::string& name, std::uint64_t seed) {
  return {seed, static_cast<std::uint32_t>(stableHash(name.c_str())), MotionProcess::gait};
}

std::vector<PoseFunctionPtr> limbsOf(const PoseFunctionPtr& path, const MotionKey& key) {
  const auto stride = std::make_shared<const Stride>(*path, key);
  std::vector<PoseFunctionPtr> limbs;
  for (const Limb limb : kLimbs) limbs.push_back(std::make_shared<LimbPose>(path, stride, limb));
  return limbs;
}

Result<std::uint32_t> productOf(const Environment& environment, const std::string& id, const std::string& mover) {
  const auto product = std::find_if(environment.products.begin(), environment.products.end(),
                                    [&](const Product& p) { return p.id == id || p.global_id == id; });
  if (product != environment.products.end()) return static_cast<std::uint32_t>(product - environment.products.begin());
  return failure(ErrorKind::unusable,
                 fmt::format("the model has no product '{}' any more; remove the mover or add it anew", id), mover);
}

Result<void> addMachine(const Mover& mover, Addition& to, std::vector<MovingBody>& bodies) {
  const Environment& environment = to.environment();
  MovingBody body;
  for (const std::string& id : mover.products) {
    TRY_ASSIGN(const auto number, productOf(environment, id, mover.name));
    for (std::uint32_t i = 0; i < environment.instances.size(); ++i)
      if (environment.instances[i].product == number) body.instances.push_back(i);
  }
  for (const MovingBody& other : bodies)
    for (const std::uint32_t i : body.instances)
      if (std::find(other.instances.begin(), other.instances.end(), i) != other.instances.end())
        return failure(ErrorKind::unusable, "another mover moves the same product", mover.name);
  const auto way = mover.kind == MoverKind::turning ? DrivenPose::Way::turning : DrivenPose::Way::sliding;
  const double speed = mover.speed > 0 ? mover.speed : usualSpeed(mover.kind);
  body.local_from_rest = std::make_shared<DrivenPose>(way, mover.axis_at_m, mover.axis,
                                                      Drive{speed, mover.extent, mover.repeats, mover.begins_s});
  bodies.push_back(std::move(body));
  return {};
}

// The doors whose leaves move are cut into leaves and what stands still. What is said of instances by their number is
// set right.
Result<void> addDoors(const std::vector<Mover>& movers, ScanWorld& world) {
  if (std::none_of(movers.begin(), movers.end(), [](const Mover& m) { return m.kind == MoverKind::door; })) return {};
  const Environment& before = *world.environment;
  const DoorLeaves cut = doorLeaves(before);
  std::vector<const Mover*> mover_of(before.products.size(), nullptr);
  for (const Mover& mover : movers) {
    if (mover.kind != MoverKind::door) continue;
    for (const std::string& id : mover.products) {
      TRY_ASSIGN(const auto product, productOf(before, id, mover.name));
      const auto of_door = [&](const DoorLeaf& leaf) { return cut.doors[leaf.door].product == product; };
      if (std::none_of(cut.leaves.begin(), cut.leaves.end(), of_door))
        return failure(ErrorKind::unusable,
                       fmt::format("the door '{}' has no leaf that could be told from its frame", id), mover.name);
      if (mover_of[product] != nullptr)
        return failure(ErrorKind::unusable, "another mover moves the same product", mover.name);
      mover_of[product] = &mover;
    }
  }
  auto environment = std::make_shared<Environment>(before);
  const auto first_mesh = static_cast<std::uint32_t>(environment->meshes.size());
  environment->meshes.insert(environment->meshes.end(), cut.scene.meshes.begin(), cut.scene.meshes.end());
  std::vector<std::uint32_t> now(before.instances.size(), 0);
  std::map<std::int32_t, MovingBody> bodies;  // by leaf
  environment->instances.clear();
  for (std::uint32_t i = 0; i < before.instances.size(); ++i) {
    const std::uint32_t product = before.instances[i].product;
    now[i] = static_cast<std::uint32_t>(environment->instances.size());
    if (mover_of[product] == nullptr) {
      environment->instances.push_back(before.instances[i]);
      continue;
    }
    if (i > 0 && before.instances[i - 1].product == product) continue;
    for (std::size_t k = 0; k < cut.scene.instances.size(); ++k) {
      if (cut.scene.instances[k].product != product) continue;
      if (const std::int32_t leaf = cut.leaf_of_instance[k]; leaf >= 0)
        bodies[leaf].instances.push_back(static_cast<std::uint32_t>(environment->instances.size()));
      environment->instances.push_back(cut.scene.instances[k]);
      environment->instances.back().mesh += first_mesh;
    }
  }
  for (RoundInstance& ball : world.balls) ball.instance = now[ball.instance];
  for (auto& [number, body] : bodies) {
    const DoorLeaf& leaf = cut.leaves[static_cast<std::size_t>(number)];
    const Mover& mover = *mover_of[cut.doors[leaf.door].product];
    const double speed = mover.speed > 0 ? mover.speed : usualSpeed(mover.kind);
    body.local_from_rest =
        std::make_shared<DrivenPose>(DrivenPose::Way::turning, leaf.hinge, Eigen::Vector3d(0, 0, leaf.turn),
                                     Drive{speed, mover.extent, mover.repeats, mover.begins_s});
    world.bodies.push_back(std::move(body));
  }
  world.environment = std::move(environment);
  return {};
}

// Below or behind the scanner, on the floor.
class OperatorPose final : public PoseFunction {
 public:
  OperatorPose(PoseFunctionPtr scanner, const Eigen::Vector3d& off) : scanner_(std::move(scanner)), off_(off) {}
  Pose pose(double time_s) const override {
    const Pose scanner = scanner_->pose(time_s);
    return {scanner.rotation, scanner * off_};
  }
  double first_s() const override { return scanner_->first_s(); }
  double last_s() const override { return scanner_->last_s(); }

 private:
  PoseFunctionPtr scanner_;
  Eigen::Vector3d off_;
};

}  // namespace

double usualSpeed(MoverKind kind) {
  switch (kind) {
    case MoverKind::person: return 1.34;  // free speed of pedestrians, unsourced
    case MoverKind::vehicle: return 8.3;  // 30 km/h
    case MoverKind::door:
    case MoverKind::turning: return kRadPerTurn / 8;
    case MoverKind::sliding: return 0.5;
  }
  return 1;
}

Result<PoseFunctionPtr> moverPath(const Mover& mover) {
  TRY_ASSIGN(auto path, onFloor(mover));
  return std::make_shared<const TimedPose>(std::move(path), mover.begins_s, mover.repeats);
}

Result<void> addMovers(const std::vector<Mover>& movers, ScanWorld& world) {
  if (movers.empty()) return {};
  TRY(addDoors(movers, world));
  Addition addition(world);
  People people(addition);
  std::optional<std::uint32_t> paint, vehicle;
  for (const Mover& mover : movers) {
    if (mover.kind == MoverKind::door) continue;
    if (mover.kind == MoverKind::turning || mover.kind == MoverKind::sliding) {
      TRY(addMachine(mover, addition, world.bodies));
      continue;
    }
    TRY_ASSIGN(const auto path, onFloor(mover));
    if (mover.kind == MoverKind::person) {
      people.add(mover.name, "Person", limbsOf(path, keyOf(mover.name, mover.seed)), mover.begins_s, mover.repeats);
      continue;
    }
    if (!vehicle) {
      paint = addition.surface("car paint", 0.5F, matt("car_body", "Car body, matt", 0.35));
      vehicle = addition.mesh(vehicleMesh(), *paint);
    }
    const std::uint32_t product = addition.product(mover.name, "Vehicle");
    addition.assign(product, *paint);
    addition.body(product, *vehicle, std::make_shared<TimedPose>(path, mover.begins_s, mover.repeats),
                  -std::numeric_limits<double>::infinity());
  }
  return {};
}

PoseFunctionPtr operatorPath(const PoseFunctionPtr& scanner_path, double height_m, bool carried_in_front) {
  return std::make_shared<const OperatorPose>(scanner_path,
                                              Eigen::Vector3d(carried_in_front ? -kOperatorBehind_m : 0, 0, -height_m));
}

std::vector<PoseFunctionPtr> operatorLimbs(const PoseFunctionPtr& scanner_path, double height_m,
                                           bool carried_in_front) {
  return limbsOf(operatorPath(scanner_path, height_m, carried_in_front), keyOf("operator", 1));
}

void addOperator(const PoseFunctionPtr& scanner_path, double height_m, bool carried_in_front, double ahead_s,
                 ScanWorld& world) {
  Addition addition(world);
  People people(addition);
  people.add("Operator", "Operator", operatorLimbs(scanner_path, height_m, carried_in_front),
             scanner_path->first_s() + ahead_s, false);
}

}  // namespace standpoint
