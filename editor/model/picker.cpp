// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/picker.h"

#include <array>
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

namespace {

// How far along the ray it meets the triangle (Möller and Trumbore, 1997); nothing where it does not, from either side.
std::optional<double> rangeTo(const std::array<Eigen::Vector3d, 3>& corners, const ViewRay& ray) {
  const Eigen::Vector3d ab = corners[1] - corners[0], ac = corners[2] - corners[0];
  const Eigen::Vector3d p = ray.direction.cross(ac), from_a = ray.origin - corners[0];
  const double determinant = ab.dot(p);
  if (determinant == 0) return std::nullopt;
  const double u = from_a.dot(p) / determinant;
  const Eigen::Vector3d q = from_a.cross(ab);
  const double v = ray.direction.dot(q) / determinant;
  if (u < 0 || v < 0 || u + v > 1) return std::nullopt;
  const double range = ac.dot(q) / determinant;
  return range > 0 ? std::optional(range) : std::nullopt;
}

}  // namespace

std::optional<RayHit> firstDoor(const Environment& doors, const ViewRay& ray, double within_m) {
  std::optional<RayHit> first;
  for (std::uint32_t i = 0; i < doors.instances.size(); ++i) {
    const auto& instance = doors.instances[i];
    const auto& mesh = *doors.meshes[instance.mesh];
    const Eigen::Affine3d mesh_from_world = instance.world_from_mesh.inverse();
    // An affine map keeps ranges as multiples of the direction.
    const ViewRay in_mesh{mesh_from_world * ray.origin, mesh_from_world.linear() * ray.direction};
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      std::array<Eigen::Vector3d, 3> corners;
      for (std::size_t k = 0; k < 3; ++k) corners[k] = mesh.positions[mesh.triangles[t][k]].cast<double>();
      const auto range = rangeTo(corners, in_mesh);
      if (!range || *range >= (first ? first->range_m : within_m)) continue;
      first = RayHit{*range, ray.origin + *range * ray.direction, -ray.direction, instance.product, 0, i, t};
    }
  }
  return first;
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
