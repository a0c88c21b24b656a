// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Small tools for planar polygons in space, shared by the files of this folder only.

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "importers/geometry/kernel.h"

namespace standpoint::geometry {

constexpr double kSnap_m = 1e-6;  // points closer than this are one point in Booleans and clips

// Half the sum of the cross products (Newell): direction = normal, length = area. Relative to the first point, so that
// far-away coordinates do not cancel.
inline Eigen::Vector3d areaVector(std::span<const Eigen::Vector3d> points, std::span<const std::uint32_t> loop) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  if (loop.size() < 3) return sum;
  const Eigen::Vector3d& origin = points[loop[0]];
  Eigen::Vector3d previous = points[loop[1]] - origin;
  for (std::size_t i = 2; i < loop.size(); ++i) {
    const Eigen::Vector3d current = points[loop[i]] - origin;
    sum += previous.cross(current);
    previous = current;
  }
  return 0.5 * sum;
}

// Drops the coordinate in which the normal is longest; what is counter-clockwise around the normal stays so.
struct Projection {
  int u = 0, v = 1;

  explicit Projection(const Eigen::Vector3d& normal) {
    int axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    u = (axis + 1) % 3;
    v = (axis + 2) % 3;
    if (normal[axis] < 0) std::swap(u, v);
  }
  Eigen::Vector2d operator()(const Eigen::Vector3d& p) const { return {p[u], p[v]}; }
};

inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return cross(Eigen::Vector2d(b - a), Eigen::Vector2d(c - a));
}

inline double signedArea(std::span<const Eigen::Vector2d> loop) {
  double sum = 0;
  for (std::size_t i = 2; i < loop.size(); ++i) sum += cross(loop[0], loop[i - 1], loop[i]);
  return 0.5 * sum;
}

// How often the loop winds around the point, counter-clockwise positive.
int windingNumber(std::span<const Eigen::Vector2d> loop, const Eigen::Vector2d& point);

struct Bounds3 {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(INFINITY), high = Eigen::Vector3d::Constant(-INFINITY);
  explicit Bounds3(std::span<const Eigen::Vector3d> points) {
    for (const Eigen::Vector3d& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  }
  bool overlaps(const Bounds3& other, double by_m) const {
    return ((low.array() + by_m) < other.high.array()).all() && ((other.low.array() + by_m) < high.array()).all();
  }
};

bool isFinite(const PolyMesh& mesh);  // every point finite, every index in range
void flip(PolyMesh& mesh);            // turns every face over
// Adds the loop as a face; a loop that is not planar within 1e-9 m becomes triangles (fan).
void addFace(PolyMesh& mesh, std::vector<std::uint32_t> loop);
// Groups loops (counter-clockwise outers, clockwise holes) into regions: each hole goes to the smallest outer around
// it. Returns for each outer the hole numbers; holes without an outer are left out.
struct Nesting {
  std::vector<std::size_t> outers;
  std::vector<std::vector<std::size_t>> holes;  // parallel to outers
};
Nesting nest(std::span<const Loop2> loops);

// First of the points within weld_m of each; the result maps a point to the representative's index.
std::vector<std::uint32_t> weldMap(std::span<const Eigen::Vector3d> points, double weld_m);

}  // namespace standpoint::geometry
