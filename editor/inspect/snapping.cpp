// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/inspect/snapping.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace standpoint {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kWeld_m = 1e-4;  // corners of triangles that are one
constexpr double kFlat = 0.98;    // cosine between the faces of an edge that counts as none
constexpr double kEdgeOn = 0.12;  // cosine between a normal and the line of sight
constexpr double kAlong = 1e-8;   // squared sine of the angle to a line of sight that an edge goes along
// How much farther from the pointer what is listed may be to go before an edge.
constexpr double kCorner_px = 4, kFace_px = 2;
constexpr std::size_t kMost = 100'000;  // triangles that are looked at: beyond, nothing is snapped to

struct NearTriangle {
  std::array<Vector3d, 3> corners;
  Vector3d normal;
  std::uint32_t product = 0;
};

bool reaches(const Bounds& box, const Vector3d& p, double radius_m) {
  return !box.empty() && ((box.min.array() - radius_m) <= p.array()).all() &&
         ((box.max.array() + radius_m) >= p.array()).all();
}

Vector3d nearestOnSegment(const Vector3d& a, const Vector3d& b, const Vector3d& p) {
  const Vector3d way = b - a;
  const double length2 = way.squaredNorm();
  return length2 > 0 ? Vector3d(a + way * std::clamp((p - a).dot(way) / length2, 0.0, 1.0)) : a;
}

// Of the segment, the place that the line comes nearest to; of one along the line, what is nearest to `met`.
Vector3d nearestOnSegment(const Vector3d& a, const Vector3d& b, const ViewRay& line, const Vector3d& met) {
  const Vector3d way = b - a, across = way - line.direction * way.dot(line.direction);
  const double length2 = across.squaredNorm();
  if (length2 < kAlong * way.squaredNorm()) return nearestOnSegment(a, b, met);
  return a + way * std::clamp((line.origin - a).dot(across) / length2, 0.0, 1.0);
}

Vector3d nearestOnTriangle(const NearTriangle& t, const Vector3d& p) {
  const Vector3d foot = p - t.normal * t.normal.dot(p - t.corners[0]);
  bool inside = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d edge = t.corners[(i + 1) % 3] - t.corners[i];
    inside = inside && edge.cross(foot - t.corners[i]).dot(t.normal) >= 0;
  }
  if (inside) return foot;
  Vector3d best = t.corners[0];
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d on = nearestOnSegment(t.corners[i], t.corners[(i + 1) % 3], p);
    if ((on - p).squaredNorm() < (best - p).squaredNorm()) best = on;
  }
  return best;
}

std::optional<NearTriangle> triangleOf(const Environment& environment, const Instance& instance, std::size_t index) {
  const auto& mesh = *environment.meshes[instance.mesh];
  NearTriangle t;
  t.product = instance.product;
  for (std::size_t i = 0; i < 3; ++i)
    t.corners[i] = instance.world_from_mesh * mesh.positions[mesh.triangles[index][i]].cast<double>();
  const Vector3d twice = (t.corners[1] - t.corners[0]).cross(t.corners[2] - t.corners[0]);
  if (twice.norm() < 1e-12) return std::nullopt;
  t.normal = twice.normalized();
  if (instance.world_from_mesh.linear().determinant() < 0) {  // mirrored: its corners go round the other way
    std::swap(t.corners[1], t.corners[2]);
    t.normal = -t.normal;
  }
  return t;
}

using Welded = std::array<std::int64_t, 3>;
Welded welded(const Vector3d& p) {
  return {std::llround(p.x() / kWeld_m), std::llround(p.y() / kWeld_m), std::llround(p.z() / kWeld_m)};
}

struct Edge {
  Vector3d a, b;
  std::vector<Vector3d> normals;
  std::uint32_t product = 0;
};

// Edges between faces that are not flat to each other, and rims.
std::vector<Edge> edgesOf(const std::vector<NearTriangle>& triangles) {
  std::map<std::pair<Welded, Welded>, Edge> all;
  for (const auto& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3d &a = t.corners[i], &b = t.corners[(i + 1) % 3];
      auto key = std::pair(welded(a), welded(b));
      if (key.first == key.second) continue;
      if (key.second < key.first) std::swap(key.first, key.second);
      auto& edge = all.try_emplace(std::move(key), Edge{a, b, {}, t.product}).first->second;
      edge.normals.push_back(t.normal);
    }
  std::vector<Edge> edges;
  for (auto& [key, edge] : all) {
    const auto& n = edge.normals;
    const bool flat = n.size() > 1 && std::all_of(n.begin(), n.end(), [&](const Vector3d& other) {
                        return std::abs(other.dot(n.front())) > kFlat;
                      });
    if (!flat) edges.push_back(std::move(edge));
  }
  return edges;
}

