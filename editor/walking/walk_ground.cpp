// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/walking/walk_ground.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>
#include <vector>

#include "core/ceiling.h"
#include "optimizer/walk/walkable.h"
#include "optimizer/walk/walker.h"

namespace standpoint {

namespace {

using GroundPtr = std::shared_ptr<const WalkedGround>;

Result<GroundPtr> groundOf(std::shared_ptr<const Environment> environment,
                           std::shared_ptr<const CollideResult> collision, const Body& body, Progress& progress) {
  double lowest = 1e300;
  for (const auto& shape : collision->shapes)
    for (const auto& p : shape.mesh.positions) lowest = std::min(lowest, static_cast<double>(p.z()));
  auto spaces = spaceBodies(*environment);
  const auto door_of = doorOf(*environment);
  std::vector<CollisionShape> shapes;
  std::copy_if(collision->shapes.begin(), collision->shapes.end(), std::back_inserter(shapes),
               [&](const CollisionShape& shape) { return door_of[shape.product] < 0; });
  progress.stage("Find the walkable surface", progress.fraction());
  const CollideOptions crouched{.agent_radius_m = body.radius_m,
                                .agent_height_m = std::min(Walker::kCrouched_m, body.height_m)};
  TRY_ASSIGN(const auto low, walkableSurface(shapes, roofsAndCeilings(*environment), crouched, progress));
  Obstacles obstacles(shapes);
  auto doors = std::make_shared<const DoorLeaves>(doorLeaves(*environment));
  WalkableMap map(collision->walkable);
  return std::make_shared<const WalkedGround>(WalkedGround{std::move(environment), std::move(collision),
                                                           std::move(obstacles), std::move(doors), std::move(spaces),
                                                           std::move(map), WalkableMap(low.mesh), lowest});
}

// On the surface, or on its rim, where it and the body's own sweeps differ by a cell and a skin.
bool isNear(const WalkableMap& map, const Eigen::Vector3d& feet) {
  constexpr double kRim_m = 0.07;
  constexpr int kAround = 16;
  for (int i = 0; i < kAround; ++i) {
    const double angle = 2 * std::numbers::pi * i / kAround;
    if (map.under(feet + kRim_m * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0))) return true;
  }
  return map.under(feet).has_value();
}

}  // namespace

Landing landingOn(const WalkedGround& ground, const Body& body, const Eigen::Vector3d& point,
                  const Eigen::Vector3d& normal) {
  Landing landing = landingAt(ground.obstacles, body, point, normal);
  if (!landing.why_not.empty()) return landing;
  if (isRoofOrCeiling(*ground.environment, landing.product))
    landing.why_not = "on a roof";
  else if (!isNear(ground.map, landing.feet) && !isNear(ground.crouched_map, landing.feet))
    landing.why_not = "outside the walkable surface";
  return landing;
}

bool WalkGround::isFor(const Document& document, const Body& body) const {
  return task_ && environment_ == document.imported && collision_ == document.collision && body_ == body;
}

void WalkGround::prepare(const Document& document, const Body& body, const std::function<void()>& wake) {
  if (!document.imported || (isFor(document, body) && !task_->progress().cancelled())) return;
  environment_ = document.imported;
  collision_ = document.collision;
  body_ = body;
  task_ = std::make_unique<Task<GroundPtr>>(
      "Prepare the walkable surface",
      [environment = environment_, collision = collision_, body](Progress& progress) -> Result<GroundPtr> {
        if (collision) return groundOf(environment, collision, body, progress);
        TRY_ASSIGN(auto made,
                   collide(*environment, {.agent_radius_m = body.radius_m, .agent_height_m = body.height_m}, progress));
        return groundOf(environment, std::make_shared<const CollideResult>(std::move(made)), body, progress);
      },
      wake);
}

void WalkGround::cancel() {
  if (preparing()) task_->progress().cancel();
}

GroundPtr WalkGround::of(const Document& document, const Body& body) const {
  if (!isFor(document, body) || !task_->done() || !task_->result()) return nullptr;
  return *task_->result();
}

std::optional<Error> WalkGround::takeError() {
  if (!task_ || !task_->done() || task_->result()) return std::nullopt;
  auto error = task_->result().error();
  task_.reset();
  return error;
}

}  // namespace standpoint
