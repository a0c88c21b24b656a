// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/face_patches.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>

#include "core/assigned.h"
#include "core/face_normal.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

double squaredToSegment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d way = b - a;
  const double length2 = way.squaredNorm();
  const double along = length2 > 0 ? std::clamp((p - a).dot(way) / length2, 0.0, 1.0) : 0;
  return (a + along * way - p).squaredNorm();
}

// `normal` is that of the triangle.
double squaredToTriangle(const Vector3d& p, const std::array<Vector3d, 3>& corner, const Vector3d& normal) {
  int inner = 0;
  double nearest = std::numeric_limits<double>::max();
  for (std::size_t k = 0; k < 3; ++k) {
    const auto &a = corner[k], &b = corner[(k + 1) % 3], &c = corner[(k + 2) % 3];
    const Vector3d outwards = (b - a).cross(normal);
    if ((p - a).dot(outwards) * (c - a).dot(outwards) >= 0) ++inner;
    nearest = std::min(nearest, squaredToSegment(p, a, b));
  }
  const double off = (p - corner[0]).dot(normal);
  return inner == 3 ? off * off : nearest;
}

// Which triangles of a mesh's surface meet at an edge, by the places of its ends: at a seam of a texture and in a file
// without shared corners a position stands there more than once.
class EdgeNeighbours {
 public:
  EdgeNeighbours(const Mesh& mesh, std::uint32_t surface) : mesh_(mesh), place_(mesh.positions.size()) {
    std::vector<std::uint32_t> order(mesh.positions.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto key = [&](std::uint32_t i) {
      return std::array{mesh.positions[i].x(), mesh.positions[i].y(), mesh.positions[i].z()};
    };
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return std::pair(key(a), a) < std::pair(key(b), b); });
    for (std::size_t i = 0; i < order.size(); ++i)
      place_[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? place_[order[i - 1]] : order[i];
    const auto& of = mesh.surface_of_triangle;
    const auto [first, last] = std::equal_range(of.begin(), of.end(), surface);
    for (auto t = static_cast<std::uint32_t>(first - of.begin()); t < static_cast<std::uint32_t>(last - of.begin());
         ++t)
      for (std::size_t k = 0; k < 3; ++k) edges_.push_back({edge(t, k), t});
    std::sort(edges_.begin(), edges_.end());
  }

  template <class Visit>
  void visit(std::uint32_t triangle, const Visit& visitor) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const Edge wanted = edge(triangle, k);
      for (auto e = std::lower_bound(edges_.begin(), edges_.end(), std::pair(wanted, 0U));
           e != edges_.end() && e->first == wanted; ++e)
        visitor(e->second);
    }
  }

 private:
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  Edge edge(std::uint32_t triangle, std::size_t k) const {
    const auto a = place_[mesh_.triangles[triangle][k]], b = place_[mesh_.triangles[triangle][(k + 1) % 3]];
    return {std::min(a, b), std::max(a, b)};
  }

  const Mesh& mesh_;
  std::vector<std::uint32_t> place_;                   // the first corner that stands where this one does
  std::vector<std::pair<Edge, std::uint32_t>> edges_;  // sorted
};

std::vector<PlacedTriangle> connectedFaces(const Environment& environment, const EdgeNeighbours& neighbours,
                                           PlacedTriangle seed, const Vector3d& direction) {
  const auto& instance = environment.instances[seed.instance];
  const Mesh& mesh = *environment.meshes[instance.mesh];
  std::vector<bool> seen(mesh.triangles.size(), false);
  std::vector<PlacedTriangle> patch{seed};
  seen[seed.triangle] = true;
  for (std::size_t i = 0; i < patch.size(); ++i)
    neighbours.visit(patch[i].triangle, [&](std::uint32_t next) {
      if (seen[next]) return;
      seen[next] = true;
      if (placedNormal(mesh, mesh.triangles[next], instance.world_from_mesh).dot(direction) >= kFaceCone)
        patch.push_back({seed.instance, next});
    });
  std::sort(patch.begin(), patch.end());
  return patch;
}

}  // namespace

std::optional<PlacedTriangle> nearestFace(const Environment& environment, std::uint32_t product,
                                          std::optional<std::uint32_t> surface, const Vector3d& direction,
                                          const Vector3d& point) {
  std::optional<PlacedTriangle> nearest;
  double least = kPatchReach_m * kPatchReach_m;
  const auto& instances = environment.instances;
  auto i = std::lower_bound(instances.begin(), instances.end(), product,
                            [](const Instance& a, std::uint32_t p) { return a.product < p; });
  for (; i != instances.end() && i->product == product; ++i) {
    const Mesh& mesh = *environment.meshes[i->mesh];
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      if (surface && mesh.surface_of_triangle[t] != *surface) continue;
      const auto normal = placedNormal(mesh, mesh.triangles[t], i->world_from_mesh);
      if (!(normal.dot(direction) >= kFaceCone)) continue;
      std::array<Vector3d, 3> corner;
      for (std::size_t k = 0; k < 3; ++k)
        corner[k] = i->world_from_mesh * mesh.positions[mesh.triangles[t][k]].cast<double>();
      const double squared = squaredToTriangle(point, corner, normal);
      if (nearest ? squared >= least : squared > least) continue;
      least = squared;
      nearest = PlacedTriangle{static_cast<std::uint32_t>(i - instances.begin()), static_cast<std::uint32_t>(t)};
    }
  }
  return nearest;
}

AssignedTriangles::AssignedTriangles(const Environment& environment, const MaterialAssignment& assignment)
    : environment_(environment), assignment_(assignment), patches_(assignment.faces.size()) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, EdgeNeighbours> neighbours;  // by instance's mesh and surface
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    const auto& faces = assignment.faces[i];
    if (!faces.point) continue;
    const auto seed = nearestFace(environment, faces.product, faces.surface, faces.direction, *faces.point);
    if (!seed) continue;
    const auto index = environment.instances[seed->instance].mesh;
    const auto known = neighbours.try_emplace({index, faces.surface}, *environment.meshes[index], faces.surface).first;
    patches_[i] = connectedFaces(environment, known->second, *seed, faces.direction);
  }
}

std::int32_t AssignedTriangles::materialOf(std::uint32_t instance, std::uint32_t triangle) const {
  const auto& placed = environment_.instances[instance];
  const Mesh& mesh = *environment_.meshes[placed.mesh];
  const auto surface = mesh.surface_of_triangle[triangle];
  std::int32_t material = standpoint::materialOf(assignment_, placed.product, surface);
  const auto said = assignedFaces(assignment_, placed.product, surface);
  if (said.empty()) return material;
  const auto normal = placedNormal(mesh, mesh.triangles[triangle], placed.world_from_mesh);
  for (const auto& faces : said) {
    const auto& patch = patches_[static_cast<std::size_t>(&faces - assignment_.faces.data())];
    const bool meant = faces.point ? std::binary_search(patch.begin(), patch.end(), PlacedTriangle{instance, triangle})
                                   : faces.direction.dot(normal) >= kFaceCone;
    if (meant) material = faces.material;
  }
  return material;
}

}  // namespace standpoint
