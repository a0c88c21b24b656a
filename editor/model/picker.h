// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "editor/camera/camera.h"
#include "editor/model/view_state.h"
#include "project/task.h"
#include "scanners/engine/ray_engine.h"

namespace standpoint {

// Whether `view` shows this place of a product: it is neither hidden nor cut away.
bool isShown(const ViewState& view, std::uint32_t product, const Eigen::Vector3d& place);
// The first surface of the scene that `view` shows: what is hidden or cut away lets the ray through.
std::optional<RayHit> firstShown(const RayScene& scene, const ViewRay& ray, const ViewState& view);

// Of doors that are drawn apart, as they stand, what the ray meets first, if it does within that range.
std::optional<RayHit> firstDoor(const Environment& doors, const ViewRay& ray, double within_m);

// Picks with the rays that the scanners use, so that what is clicked is what a beam would meet. The scene is built
// beside the interface; until it is ready nothing can be picked.
class Picker {
 public:
  // Builds anew when the environment is another one. `wake` is called from the builder when it is done.
  void follow(const std::shared_ptr<const Environment>& environment, const std::function<void()>& wake);
  bool ready() const { return task_ && task_->done() && task_->result(); }
  void wait() {
    if (task_) task_->wait();
  }
  // Of what it follows; null until it is ready.
  std::shared_ptr<const RayScene> scene() const { return ready() ? *task_->result() : nullptr; }

  // As firstShown(); none where the view is of another environment.
  std::optional<RayHit> pick(const ViewRay& ray, const ViewState& view) const;
  // Is there nothing visible between the two points?
  bool sees(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const ViewState& view) const;
  // Is there nothing visible before the place, from where the view's camera looks at it?
  bool isInSight(const Eigen::Vector3d& place, const ViewState& view) const {
    return sees(view.camera.eyeOf(place), place, view);
  }

 private:
  std::shared_ptr<const Environment> environment_;
  std::unique_ptr<Task<std::shared_ptr<const RayScene>>> task_;
};

}  // namespace standpoint
