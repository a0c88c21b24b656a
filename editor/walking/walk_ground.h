// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>

#include "optimizer/walk/door_leaves.h"
#include "optimizer/walk/landing.h"
#include "optimizer/walk/obstacles.h"
#include "optimizer/walk/spaces.h"
#include "optimizer/walk/walkable_map.h"
#include "project/document.h"
#include "project/task.h"

namespace standpoint {

// What one walks on and between.
struct WalkedGround {
  std::shared_ptr<const Environment> environment;
  std::shared_ptr<const CollideResult> collision;
  Obstacles obstacles;  // without doors, which open
  std::shared_ptr<const DoorLeaves> doors;
  std::vector<SpaceBody> spaces;
  WalkableMap map;
  double lowest_m = 0;
};

// landingAt(), but neither on a roof nor, where the walkable surface has no place, under the open sky, upright, or on
// what is no floor: on top of a wall, a table, a railing. Where one must crouch that surface knows nothing.
Landing landingOn(const WalkedGround& ground, const Body& body, const Eigen::Vector3d& point,
                  const Eigen::Vector3d& normal);

// The document's collision shapes, made ready to walk between. Where it has none, they are computed beside the
// interface for this view alone: that somebody looked around is no change of the document, and no step to undo.
class WalkGround {
 public:
  // Starts where nothing is there or under way.
  void prepare(const Document& document, const Body& body, const std::function<void()>& wake);
  void cancel();
  // For this document and body; null until it is there.
  std::shared_ptr<const WalkedGround> of(const Document& document, const Body& body) const;
  bool preparing() const { return task_ && !task_->done() && !task_->progress().cancelled(); }
  double fraction() const { return task_ ? task_->progress().fraction() : 0; }
  void wait() {
    if (task_) task_->wait();
  }
  // Once, when it could not be prepared.
  std::optional<Error> takeError();

 private:
  bool isFor(const Document& document, const Body& body) const;

  std::shared_ptr<const Environment> environment_;  // of the task
  Body body_;
  std::unique_ptr<Task<std::shared_ptr<const WalkedGround>>> task_;
  mutable std::shared_ptr<const WalkedGround> of_document_;  // of the shapes that it has itself
};

}  // namespace standpoint
