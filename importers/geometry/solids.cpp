// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include "importers/geometry/kernel.h"
#include "importers/geometry/polygon.h"

namespace standpoint::geometry {
namespace {

constexpr double kFullCircle_rad = 2 * std::numbers::pi;
constexpr int kMaxArcSegments = 4096;  // a radius in the wrong unit must not fill the memory

std::vector<const Loop2*> loopsOf(const Region2& region) {
  std::vector<const Loop2*> loops{&region.outer};
  for (const Loop2& hole : region.holes) loops.push_back(&hole);
  return loops;
}

// Turns loops without taking points away, so that neighbours still correspond; the first point stays the first.
void turnLoops(Region2& region) {
  const auto turn = [](Loop2& loop, double sign) {
    if (!loop.empty() && sign * signedArea(loop) < 0) std::reverse(loop.begin() + 1, loop.end());
  };
  turn(region.outer, 1);
  for (Loop2& hole : region.holes) turn(hole, -1);
}

// One section of a sweep: its points in space and where each loop of the profile begins among them.
struct Sections {
  PolyMesh mesh;
  std::vector<std::uint32_t> loop_sizes;
  std::uint32_t section_size = 0;
};

void cap(Sections& s, std::uint32_t section, bool reversed) {
  Face face;
  std::uint32_t next = section * s.section_size;
  for (std::size_t l = 0; l < s.loop_sizes.size(); ++l) {
    std::vector<std::uint32_t> loop(s.loop_sizes[l]);
    for (std::uint32_t& i : loop) i = next++;
    if (reversed) std::reverse(loop.begin(), loop.end());
    if (l == 0)
      face.outer = std::move(loop);
    else
      face.holes.push_back(std::move(loop));
  }
  s.mesh.faces.push_back(std::move(face));
}

void join(Sections& s, std::uint32_t from, std::uint32_t to) {
  std::uint32_t base = 0;
  for (std::uint32_t size : s.loop_sizes) {
    for (std::uint32_t i = 0; i < size; ++i) {
      const std::uint32_t a = base + i, b = base + (i + 1) % size;
      const std::uint32_t f = from * s.section_size, t = to * s.section_size;
      addFace(s.mesh, {f + a, f + b, t + b, t + a});
    }
    base += size;
  }
}

PolyMesh joinSections(Sections s, std::uint32_t count, bool closed) {
  if (!closed) cap(s, 0, true);
  for (std::uint32_t i = 0; i + 1 < count; ++i) join(s, i, i + 1);
  if (closed)
    join(s, count - 1, 0);
  else
    cap(s, count - 1, false);
  if (volume(s.mesh) < 0) flip(s.mesh);
  return std::move(s.mesh);
}

Loop2 circle(double radius_m, int segments) {
  Loop2 loop;
  for (int i = 0; i < segments; ++i) {
    const double angle = kFullCircle_rad * i / segments;
    loop.emplace_back(radius_m * std::cos(angle), radius_m * std::sin(angle));
  }
  return loop;
}

bool sameShape(const Region2& a, const Region2& b) {
  return a.outer.size() == b.outer.size() &&
         std::equal(a.holes.begin(), a.holes.end(), b.holes.begin(), b.holes.end(),
                    [](const Loop2& x, const Loop2& y) { return x.size() == y.size(); });
}

}  // namespace

int segmentCount(double radius_m, double sweep_rad, const Tessellation& tessellation) {
  const double sweep = std::min(std::abs(sweep_rad), kFullCircle_rad);
  const bool full = sweep > kFullCircle_rad - 1e-9;
  const double chord = std::clamp(1.0 - tessellation.chord_error_m / std::max(std::abs(radius_m), 1e-12), -1.0, 1.0);
  double step = 2 * std::acos(chord);
  if (tessellation.max_segment_angle_rad > 0) step = std::min(step, tessellation.max_segment_angle_rad);
  double count = std::ceil(sweep / step - 1e-9);
  if (!(count >= 1)) count = std::isnan(count) || step > 0 ? 1 : kMaxArcSegments;
  const int segments = static_cast<int>(std::min<double>(count, kMaxArcSegments));
  return full ? std::max(4, (segments + 3) / 4 * 4) : segments;
}

PolyMesh extrude(const Region2& profile, const Eigen::Vector3d& direction_unit, double depth_m) {
  Region2 clean = profile;
  normalise(clean);
  if (clean.outer.size() < 3) return {};
  return extrudeTapered(clean, clean, direction_unit, depth_m);
}

PolyMesh extrudeTapered(const Region2& from, const Region2& to, const Eigen::Vector3d& direction_unit, double depth_m) {
  std::vector<Region2> profiles{from, to};
  std::vector<Eigen::Isometry3d> frames(2, Eigen::Isometry3d::Identity());
  frames[1].translation() = direction_unit * depth_m;
  return loft(profiles, frames, false).value_or(PolyMesh{});
}

Result<PolyMesh> loft(std::span<const Region2> profiles, std::span<const Eigen::Isometry3d> frames, bool closed) {
  if (profiles.size() != frames.size() || profiles.size() < (closed ? 3u : 2u)) {
    return failure(ErrorKind::unusable,
                   "a loft requires one frame per profile and at least two profiles (closed: three)");
  }
  Sections s;
  for (std::size_t k = 0; k < profiles.size(); ++k) {
    if (profiles[k].outer.size() < 3) return failure(ErrorKind::unusable, "a profile has fewer than three points");
    if (!sameShape(profiles[k], profiles[0])) {
      return failure(ErrorKind::unusable, "the profiles of a loft have different numbers of points");
    }
    Region2 turned = profiles[k];
    turnLoops(turned);
    for (const Loop2* loop : loopsOf(turned)) {
      if (k == 0) s.loop_sizes.push_back(static_cast<std::uint32_t>(loop->size()));
      for (const Eigen::Vector2d& p : *loop) s.mesh.points.push_back(frames[k] * Eigen::Vector3d(p.x(), p.y(), 0));
    }
    if (k == 0) s.section_size = static_cast<std::uint32_t>(s.mesh.points.size());
  }
  return joinSections(std::move(s), static_cast<std::uint32_t>(profiles.size()), closed);
}

PolyMesh revolve(const Region2& profile, const Eigen::Vector3d& axis_point, const Eigen::Vector3d& axis_unit,
                 double angle_rad, const Tessellation& tessellation) {
  Region2 clean = profile;
  normalise(clean);
  if (clean.outer.size() < 3 || !std::isfinite(angle_rad) || angle_rad == 0) return {};
  const bool closed = std::abs(angle_rad) > kFullCircle_rad - 1e-9;
  Sections s;
  double radius = 0;
  std::vector<Eigen::Vector3d> section;
  std::vector<bool> on_axis;
  for (const Loop2* loop : loopsOf(clean)) {
    s.loop_sizes.push_back(static_cast<std::uint32_t>(loop->size()));
    for (const Eigen::Vector2d& p : *loop) {
      const Eigen::Vector3d arm = Eigen::Vector3d(p.x(), p.y(), 0) - axis_point;
      const double distance = axis_unit.cross(arm).norm();
      on_axis.push_back(distance < kSnap_m);
      section.push_back(on_axis.back() ? Eigen::Vector3d(axis_point + axis_unit * axis_unit.dot(arm))
                                       : arm + axis_point);
      radius = std::max(radius, distance);
    }
  }
  s.section_size = static_cast<std::uint32_t>(section.size());
  const int segments = segmentCount(radius, angle_rad, tessellation);
  const int sections = closed ? segments : segments + 1;
  for (int k = 0; k < sections; ++k) {
    const Eigen::AngleAxisd turn((closed ? std::copysign(kFullCircle_rad, angle_rad) : angle_rad) * k / segments,
                                 axis_unit);
    for (const Eigen::Vector3d& p : section) s.mesh.points.push_back(axis_point + turn * (p - axis_point));
  }
  PolyMesh mesh = joinSections(s, static_cast<std::uint32_t>(sections), closed);
  // Points of the axis are the same in every section: the quads beside it become triangles, those along it vanish.
  const auto weld = [&](std::vector<std::uint32_t>& loop) {
    for (std::uint32_t& i : loop) {
      if (on_axis[i % s.section_size]) i %= s.section_size;
    }
  };
  for (Face& face : std::exchange(mesh.faces, {})) {
    weld(face.outer);
    for (auto& hole : face.holes) weld(hole);
    if (face.holes.empty())
      addFace(mesh, std::move(face.outer));
    else
      mesh.faces.push_back(std::move(face));
  }
  return mesh;
}

PolyMesh box(const Eigen::Vector3d& size_m) {
  const Region2 base{{{0, 0}, {size_m.x(), 0}, {size_m.x(), size_m.y()}, {0, size_m.y()}}, {}};
  return extrude(base, Eigen::Vector3d::UnitZ(), size_m.z());
}

PolyMesh cylinder(double radius_m, double height_m, const Tessellation& tessellation) {
  const Region2 base{circle(radius_m, segmentCount(radius_m, kFullCircle_rad, tessellation)), {}};
  return extrude(base, Eigen::Vector3d::UnitZ(), height_m);
}

PolyMesh cone(double radius_m, double height_m, const Tessellation& tessellation) {
  PolyMesh mesh;
  const int n = segmentCount(radius_m, kFullCircle_rad, tessellation);
  for (const Eigen::Vector2d& p : circle(radius_m, n)) mesh.points.emplace_back(p.x(), p.y(), 0);
  mesh.points.emplace_back(0, 0, height_m);
  const auto apex = static_cast<std::uint32_t>(n);
  std::vector<std::uint32_t> base;
  for (std::uint32_t i = 0; i < apex; ++i) {
    addFace(mesh, {i, (i + 1) % apex, apex});
    base.push_back(apex - 1 - i);
  }
  addFace(mesh, std::move(base));
  if (height_m < 0) flip(mesh);
  return mesh;
}

PolyMesh sphere(double radius_m, const Tessellation& tessellation) {
  PolyMesh mesh;
  const auto n = static_cast<std::uint32_t>(segmentCount(radius_m, kFullCircle_rad, tessellation));
  const std::uint32_t stacks = n / 2;
  mesh.points.emplace_back(0, 0, -radius_m);
  for (std::uint32_t k = 1; k < stacks; ++k) {
    const double latitude = std::numbers::pi * k / stacks;
    for (const Eigen::Vector2d& p : circle(radius_m * std::sin(latitude), static_cast<int>(n))) {
      mesh.points.emplace_back(p.x(), p.y(), -radius_m * std::cos(latitude));
    }
  }
  mesh.points.emplace_back(0, 0, radius_m);
  const auto top = static_cast<std::uint32_t>(mesh.points.size() - 1);
  const auto at = [n](std::uint32_t stack, std::uint32_t i) { return 1 + (stack - 1) * n + i % n; };
  for (std::uint32_t i = 0; i < n; ++i) {
    addFace(mesh, {0, at(1, i + 1), at(1, i)});
    for (std::uint32_t k = 1; k + 1 < stacks; ++k)
      addFace(mesh, {at(k, i), at(k, i + 1), at(k + 1, i + 1), at(k + 1, i)});
    addFace(mesh, {at(stacks - 1, i), at(stacks - 1, i + 1), top});
  }
  return mesh;
}

PolyMesh pyramid(double x_m, double y_m, double height_m) {
  PolyMesh mesh;
  mesh.points = {{0, 0, 0}, {x_m, 0, 0}, {x_m, y_m, 0}, {0, y_m, 0}, {x_m / 2, y_m / 2, height_m}};
  for (std::vector<std::uint32_t> loop :
       {std::vector<std::uint32_t>{3, 2, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}) {
    addFace(mesh, std::move(loop));
  }
  if (volume(mesh) < 0) flip(mesh);
  return mesh;
}

}  // namespace standpoint::geometry
