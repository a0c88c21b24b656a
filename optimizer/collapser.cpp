// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/collapser.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "optimizer/triangle_tree.h"

namespace standpoint {

using Eigen::Vector3d;

namespace {

constexpr std::uint32_t kMaxCorners = 400;       // of one vertex; bounds the time of a fan
constexpr double kShortestFirst = 1e-12;         // among equal costs: 1 m of edge weighs like 1 µm of deviation
constexpr double kLargestTurnCosine = 0.2;       // a triangle may turn by 78° in one step

}  // namespace

Collapser::Collapser(Patch patch, const CollapseOptions& options, const Shape& whole)
    : options_(options), rounding_(whole.rounding()), capped_(options.max_deviation_m < whole.diagonal()), half_size_(whole.half_size), patch_(std::move(patch)),
      alive_(patch_.triangles.size()), first_corner_(patch_.positions.size(), kNone), last_corner_(patch_.positions.size(), kNone),
      next_corner_(3 * patch_.triangles.size(), kNone), corner_count_(patch_.positions.size(), 0), age_(patch_.positions.size(), 0),
      mark_(patch_.positions.size(), 0) {
  linkCorners();
  if (options_.memoryless) {
    solids_.resize(patch_.positions.size());
    for (std::uint32_t v = 0; v < solids_.size(); ++v) sumSolid(v);
  }
  pushAll();
}

void Collapser::Solid::add(const Vector3d& area_vector, const Vector3d& point, double sign) {
  sweep.addPlane(area_vector, point, sign);
  normal += sign * area_vector;
  offset += sign * area_vector.dot(point);
}

void Collapser::Solid::add(const Solid& other) {
  sweep += other.sweep;
  normal += other.normal;
  offset += other.offset;
}

void Collapser::sumSolid(std::uint32_t v) {
  Solid sum;
  forTriangles(v, [&](std::uint32_t i) {
    const auto& t = patch_.triangles[i];
    const Vector3d& p = patch_.positions[t[0]];
    sum.add((patch_.positions[t[1]] - p).cross(patch_.positions[t[2]] - p), p, 1);
  });
  solids_[v] = sum;
}

// The quadric by which joining a and b is judged, and the best place for it.
Quadric Collapser::measure(std::uint32_t a, std::uint32_t b, Vector3d& p) {
  Quadric q = patch_.quadrics[a];
  q += patch_.quadrics[b];
  if (!options_.memoryless) {
    p = place(a, b, q);
    return q;
  }
  Solid solid = solids_[a];
  solid.add(solids_[b]);
  forTriangles(a, [&](std::uint32_t i) {  // those of both were counted twice
    const auto& t = patch_.triangles[i];
    if (t[0] != b && t[1] != b && t[2] != b) return;
    const Vector3d& corner = patch_.positions[t[0]];
    solid.add((patch_.positions[t[1]] - corner).cross(patch_.positions[t[2]] - corner), corner, -1);
  });
  q.scale((patch_.positions[a] - patch_.positions[b]).squaredNorm());  // what holds edges, in the same unit: m⁶
  q += solid.sweep;
  const Vector3d middle = 0.5 * (patch_.positions[a] + patch_.positions[b]);
  p = q.minimumInPlane(middle, solid.normal, solid.offset).cwiseMax(-half_size_).cwiseMin(half_size_);
  if (!((p - middle).squaredNorm() <= (patch_.positions[a] - patch_.positions[b]).squaredNorm() * 4)) p = middle;
  return q;
}

void Collapser::linkCorners() {
  for (std::uint32_t corner = 0; corner < next_corner_.size(); ++corner) {
    const auto v = patch_.triangles[corner / 3][corner % 3];
    if (first_corner_[v] == kNone) first_corner_[v] = corner;
    else next_corner_[last_corner_[v]] = corner;
    last_corner_[v] = corner;
    ++corner_count_[v];
  }
}

void Collapser::pushAll() {
  heap_.reserve(2 * patch_.triangles.size());
  for (std::uint32_t v = 0; v < patch_.positions.size(); ++v) {
    mark_[v] = ++epoch_;
    forTriangles(v, [&](std::uint32_t i) {
      for (const auto n : patch_.triangles[i])
        if (n > v && mark_[n] != epoch_) mark_[n] = epoch_, push(v, n);
    });
  }
  std::make_heap(heap_.begin(), heap_.end());
}

Vector3d Collapser::place(std::uint32_t a, std::uint32_t b, const Quadric& q) const {
  if (fixed(a)) return patch_.positions[a];
  const Vector3d &pa = patch_.positions[a], &pb = patch_.positions[b], middle = 0.5 * (pa + pb);
  const double cost_a = q(pa), cost_b = q(pb);
  const Vector3d& end = cost_a <= cost_b ? pa : pb;
  const double cost_end = std::min(cost_a, cost_b);
  // An end that is as good up to rounding keeps its exact position, so that planes stay planes.
  if (options_.lossless || cost_end <= q.weight * rounding_ * rounding_) return end;
  Vector3d best = q.minimum(middle).cwiseMax(-half_size_).cwiseMin(half_size_);
  if (!((best - middle).squaredNorm() <= 4 * (pb - pa).squaredNorm())) best = middle;  // ill-conditioned, or not finite
  return q(best) < cost_end ? best : end;
}

void Collapser::push(std::uint32_t a, std::uint32_t b) {
  if (a > b) std::swap(a, b);
  if (fixed(b)) std::swap(a, b);
  if (fixed(b)) return;
  Vector3d p;
  const Quadric q = measure(a, b, p);
  const double cost = q(p);
  if (!options_.memoryless && cost > 4 * q.weight * options_.max_deviation_m * options_.max_deviation_m) return;
  if (options_.lossless) {
    Quadric f = patch_.features[a];
    f += patch_.features[b];
    if (f(p) > 4 * options_.max_deviation_m * options_.max_deviation_m) return;
  }
  heap_.push_back({cost + kShortestFirst * q.weight * (patch_.positions[a] - patch_.positions[b]).squaredNorm(), a, b, std::uint64_t{age_[a]} + age_[b]});
}

void Collapser::addEffect(std::uint32_t v, std::uint32_t other, bool first, const Vector3d& p, Effect& e) {
  forTriangles(v, [&](std::uint32_t i) {
    const auto& t = patch_.triangles[i];
    const bool shared = t[0] == other || t[1] == other || t[2] == other;
    if (shared && !first) return;
    std::array<Vector3d, 3> old{patch_.positions[t[0]], patch_.positions[t[1]], patch_.positions[t[2]]};
    if (capped_) before_.push_back(old);
    if (shared) {
      ++e.vanishing;
      for (int k = 0; k < 3; ++k) e.longest_edge = std::max(e.longest_edge, (old[k] - old[(k + 1) % 3]).norm());
      return;
    }
    ++e.surviving;
    auto now = old;
    for (int k = 0; k < 3; ++k)
      if (t[k] == v) now[k] = p;
    if (capped_) after_.push_back(now);
    const Vector3d e1 = old[1] - old[0], e2 = old[2] - old[0], f1 = now[1] - now[0], f2 = now[2] - now[0];
    const Vector3d n = e1.cross(e2), m = f1.cross(f2);
    const bool flat_now = isFlat(m, f1, f2);
    e.flips |= isFlat(n, e1, e2) ? !flat_now : flat_now || n.dot(m) < kLargestTurnCosine * n.norm() * m.norm();
  });
}

Collapser::Effect Collapser::effect(std::uint32_t a, std::uint32_t b, const Vector3d& p) {
  Effect e;
  before_.clear();
  after_.clear();
  addEffect(a, b, true, p, e);
  addEffect(b, a, false, p, e);
  return e;
}

// What a candidate really costs. Folding a triangle over costs as if its whole neighbourhood moved by the edge's length;
// a part that vanishes costs its area times its squared size. Both keep a shape able to reach any count, last of all.
double Collapser::price(const Candidate& c, const Quadric& q, const Effect& e) const {
  if (e.surviving == 0) return std::max(c.cost, q.weight * e.longest_edge * e.longest_edge / 4);
  if (e.flips) return std::max(c.cost, q.weight * (patch_.positions[c.a] - patch_.positions[c.b]).squaredNorm());
  return c.cost;
}

bool Collapser::tooFar(std::uint32_t a, std::uint32_t b, const Vector3d& p, const Effect& e, double& deviation) const {
  const double before = std::max(patch_.deviation_m[a], patch_.deviation_m[b]);
  deviation = before;
  if (!capped_) return false;
  const auto distance = [](const Vector3d& from, const std::vector<std::array<Vector3d, 3>>& star) {
    double best = std::numeric_limits<double>::infinity();
    for (const auto& t : star) best = std::min(best, (closestPoint(from, t[0], t[1], t[2]) - from).squaredNorm());
    return std::sqrt(best);
  };
  const double here = e.surviving == 0 ? e.longest_edge / 2
                                       : std::max({distance(patch_.positions[a], after_), distance(patch_.positions[b], after_), distance(p, before_)});
  deviation = before + here;
  return deviation > options_.max_deviation_m;
}

void Collapser::apply(std::uint32_t a, std::uint32_t b, const Vector3d& p) {
  for (std::uint32_t corner = first_corner_[b]; corner != kNone; corner = next_corner_[corner]) {
    auto& t = patch_.triangles[corner / 3];
    if (t[0] == kNone) continue;
    if (t[0] == a || t[1] == a || t[2] == a) t = {kNone, kNone, kNone}, --alive_;
    else t[corner % 3] = a;
  }
  if (first_corner_[a] == kNone) first_corner_[a] = first_corner_[b];
  else next_corner_[last_corner_[a]] = first_corner_[b];
  if (first_corner_[b] != kNone) last_corner_[a] = last_corner_[b];
  corner_count_[a] += corner_count_[b];
  first_corner_[b] = kNone;
  patch_.positions[a] = p;
  patch_.quadrics[a] += patch_.quadrics[b];
  if (options_.lossless) patch_.features[a] += patch_.features[b];
  ++age_[a];
  ++age_[b];
  if (!options_.memoryless) return;
  sumSolid(a);
  ++epoch_;
  mark_[a] = epoch_;
  forTriangles(a, [&](std::uint32_t i) {
    for (const auto n : patch_.triangles[i])
      if (mark_[n] != epoch_) mark_[n] = epoch_, sumSolid(n);
  });
}

void Collapser::pushAround(std::uint32_t v) {
  ++epoch_;
  mark_[v] = epoch_;
  forTriangles(v, [&](std::uint32_t i) {
    for (const auto n : patch_.triangles[i]) {
      if (mark_[n] == epoch_) continue;
      mark_[n] = epoch_;
      const auto size = heap_.size();
      push(v, n);
      if (heap_.size() > size) std::push_heap(heap_.begin(), heap_.end());
    }
  });
}

std::vector<Step> Collapser::run(std::size_t floor, const Progress& progress) {
  std::vector<Step> log;
  log.reserve(patch_.positions.size());
  double dearest = 0;
  for (std::size_t round = 0; !heap_.empty() && alive_ > floor; ++round) {
    if (round % 1024 == 0 && progress.cancelled()) return log;
    std::pop_heap(heap_.begin(), heap_.end());
    Candidate c = heap_.back();
    heap_.pop_back();
    if (c.age != std::uint64_t{age_[c.a]} + age_[c.b] || corner_count_[c.a] + corner_count_[c.b] > kMaxCorners) continue;
    Vector3d p;
    const Quadric q = measure(c.a, c.b, p);
    if (options_.memoryless) {  // what is around may have changed since it was looked at
      const double now = q(p);
      if (now > 1.000001 * c.cost) {
        c.cost = now;
        heap_.push_back(c);
        std::push_heap(heap_.begin(), heap_.end());
        continue;
      }
    }
    const Effect e = effect(c.a, c.b, p);
    if (e.vanishing == 0 || (options_.lossless && (e.flips || e.surviving == 0))) continue;
    const double cost = price(c, q, e);
    double deviation = 0;
    if (tooFar(c.a, c.b, p, e, deviation)) continue;
    if (cost > c.cost) {
      c.cost = cost;
      heap_.push_back(c);
      std::push_heap(heap_.begin(), heap_.end());
      continue;
    }
    apply(c.a, c.b, p);
    patch_.deviation_m[c.a] = static_cast<float>(deviation);
    dearest = std::max(dearest, cost);
    log.push_back({{c.a, c.b, e.vanishing, !options_.memoryless && q(p) <= 4 * q.weight * rounding_ * rounding_, p}, dearest, static_cast<float>(deviation)});
    pushAround(c.a);
  }
  return log;
}

}  // namespace standpoint