struct Corner {
  Vector3d at;
  std::vector<Vector3d> ways, normals;
  std::uint32_t product = 0;
};

// Where edges meet that do not go straight on.
std::vector<Corner> cornersOf(const std::vector<Edge>& edges) {
  std::map<Welded, Corner> all;
  for (const auto& edge : edges)
    for (const auto& [at, other] : {std::pair(edge.a, edge.b), std::pair(edge.b, edge.a)}) {
      auto& corner = all.try_emplace(welded(at), Corner{at, {}, {}, edge.product}).first->second;
      corner.ways.push_back((other - at).normalized());
      corner.normals.insert(corner.normals.end(), edge.normals.begin(), edge.normals.end());
    }
  std::vector<Corner> corners;
  for (auto& [key, corner] : all) {
    const Vector3d first = corner.ways.front();
    if (std::any_of(corner.ways.begin(), corner.ways.end(),
                    [&first](const Vector3d& way) { return std::abs(way.dot(first)) < kFlat; }))
      corners.push_back(std::move(corner));
  }
  return corners;
}

std::vector<Vector3d> different(const std::vector<Vector3d>& normals) {
  std::vector<Vector3d> kept;
  for (const auto& n : normals)
    if (std::none_of(kept.begin(), kept.end(), [&](const Vector3d& k) { return k.dot(n) > kFlat; })) kept.push_back(n);
  return kept;
}

// The nearest candidate so far, by pixels.
struct Best {
  const SnapView& view;
  double px;
  std::optional<SnapPlace> place;

  void offer(const Vector3d& at, std::uint32_t product, Snap snap, const std::vector<Vector3d>& normals,
             double before_px = 0) {
    const auto pixel = project(view.camera, at, view.size_px);
    if (!pixel) return;
    const double away = (*pixel - view.pointer_px).norm();
    if (away > view.reach_px || away - before_px >= px || !view.sees(product, at)) return;
    px = away - before_px;
    place = SnapPlace{at, snap, different(normals)};
  }
};

}  // namespace

void Snapping::follow(std::shared_ptr<const Environment> environment) {
  if (environment == environment_) return;
  environment_ = std::move(environment);
  boxes_.clear();
  if (!environment_) return;
  boxes_.reserve(environment_->instances.size());
  for (const auto& instance : environment_->instances)
    boxes_.push_back(environment_->products[instance.product].inScene()
                         ? bounds(*environment_->meshes[instance.mesh], instance.world_from_mesh)
                         : Bounds());
}

std::optional<SnapPlace> Snapping::nearest(std::span<const Vector3d> met, const SnapView& view) const {
  if (!environment_ || met.empty()) return std::nullopt;
  const auto radius_m = [&](const Vector3d& p) {
    const double depth = (p - view.camera.eye()).dot(view.camera.forward());
    return 2 * view.reach_px * view.camera.metresPerPixel(depth, view.size_px.y());
  };
  std::vector<NearTriangle> near;
  std::size_t looked_at = 0;
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    std::vector<std::pair<Vector3d, double>> balls;
    for (const auto& p : met)
      if (const double r = radius_m(p); reaches(boxes_[i], p, r)) balls.emplace_back(p, r);
    if (balls.empty()) continue;
    const auto& instance = environment_->instances[i];
    const std::size_t count = environment_->meshes[instance.mesh]->triangles.size();
    if ((looked_at += count) > kMost) return std::nullopt;
    for (std::size_t k = 0; k < count; ++k) {
      const auto t = triangleOf(*environment_, instance, k);
      if (!t) continue;
      Bounds box;
      for (const auto& corner : t->corners) box.extend(corner);
      if (std::any_of(balls.begin(), balls.end(),
                      [&](const auto& ball) { return reaches(box, ball.first, ball.second); }))
        near.push_back(*t);
    }
  }
  const auto edges = edgesOf(near);
  const ViewRay line = rayThrough(view.camera, view.pointer_px, view.size_px);
  Best best{view, view.reach_px + 1e-9, {}};
  for (const auto& c : cornersOf(edges)) best.offer(c.at, c.product, Snap::corner, c.normals, kCorner_px);
  for (const auto& edge : edges)
    best.offer(nearestOnSegment(edge.a, edge.b, line, met.front()), edge.product, Snap::edge, edge.normals);
  for (const auto& t : near)
    if (std::abs(t.normal.dot(line.direction)) < kEdgeOn)
      best.offer(nearestOnTriangle(t, met.front()), t.product, Snap::face, {t.normal}, kFace_px);
  return best.place;
}

}  // namespace standpoint
