// SPDX-License-Identifier: GPL-3.0-or-later
#include "materials/areas.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace standpoint {

namespace {

struct SurfaceArea {
  std::uint32_t surface;
  double area_m2;
};

std::vector<SurfaceArea> placedAreas(const Mesh& mesh, const Eigen::Matrix3d& linear) {
  std::vector<SurfaceArea> areas;  // triangles are sorted by surface
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    const Eigen::Vector3d origin = mesh.positions[a].cast<double>();
    const Eigen::Vector3d u = linear * (mesh.positions[b].cast<double>() - origin);
    const Eigen::Vector3d v = linear * (mesh.positions[c].cast<double>() - origin);
    if (areas.empty() || areas.back().surface != mesh.surface_of_triangle[i])
      areas.push_back({mesh.surface_of_triangle[i], 0});
    areas.back().area_m2 += 0.5 * u.cross(v).norm();
  }
  return areas;
}

// s where the placement turns, mirrors and scales evenly by s: areas then follow from the mesh's own.
std::optional<double> evenScale(const Eigen::Matrix3d& linear) {
  const Eigen::Matrix3d gram = linear.transpose() * linear;
  const double square = gram.trace() / 3;
  const double off = (gram - square * Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  return off <= 1e-9 * square ? std::optional(std::sqrt(square)) : std::nullopt;
}

}  // namespace

Result<std::vector<SurfaceOfProduct>> measuredSurfaces(const Environment& environment, Progress& progress) {
  std::vector<std::vector<SurfaceArea>> own(environment.meshes.size());
  std::vector<SurfaceOfProduct> pairs;
  for (std::size_t i = 0; i < environment.instances.size(); ++i) {
    const auto& instance = environment.instances[i];
    const auto& mesh = *environment.meshes[instance.mesh];
    const Eigen::Matrix3d linear = instance.world_from_mesh.linear();
    const auto scale = evenScale(linear);
    auto& kept = own[instance.mesh];
    if (scale && kept.empty()) kept = placedAreas(mesh, Eigen::Matrix3d::Identity());
    for (const auto& [surface, area_m2] : scale ? kept : placedAreas(mesh, linear))
      pairs.push_back({instance.product, surface, scale ? area_m2 * *scale * *scale : area_m2});
    if (i % 256 == 0) {
      TRY(progress.check());
      progress.advance(static_cast<double>(i) / static_cast<double>(environment.instances.size()));
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const SurfaceOfProduct& a, const SurfaceOfProduct& b) {
    return std::pair(a.product, a.surface) < std::pair(b.product, b.surface);
  });
  std::size_t count = 0;
  for (const auto& pair : pairs)
    if (count > 0 && pairs[count - 1].product == pair.product && pairs[count - 1].surface == pair.surface)
      pairs[count - 1].area_m2 += pair.area_m2;
    else
      pairs[count++] = pair;
  pairs.resize(count);
  return pairs;
}

double solidThickness(const Mesh& mesh, std::uint32_t surface) {
  Mesh part;
  part.positions = mesh.positions;
  const auto& of = mesh.surface_of_triangle;
  const auto [begin, end] = std::equal_range(of.begin(), of.end(), surface);
  part.triangles.assign(mesh.triangles.begin() + (begin - of.begin()), mesh.triangles.begin() + (end - of.begin()));
  const double faces = area(part);
  return faces > 0 && isClosed(part) ? 2 * std::abs(volume(part)) / faces : 0;
}

}  // namespace standpoint
