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
  WalkableMap crouched_map;  // of whoever crouches; the other one has none of what is lower than the body
  double lowest_m = 0;
};

// landingAt(), but neither on a roof nor where the walkable surface has no place, not even for whoever crouches.
Landing landingOn(const WalkedGround& ground, const Body& body, const Eigen::Vector3d& point,
                  const Eigen::Vector3d& normal);

// The document's collision shapes, made ready to walk between beside the interface. Where it has none, they are
// computed for this view alone: that somebody looked around is no change of the document, and no step to undo.
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
  std::shared_ptr<const CollideResult> collision_;  // likewise; null where the document has none
  Body body_;
  std::unique_ptr<Task<std::shared_ptr<const WalkedGround>>> task_;
};

}  // namespace standpoint
