// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/simplify/attribute_transfer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "optimizer/surface/triangle_tree.h"

namespace standpoint {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector4d;

constexpr auto kNoPaint = std::numeric_limits<std::uint32_t>::max();

struct Paint {
  Vector2d uv = Vector2d::Zero();
  Vector4d colour = Vector4d::Zero();
};

// Of a point of the triangle's plane.
std::array<double, 3> weightsAt(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d normal = (b - a).cross(c - a);
  const double squared = normal.squaredNorm();
  if (!(squared > 0)) return {1, 0, 0};
  const double v = (p - a).cross(c - a).dot(normal) / squared, w = (b - a).cross(p - a).dot(normal) / squared;
  return {1 - v - w, v, w};
}

// A shape on its way through a log, with the paint of each corner.
class Painter {
 public:
  Painter(const Mesh& mesh, const Shape& shape);
  void take(const Collapse& step);
  Mesh result(const Mesh& before, const Shape& shape) const;

 private:
  std::uint32_t groupOf(std::uint32_t wedge) const {
    for (const auto& [known, group] : groups_)
      if (known == wedge) return group;
    return kNoPaint;
  }
  void gather(std::uint32_t v);
  void join(std::uint32_t a, std::uint32_t b);
  Paint paintAt(const Vector3d& p, std::uint32_t group) const;

