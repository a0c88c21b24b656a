// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/solid.h"

#include <array>
#include <map>

#include <Eigen/Geometry>

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr int kMostFaces = 10000;

bool fromBehind(const Environment& environment, const RayHit& hit, const Vector3d& direction) {
  const auto& instance = environment.instances[hit.instance];
  const auto& mesh = *environment.meshes[instance.mesh];
  const auto& t = mesh.triangles[hit.triangle];
  const auto at = [&](int k) -> Vector3d { return instance.world_from_mesh * mesh.positions[t[k]].cast<double>(); };
  const double side = (at(1) - at(0)).cross(at(2) - at(0)).dot(direction);
  return instance.world_from_mesh.linear().determinant() < 0 ? side < 0 : side > 0;
}

struct Crossings {
  int faces = 0;
  bool first_from_behind = false;
};

std::map<std::uint32_t, Crossings> crossed(const RayScene& scene, Vector3d from, const Vector3d& direction, double far_m) {
  std::map<std::uint32_t, Crossings> products;
  for (int i = 0; i < kMostFaces; ++i) {
    const auto hit = scene.intersect(from, direction, far_m);
    if (!hit) break;
    auto& c = products[hit->product];
    if (c.faces++ == 0) c.first_from_behind = fromBehind(scene.environment(), *hit, direction);
    from = hit->position + 1e-5 * direction;
  }
  return products;
}

}  // namespace

std::optional<std::uint32_t> solidAround(const RayScene& scene, const Vector3d& place) {
  // Askew, so that no ray runs along a face or through an edge of what is built square.
  const std::array<Vector3d, 5> directions = {Vector3d(0.31, 0.47, 0.83), Vector3d(-0.71, 0.29, 0.64), Vector3d(0.53, -0.79, 0.31),
                                              Vector3d(-0.37, -0.43, -0.82), Vector3d(0.91, 0.17, -0.38)};
  const double far_m = bounds(scene.environment()).diagonal() + 1;
  // Most of them decide: where two bodies share a face (a table on its floor) a ray meets only one of the two.
  std::map<std::uint32_t, int> inside;
  for (const auto& d : directions)
    for (const auto& [product, c] : crossed(scene, place, d.normalized(), far_m))
      if (c.faces % 2 == 1 && c.first_from_behind) ++inside[product];
  for (const auto& [product, count] : inside)
    if (count > static_cast<int>(directions.size()) / 2) return product;
  return std::nullopt;
}

}  // namespace standpoint
