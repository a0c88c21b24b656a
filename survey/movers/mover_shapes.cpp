// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/movers/mover_shapes.h"

#include <vector>

#include "core/portable_math.h"
#include "core/units.h"

namespace standpoint {

namespace {

// An ellipse across a straight line, at a share of it.
struct Ring {
  double along = 0, x_m = 0, y_m = 0;  // half axes: along `across`, and across both
};

constexpr std::uint32_t kCorners = 12;

// A closed body through rings about the line; it ends in points.
void addBody(Mesh& mesh, const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Eigen::Vector3d& across,
             const std::vector<Ring>& rings) {
  const Eigen::Vector3d axis = (to - from).normalized(), side = axis.cross(across);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back(from.cast<float>());
  for (const Ring& ring : rings)
    for (std::uint32_t k = 0; k < kCorners; ++k) {
      double sine = 0, cosine = 0;
      portable::sinCos(kRadPerTurn * k / kCorners, sine, cosine);
      const Eigen::Vector3d place =
          from + ring.along * (to - from) + ring.x_m * cosine * across + ring.y_m * sine * side;
      mesh.positions.push_back(place.cast<float>());
    }
  const auto last = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back(to.cast<float>());
  const auto corner = [&](std::size_t ring, std::uint32_t k) {
    return first + 1 + static_cast<std::uint32_t>(ring) * kCorners + k % kCorners;
  };
  for (std::uint32_t k = 0; k < kCorners; ++k) {
    mesh.triangles.push_back({first, corner(0, k + 1), corner(0, k)});
    for (std::size_t ring = 0; ring + 1 < rings.size(); ++ring) {
      mesh.triangles.push_back({corner(ring, k), corner(ring, k + 1), corner(ring + 1, k + 1)});
      mesh.triangles.push_back({corner(ring, k), corner(ring + 1, k + 1), corner(ring + 1, k)});
    }
    mesh.triangles.push_back({corner(rings.size() - 1, k), corner(rings.size() - 1, k + 1), last});
  }
}

void addBox(Mesh& mesh, const Eigen::Vector3f& low, const Eigen::Vector3f& high, float narrower_above) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const bool up : {false, true})
    for (const auto& [x, y] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
      const float in = up ? narrower_above : 0;
      mesh.positions.emplace_back(x == 0 ? low.x() + in : high.x() - in, y == 0 ? low.y() + in / 2 : high.y() - in / 2,
                                  up ? high.z() : low.z());
    }
  const std::uint32_t faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                     {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  for (const auto& f : faces) {
    mesh.triangles.push_back({first + f[0], first + f[1], first + f[2]});
    mesh.triangles.push_back({first + f[0], first + f[2], first + f[3]});
  }
}

Mesh whole(Mesh mesh) {
  mesh.surface_of_triangle.assign(mesh.triangles.size(), 0);
  return mesh;
}

const Eigen::Vector3d kAhead = Eigen::Vector3d::UnitX();

}  // namespace

Mesh limbMesh(Limb limb) {
  Mesh mesh;
  const double side = limb == Limb::left_thigh || limb == Limb::left_shank || limb == Limb::left_arm ? 1 : -1;
  switch (limb) {
    case Limb::trunk:
      addBody(mesh, {0, 0, 0.84}, {0, 0, 1.48}, kAhead,
              {{0.02, 0.08, 0.12}, {0.15, 0.12, 0.17}, {0.45, 0.10, 0.15}, {0.8, 0.12, 0.19}, {0.97, 0.08, 0.16}});
      addBody(mesh, {0, 0, 1.44}, {0, 0, 1.56}, kAhead, {{0.01, 0.055, 0.055}, {0.99, 0.055, 0.055}});
      addBody(mesh, {0.02, 0, 1.52}, {0.02, 0, 1.75}, kAhead,
              {{0.1, 0.06, 0.05}, {0.35, 0.095, 0.075}, {0.65, 0.1, 0.08}, {0.9, 0.06, 0.05}});
      break;
    case Limb::left_thigh:
    case Limb::right_thigh:
      addBody(mesh, {0, side * kHipAside_m, kKnee_m - 0.03}, {0, side * kHipAside_m, kHip_m}, kAhead,
              {{0.03, 0.055, 0.05}, {0.5, 0.075, 0.07}, {0.97, 0.085, 0.08}});
      break;
    case Limb::left_shank:
    case Limb::right_shank:
      addBody(mesh, {0, side * kHipAside_m, 0.05}, {0, side * kHipAside_m, kKnee_m + 0.03}, kAhead,
              {{0.02, 0.04, 0.04}, {0.6, 0.06, 0.055}, {0.97, 0.055, 0.05}});
      addBox(mesh, {-0.08F, static_cast<float>(side * kHipAside_m) - 0.045F, 0},
             {0.19F, static_cast<float>(side * kHipAside_m) + 0.045F, 0.08F}, 0.02F);
      break;
    case Limb::left_arm:
    case Limb::right_arm:
      addBody(mesh, {0.04, side * (kShoulderAside_m + 0.02), 0.76}, {0, side * kShoulderAside_m, kShoulder_m + 0.03},
              kAhead, {{0.03, 0.035, 0.025}, {0.5, 0.045, 0.045}, {0.95, 0.055, 0.055}});
      break;
  }
  return whole(std::move(mesh));
}

Mesh vehicleMesh() {
  Mesh mesh;
  addBox(mesh, {-2.25F, -0.9F, 0.25F}, {2.25F, 0.9F, 0.85F}, 0.06F);
  addBox(mesh, {-1.5F, -0.82F, 0.85F}, {1.2F, 0.82F, 1.45F}, 0.3F);
  for (const double x : {-1.35, 1.35})
    for (const double y : {-0.9, 0.7})
      addBody(mesh, {x, y, 0.32}, {x, y + 0.2, 0.32}, kAhead, {{0.01, 0.32, 0.32}, {0.99, 0.32, 0.32}});
  return whole(std::move(mesh));
}

}  // namespace standpoint
