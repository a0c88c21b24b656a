// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include "importers/geometry/kernel.h"
#include "importers/geometry/polygon.h"

namespace standpoint::geometry {
namespace {

using Ring = std::vector<Eigen::Vector3d>;

std::vector<Eigen::Vector3d> withoutRepeats(std::span<const Eigen::Vector3d> path, bool closed) {
  std::vector<Eigen::Vector3d> kept;
  for (const Eigen::Vector3d& p : path) {
    if (kept.empty() || (p - kept.back()).norm() > kSnap_m) kept.push_back(p);
  }
  while (closed && kept.size() > 1 && (kept.front() - kept.back()).norm() <= kSnap_m) kept.pop_back();
  return kept;
}

// The plane in which two pieces of tube meet; where the path turns back on itself a mitre would be endless, so butt.
Eigen::Vector3d mitreNormal(const Eigen::Vector3d& in, const Eigen::Vector3d& out) {
  const Eigen::Vector3d sum = in + out;
  return sum.norm() > 0.2 ? sum.normalized() : in;
}

Ring slide(const Ring& ring, const Eigen::Vector3d& direction, const Eigen::Vector3d& on_plane,
           const Eigen::Vector3d& normal) {
  Ring moved;
  for (const Eigen::Vector3d& p : ring)
    moved.push_back(p + direction * ((on_plane - p).dot(normal) / direction.dot(normal)));
  return moved;
}

Ring circleAround(const Eigen::Vector3d& centre, const Eigen::Vector3d& direction, double radius_m, int segments) {
  const Eigen::Vector3d x = direction.unitOrthogonal(), y = direction.cross(x);
  Ring ring;
  for (int i = 0; i < segments; ++i) {
    const double angle = 2 * std::numbers::pi * i / segments;
    ring.push_back(centre + radius_m * (std::cos(angle) * x + std::sin(angle) * y));
  }
  return ring;
}

std::vector<Ring> ringsAlong(const std::vector<Eigen::Vector3d>& path, bool closed, double radius_m, int segments,
                             const EndNormals& ends) {
  const std::size_t n = path.size();
  const auto direction = [&](std::size_t i) { return Eigen::Vector3d((path[(i + 1) % n] - path[i % n]).normalized()); };
  std::vector<Ring> rings;
  Eigen::Vector3d current = direction(0);
  rings.push_back(circleAround(path[0], current, radius_m, segments));
  if (closed)
    rings[0] = slide(rings[0], current, path[0], mitreNormal(direction(n - 1), current));
  else if (ends.start_unit.dot(current) > 0.5)
    rings[0] = slide(rings[0], current, path[0], ends.start_unit);
  const std::size_t last = closed ? n : n - 1;
  for (std::size_t i = 1; i <= last; ++i) {
    const bool at_end = !closed && i == last;
    const Eigen::Vector3d next = at_end ? current : direction(i);
    const bool bent = at_end && ends.end_unit.dot(current) > 0.5;
    rings.push_back(slide(rings.back(), current, path[i % n], bent ? ends.end_unit : mitreNormal(current, next)));
    current = next;
  }
  return rings;
}

// The tube comes back turned around its axis unless the path is plane; the shift brings it closest to where it began.
std::uint32_t closingShift(const Ring& first, const Ring& returned) {
  std::uint32_t best = 0;
  for (std::uint32_t shift = 1; shift < first.size(); ++shift) {
    const auto miss = [&](std::uint32_t s) { return (returned[0] - first[s]).squaredNorm(); };
    if (miss(shift) < miss(best) - 1e-12) best = shift;
  }
  return best;
}

void tube(PolyMesh& mesh, std::vector<Ring> rings, bool closed, bool inner, Face* caps) {
  const auto base = static_cast<std::uint32_t>(mesh.points.size());
  const auto n = static_cast<std::uint32_t>(rings[0].size());
  const std::uint32_t shift = closed ? closingShift(rings.front(), rings.back()) : 0;
  if (closed) rings.pop_back();
  const auto count = static_cast<std::uint32_t>(rings.size());
  for (const Ring& ring : rings) mesh.points.insert(mesh.points.end(), ring.begin(), ring.end());
  for (std::uint32_t k = 0; k + (closed ? 0 : 1) < count; ++k) {
    const bool closing = k + 1 == count;
    const auto here = [&](std::uint32_t i) { return base + k * n + i % n; };
    const auto there = [&](std::uint32_t i) {
      return base + (closing ? 0 : (k + 1) * n) + (i + (closing ? shift : 0)) % n;
    };
    for (std::uint32_t i = 0; i < n; ++i) {
      std::vector<std::uint32_t> quad{here(i), here(i + 1), there(i + 1), there(i)};
      if (inner) std::reverse(quad.begin(), quad.end());
      addFace(mesh, std::move(quad));
    }
  }
  if (closed) return;
  for (int end = 0; end < 2; ++end) {
    std::vector<std::uint32_t> loop(n);
    for (std::uint32_t i = 0; i < n; ++i) loop[i] = base + (end == 0 ? 0 : (count - 1) * n) + i;
    if ((end == 0) != inner) std::reverse(loop.begin(), loop.end());
    if (inner)
      caps[end].holes.push_back(std::move(loop));
    else
      caps[end].outer = std::move(loop);
  }
}

}  // namespace

PolyMesh sweepDisk(std::span<const Eigen::Vector3d> path, bool closed, double radius_m, double inner_radius_m,
                   const Tessellation& tessellation, const EndNormals& ends) {
  PolyMesh mesh;
  const std::vector<Eigen::Vector3d> points = withoutRepeats(path, closed);
  if (points.size() < 2 || !(radius_m > 0) || inner_radius_m >= radius_m) return mesh;
  closed = closed && points.size() >= 3;
  const int segments = segmentCount(radius_m, 2 * std::numbers::pi, tessellation);
  Face caps[2];
  tube(mesh, ringsAlong(points, closed, radius_m, segments, ends), closed, false, caps);
  if (inner_radius_m > 0) tube(mesh, ringsAlong(points, closed, inner_radius_m, segments, ends), closed, true, caps);
  if (!closed) mesh.faces.insert(mesh.faces.end(), {caps[0], caps[1]});
  return mesh;
}

}  // namespace standpoint::geometry
