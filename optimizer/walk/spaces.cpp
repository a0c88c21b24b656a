// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/walk/spaces.h"

#include <limits>

namespace standpoint {

using Eigen::Vector3d;

// By how often a ray straight up leaves and enters; a little beside the grid, so that it meets no edge of a rectangle.
bool SpaceBody::contains(const Vector3d& p) const {
  if ((p.array() < box.min.array()).any() || (p.array() > box.max.array()).any()) return false;
  bool inside = false;
  const double x = p.x() + 1.7e-6, y = p.y() + 2.3e-6;
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    const Vector3d &a = corners[i], &b = corners[i + 1], &c = corners[i + 2];
    const auto side = [&](const Vector3d& s, const Vector3d& e) {
      return (e.x() - s.x()) * (y - s.y()) - (e.y() - s.y()) * (x - s.x());
    };
    const double u = side(b, c), v = side(c, a), w = side(a, b), sum = u + v + w;
    if (sum == 0 || u * sum < 0 || v * sum < 0 || w * sum < 0) continue;
    if ((u * a.z() + v * b.z() + w * c.z()) / sum > p.z()) inside = !inside;
  }
  return inside;
}

std::vector<SpaceBody> spaceBodies(const Environment& environment) {
  std::vector<SpaceBody> spaces;
  for (const auto& instance : environment.instances) {
    const auto& product = environment.products[instance.product];
    if (product.ifc_class != "IfcSpace" || product.excluded) continue;
    if (spaces.empty() || spaces.back().product != instance.product) spaces.emplace_back().product = instance.product;
    const auto& mesh = *environment.meshes[instance.mesh];
    for (const auto& t : mesh.triangles)
      for (const auto v : t) {
        spaces.back().corners.push_back(instance.world_from_mesh * mesh.positions[v].cast<double>());
        spaces.back().box.extend(spaces.back().corners.back());
      }
  }
  std::erase_if(spaces, [](const SpaceBody& space) { return space.box.empty(); });
  return spaces;
}

std::optional<std::uint32_t> spaceAt(std::span<const SpaceBody> spaces, const Vector3d& p) {
  std::optional<std::uint32_t> found;
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& space : spaces) {
    const double volume = (space.box.max - space.box.min).prod();
    if (volume >= smallest || !space.contains(p)) continue;
    smallest = volume;
    found = space.product;
  }
  return found;
}

}  // namespace standpoint
