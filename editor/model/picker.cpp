// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/picker.h"

#include <utility>

namespace standpoint {

namespace {

constexpr double kFar_m = 1e6;
constexpr int kMostHidden = 512;  // surfaces that a ray passes through before it gives up
constexpr double kStep_m = 1e-4;

}  // namespace

bool isShown(const ViewState& view, std::uint32_t product, const Eigen::Vector3d& place) {
  if (view.cut_height_m && place.z() > *view.cut_height_m) return false;
  if (view.clip && !view.clip->contains(place)) return false;
  if (isDrawnApart(view, product)) return false;  // one sees and points through doors that open
  return !view.hidden || product >= view.hidden->size() || (*view.hidden)[product] == 0;
}

void Picker::follow(const std::shared_ptr<const Environment>& environment, const std::function<void()>& wake) {
  if (environment == environment_) return;
  task_.reset();
  environment_ = environment;
  if (!environment_) return;
  using Scene = std::shared_ptr<const RayScene>;
  task_ = std::make_unique<Task<Scene>>(
      "Prepare picking",
      [environment](Progress& progress) -> Result<Scene> { return RayScene::build(environment, progress); }, wake);
}

std::optional<RayHit> Picker::pick(const ViewRay& ray, const ViewState& view) const {
  if (!ready() || view.environment != environment_) return std::nullopt;
  return firstShown(*scene(), ray, view);
}

std::optional<RayHit> firstShown(const RayScene& scene, const ViewRay& ray, const ViewState& view) {
  double travelled = 0;
  for (int i = 0; i < kMostHidden; ++i) {
    auto hit = scene.intersect(ray.origin + ray.direction * travelled, ray.direction, kFar_m);
    if (!hit) return std::nullopt;
    hit->range_m += travelled;
    if (isShown(view, hit->product, hit->position)) return hit;
    travelled = hit->range_m + kStep_m;
  }
  return std::nullopt;
}

bool Picker::sees(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const ViewState& view) const {
  const double distance = (to - from).norm();
  if (distance < kStep_m) return true;
  const auto hit = pick({from, (to - from) / distance}, view);
  return !hit || hit->range_m > distance - 0.01;
}

}  // namespace standpoint
