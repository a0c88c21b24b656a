// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/walk_ground.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace standpoint {

namespace {

using GroundPtr = std::shared_ptr<const WalkedGround>;

GroundPtr groundOf(std::shared_ptr<const Environment> environment, std::shared_ptr<const CollideResult> collision) {
  double lowest = 1e300;
  for (const auto& shape : collision->shapes)
    for (const auto& p : shape.mesh.positions) lowest = std::min(lowest, static_cast<double>(p.z()));
  auto spaces = spaceBodies(*environment);
  const auto door_of = doorOf(*environment);
  std::vector<CollisionShape> shapes;
  std::copy_if(collision->shapes.begin(), collision->shapes.end(), std::back_inserter(shapes),
               [&](const CollisionShape& shape) { return door_of[shape.product] < 0; });
  Obstacles obstacles(shapes);
  auto doors = std::make_shared<const DoorLeaves>(doorLeaves(*environment));
  return std::make_shared<const WalkedGround>(WalkedGround{
      std::move(environment), std::move(collision), std::move(obstacles), std::move(doors), std::move(spaces), lowest});
}

}  // namespace

bool WalkGround::isFor(const Document& document, const Body& body) const {
  return task_ && environment_ == document.imported && body_ == body;
}

void WalkGround::prepare(const Document& document, const Body& body, const std::function<void()>& wake) {
  if (!document.imported || document.collision || isFor(document, body)) return;
  environment_ = document.imported;
  body_ = body;
  task_ = std::make_unique<Task<GroundPtr>>(
      "Prepare the walkable surface",
      [environment = environment_, body](Progress& progress) -> Result<GroundPtr> {
        TRY_ASSIGN(auto made,
                   collide(*environment, {.agent_radius_m = body.radius_m, .agent_height_m = body.height_m}, progress));
        return groundOf(environment, std::make_shared<const CollideResult>(std::move(made)));
      },
      wake);
}

void WalkGround::cancel() {
  if (preparing()) task_->progress().cancel();
}

GroundPtr WalkGround::of(const Document& document, const Body& body) const {
  if (document.collision && document.imported) {
    if (!of_document_ || of_document_->collision != document.collision ||
        of_document_->environment != document.imported)
      of_document_ = groundOf(document.imported, document.collision);
    return of_document_;
  }
  of_document_.reset();
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
