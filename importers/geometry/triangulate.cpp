// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "importers/geometry/kernel.h"
#include "importers/geometry/polygon.h"
#include "importers/geometry/triangulate_hard.h"

namespace standpoint::geometry {
namespace {

constexpr std::size_t kMaxEarPoints = 64;  // ear cutting is quadratic at best; above, Delaunay is quicker

using Loop = std::vector<std::uint32_t>;
using Flat = std::vector<Eigen::Vector2d>;

bool fan(const Flat& p, const Loop& loop, std::vector<Triangle>& triangles) {
  const std::size_t n = loop.size();
  // Starting a quad at the end of its shorter diagonal avoids slivers.
  const std::size_t s = n == 4 && (p[1] - p[3]).squaredNorm() < (p[0] - p[2]).squaredNorm() ? 1 : 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (cross(p[i], p[(i + 1) % n], p[(i + 2) % n]) <= 0) return false;
  }
  for (std::size_t i = 1; i + 1 < n; ++i) {
    if (cross(p[s], p[(s + i) % n], p[(s + i + 1) % n]) <= 0) return false;
  }
  for (std::size_t i = 1; i + 1 < n; ++i) triangles.push_back({loop[s], loop[(s + i) % n], loop[(s + i + 1) % n]});
  return true;
}

bool edgesMeet(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c, const Eigen::Vector2d& d) {
  if (std::max(a.x(), b.x()) < std::min(c.x(), d.x()) || std::max(c.x(), d.x()) < std::min(a.x(), b.x()) ||
      std::max(a.y(), b.y()) < std::min(c.y(), d.y()) || std::max(c.y(), d.y()) < std::min(a.y(), b.y())) {
    return false;
  }
  const double c_side = cross(a, b, c), d_side = cross(a, b, d), a_side = cross(c, d, a), b_side = cross(c, d, b);
  return !((c_side > 0 && d_side > 0) || (c_side < 0 && d_side < 0) || (a_side > 0 && b_side > 0) ||
           (a_side < 0 && b_side < 0));
}

bool isSimple(const Flat& p) {
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 2; j < n; ++j) {
      if ((j + 1) % n != i && edgesMeet(p[i], p[i + 1], p[j], p[(j + 1) % n])) return false;
    }
    const Eigen::Vector2d in = p[(i + 1) % n] - p[i], out = p[(i + 2) % n] - p[(i + 1) % n];
    if (cross(in, out) == 0 && in.dot(out) <= 0) return false;  // a spike
  }
  return true;
}

// Ear cutting of a simple polygon: cuts only true ears (positive area, nothing inside or on it), so points on straight
// edges stay corners of triangles and neighbours keep matching.
bool cutEars(const Flat& p, const Loop& loop, std::vector<Triangle>& triangles) {
  if (!isSimple(p)) return false;
  std::vector<std::size_t> left(loop.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = i;
  const std::size_t before = triangles.size();
  const auto is_ear = [&](std::size_t at) {
    const std::size_t n = left.size(), a = left[(at + n - 1) % n], b = left[at], c = left[(at + 1) % n];
    if (cross(p[a], p[b], p[c]) <= 0) return false;
    return std::none_of(left.begin(), left.end(), [&](std::size_t i) {
      return i != a && i != b && i != c && cross(p[a], p[b], p[i]) >= 0 && cross(p[b], p[c], p[i]) >= 0 &&
             cross(p[c], p[a], p[i]) >= 0;
    });
  };
  std::size_t at = 0, misses = 0;
  while (left.size() > 2 && misses < left.size()) {
    if (!is_ear(at)) {
      at = (at + 1) % left.size();
      ++misses;
      continue;
    }
    const std::size_t n = left.size();
    triangles.push_back({loop[left[(at + n - 1) % n]], loop[left[at]], loop[left[(at + 1) % n]]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
    at = (at + 1) % left.size();  // the next ear elsewhere: fewer slivers than a fan
    misses = 0;
  }
  if (left.size() == 2) return true;
  triangles.resize(before);
  return false;
}

Loop withoutRepeats(std::span<const Eigen::Vector3d> points, const Loop& loop) {
  Loop kept;
  for (std::uint32_t i : loop) {
    if (kept.empty() || (points[kept.back()] != points[i] && kept.back() != i)) kept.push_back(i);
  }
  while (kept.size() > 1 && points[kept.front()] == points[kept.back()]) kept.pop_back();
  return kept;
}

}  // namespace

bool triangulate(std::span<const Eigen::Vector3d> points, const Face& face, std::vector<Triangle>& triangles,
                 std::span<const std::uint32_t> inner) {
  for (std::uint32_t i : face.outer) {
    if (i >= points.size() || !points[i].allFinite()) return false;
  }
  const Loop outer = withoutRepeats(points, face.outer);
  const Eigen::Vector3d normal = areaVector(points, outer);
  if (outer.size() < 3 || !(normal.norm() > 0)) return false;
  if (outer.size() == 3 && face.holes.empty() && inner.empty()) {
    triangles.push_back({outer[0], outer[1], outer[2]});
    return true;
  }
  const Projection projection(normal);
  if (face.holes.empty() && inner.empty() && outer.size() <= kMaxEarPoints) {
    Flat flat;
    for (std::uint32_t i : outer) flat.push_back(projection(points[i]));
    if (fan(flat, outer, triangles) || cutEars(flat, outer, triangles)) return true;
  }
  std::vector<Loop> loops{outer};
  for (const Loop& hole : face.holes) {
    for (std::uint32_t i : hole) {
      if (i >= points.size() || !points[i].allFinite()) return false;
    }
    Loop clean = withoutRepeats(points, hole);
    if (clean.size() >= 3) loops.push_back(std::move(clean));
  }
  return triangulateHard(points, loops, inner, projection, triangles);
}

TriangulatedMesh triangulate(const PolyMesh& mesh) {
  TriangulatedMesh result;
  result.points = mesh.points;
  result.triangles.reserve(mesh.faces.size() * 2);
  for (const Face& face : mesh.faces) {
    if (!triangulate(mesh.points, face, result.triangles)) ++result.failed_faces;
    result.tag_of_triangle.resize(result.triangles.size(), face.tag);
  }
  return result;
}

}  // namespace standpoint::geometry
