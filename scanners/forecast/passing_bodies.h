// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>

#include <Eigen/Core>

#include "scanners/engine/ray_engine.h"

namespace standpoint {

// What moves in a scene, and what it hides from whom at which time.
class PassingBodies {
 public:
  // `scene` is one that RayScene::build made with bodies; their clock is `ahead_s` ahead of that of whoever asks.
  explicit PassingBodies(std::shared_ptr<const RayScene> scene, double ahead_s = 0);
  ~PassingBodies();
  PassingBodies(const PassingBodies&) = delete;
  PassingBodies& operator=(const PassingBodies&) = delete;

  // Does one of them stand between the eye and a place of `product` then? That product's own bodies do not count.
  // Thread-safe, and fast where one thread asks of times near each other.
  bool hide(const Eigen::Vector3d& eye, const Eigen::Vector3d& place, std::uint32_t product, double time_s) const;

 private:
  struct Threads;
  std::shared_ptr<const RayScene> scene_;
  double ahead_s_;
  std::unique_ptr<Threads> threads_;
};

}  // namespace standpoint
