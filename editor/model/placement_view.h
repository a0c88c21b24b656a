// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>

#include "survey/stations/placement.h"

namespace standpoint {

// Whether a station could stand where the pointer is, asked anew in each frame: the checks of the verb, live. The
// answer is kept while the pointer rests.
class PlacementView {
 public:
  // Null: nothing can be asked yet. Cheap while the scene is the same.
  void follow(std::shared_ptr<const RayScene> scene);
  bool ready() const { return placement_ != nullptr; }
  const std::optional<Refusal>& whyNotOn(const RayHit& hit, double height_m);

 private:
  std::shared_ptr<const RayScene> scene_;
  std::unique_ptr<StationPlacement> placement_;
  std::optional<Eigen::Vector3d> asked_;
  double asked_height_m_ = 0;
  std::optional<Refusal> answer_;
};

}  // namespace standpoint