  std::vector<Vector3d> positions_;
  std::vector<Triangle> triangles_, wedges_;  // the latter indices into paints_
  std::vector<Paint> paints_;
  std::vector<std::uint32_t> first_corner_, next_corner_;
  std::vector<std::uint32_t> ring_;  // the triangles around a step
  std::vector<std::pair<std::uint32_t, std::uint32_t>>
      groups_;  // wedges at the step's two vertices, and which of them become one
};

Painter::Painter(const Mesh& mesh, const Shape& shape)
    : positions_(shape.positions),
      triangles_(shape.triangles),
      wedges_(shape.wedges),
      paints_(mesh.positions.size()),
      first_corner_(shape.positions.size(), kNoPaint),
      next_corner_(3 * shape.triangles.size(), kNoPaint) {
  for (std::size_t i = 0; i < paints_.size(); ++i) {
    if (!mesh.texture_coordinates.empty()) paints_[i].uv = mesh.texture_coordinates[i].cast<double>();
    if (!mesh.colours.empty())
      for (int k = 0; k < 4; ++k) paints_[i].colour[k] = mesh.colours[i][k];
  }
  for (auto corner = static_cast<std::uint32_t>(next_corner_.size()); corner-- > 0;) {
    const auto v = triangles_[corner / 3][corner % 3];
    next_corner_[corner] = first_corner_[v];
    first_corner_[v] = corner;
  }
}

// Adds v's triangles to the ring, and forgets those that are gone.
void Painter::gather(std::uint32_t v) {
  for (std::uint32_t* link = &first_corner_[v]; *link != kNoPaint;) {
    const auto corner = *link;
    if (triangles_[corner / 3][0] == kNoPaint) {
      *link = next_corner_[corner];
      continue;
    }
    if (std::find(ring_.begin(), ring_.end(), corner / 3) == ring_.end()) ring_.push_back(corner / 3);
    link = &next_corner_[corner];
  }
}

void Painter::join(std::uint32_t a, std::uint32_t b) {
  const auto to = groupOf(a), from = groupOf(b);
  for (auto& [wedge, group] : groups_)
    if (group == from) group = to;
}

Paint Painter::paintAt(const Vector3d& p, std::uint32_t group) const {
  double nearest = std::numeric_limits<double>::infinity();
  Paint best;
  for (const auto i : ring_) {
    if (std::none_of(wedges_[i].begin(), wedges_[i].end(), [&](std::uint32_t w) { return groupOf(w) == group; }))
      continue;
    const Vector3d &a = positions_[triangles_[i][0]], &b = positions_[triangles_[i][1]],
                   &c = positions_[triangles_[i][2]];
    const Vector3d foot = closestPoint(p, a, b, c);
    const double squared = (foot - p).squaredNorm();
    if (!(squared < nearest)) continue;
    nearest = squared;
    const auto weights = weightsAt(foot, a, b, c);
    best = {};
    for (int k = 0; k < 3; ++k) {
      best.uv += weights[k] * paints_[wedges_[i][k]].uv;
      best.colour += weights[k] * paints_[wedges_[i][k]].colour;
    }
  }
  return best;
}

void Painter::take(const Collapse& step) {
  const auto a = step.kept, b = step.removed;
  ring_.clear();
  groups_.clear();
  gather(a);
  gather(b);
  for (const auto i : ring_)
    for (int k = 0; k < 3; ++k)
      if (const auto v = triangles_[i][k]; (v == a || v == b) && groupOf(wedges_[i][k]) == kNoPaint)
        groups_.emplace_back(wedges_[i][k], static_cast<std::uint32_t>(groups_.size()));
  for (const auto i : ring_)
    for (int k = 0; k < 3; ++k)
      if (triangles_[i][k] == a && (triangles_[i][(k + 1) % 3] == b || triangles_[i][(k + 2) % 3] == b))
        join(wedges_[i][k], wedges_[i][triangles_[i][(k + 1) % 3] == b ? (k + 1) % 3 : (k + 2) % 3]);
  std::vector<std::uint32_t> wedge_of_group(groups_.size(), kNoPaint);
  for (const auto& [wedge, group] : groups_) {
    if (wedge_of_group[group] != kNoPaint) continue;
    const Paint paint = paintAt(step.position, group);
    wedge_of_group[group] = static_cast<std::uint32_t>(paints_.size());
    paints_.push_back(paint);
  }
  for (const auto i : ring_) {
    auto& t = triangles_[i];
    const auto shared = std::count_if(t.begin(), t.end(), [&](std::uint32_t v) { return v == a || v == b; });
    if (shared > 1) {
      t = {kNoPaint, kNoPaint, kNoPaint};
      continue;
    }
    for (int k = 0; k < 3; ++k)
      if (t[k] == a || t[k] == b) t[k] = a, wedges_[i][k] = wedge_of_group[groupOf(wedges_[i][k])];
  }
  positions_[a] = step.position;
  if (a == b) return;
  std::uint32_t* end = &first_corner_[a];
  while (*end != kNoPaint) end = &next_corner_[*end];
  *end = std::exchange(first_corner_[b], kNoPaint);
}

Mesh Painter::result(const Mesh& before, const Shape& shape) const {
  using Corner = std::pair<std::uint32_t, std::uint32_t>;
  std::vector<Corner> corners;
  for (std::size_t i = 0; i < triangles_.size(); ++i)
    for (int k = 0; triangles_[i][0] != kNoPaint && k < 3; ++k) corners.emplace_back(triangles_[i][k], wedges_[i][k]);
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  Mesh mesh;
  for (const auto& [v, wedge] : corners) {
    mesh.positions.emplace_back((positions_[v] + shape.centre).cast<float>());
    if (!before.texture_coordinates.empty()) mesh.texture_coordinates.emplace_back(paints_[wedge].uv.cast<float>());
    if (before.colours.empty()) continue;
    auto& colour = mesh.colours.emplace_back();
    for (int k = 0; k < 4; ++k)
      colour[k] = static_cast<std::uint8_t>(std::lround(std::clamp(paints_[wedge].colour[k], 0.0, 255.0)));
  }
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    if (triangles_[i][0] == kNoPaint) continue;
    Triangle t{};
    for (int k = 0; k < 3; ++k)
      t[k] = static_cast<std::uint32_t>(
          std::lower_bound(corners.begin(), corners.end(), Corner(triangles_[i][k], wedges_[i][k])) - corners.begin());
    mesh.triangles.push_back(t);
    mesh.surface_of_triangle.push_back(shape.surface_of_triangle[i]);
  }
  sortBySurface(mesh);
  return mesh;
}

}  // namespace

Mesh transferAttributes(const Mesh& before, const Shape& shape, const std::vector<Collapse>& steps) {
  Painter painter(before, shape);
  for (const auto& step : steps) {
    if (step.endsAll()) return {};
    painter.take(step);
  }
  return painter.result(before, shape);
}

}  // namespace standpoint
