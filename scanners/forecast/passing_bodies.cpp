// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/forecast/passing_bodies.h"

#include <tbb/enumerable_thread_specific.h>

#include "scanners/engine/timed_scene.h"

namespace standpoint {

struct PassingBodies::Threads {
  explicit Threads(const EmbreeScene& scene)
      : scenes([swept = TimedScene::swept(scene, BeamWidth{})] { return std::make_unique<TimedScene>(swept); }) {}
  tbb::enumerable_thread_specific<std::unique_ptr<TimedScene>> scenes;
};

PassingBodies::PassingBodies(std::shared_ptr<const RayScene> scene, double ahead_s)
    : scene_(std::move(scene)),
      ahead_s_(ahead_s),
      threads_(std::make_unique<Threads>(static_cast<const EmbreeScene&>(*scene_))) {}

PassingBodies::~PassingBodies() = default;

bool PassingBodies::hide(const Eigen::Vector3d& eye, const Eigen::Vector3d& place, std::uint32_t product,
                         double time_s) const {
  const Eigen::Vector3d way = place - eye;
  const double range = way.norm();
  if (!(range > 0)) return false;
  const NearestHit hit = threads_->scenes.local()->nearestBody(eye, way / range, range, time_s + ahead_s_);
  return hit.facet != kNoFacet && static_cast<const EmbreeScene&>(*scene_).facet(hit.facet).product != product;
}

}  // namespace standpoint
