// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/simplify/collapses/collapser.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "optimizer/surface/triangle_tree.h"

namespace standpoint {

using Eigen::Vector3d;

namespace {

constexpr std::uint32_t kMaxCorners = 400;  // of one vertex; bounds the time of a fan
constexpr double kShortestFirst = 1e-12;    // among equal costs: 1 m of edge weighs like 1 µm of deviation
constexpr double kLargestTurnCosine = 0.2;  // a triangle may turn by 78° in one step

}  // namespace

Collapser::Collapser(Patch patch, const CollapseOptions& options, const Shape& whole)
    : options_(options),
      rounding_(whole.rounding()),
      capped_(options.max_deviation_m < whole.diagonal()),
      half_size_(whole.half_size),
      patch_(std::move(patch)),
      alive_(patch_.triangles.size()),
      first_corner_(patch_.positions.size(), kNone),
      last_corner_(patch_.positions.size(), kNone),
      next_corner_(3 * patch_.triangles.size(), kNone),
      corner_count_(patch_.positions.size(), 0),
      age_(patch_.positions.size(), 0),
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

// How joining a and b is judged, and the best place for it.
Collapser::Merger Collapser::merge(std::uint32_t a, std::uint32_t b) {
  Merger merger;
  Quadric& q = merger.q;
  q = patch_.quadrics[a];
  q += patch_.quadrics[b];
  const double squared_length = (patch_.positions[a] - patch_.positions[b]).squaredNorm();
  if (options_.memoryless) {
    Solid solid = solids_[a];
    solid.add(solids_[b]);
    forTriangles(a, [&](std::uint32_t i) {  // those of both were counted twice
      const auto& t = patch_.triangles[i];
      if (t[0] != b && t[1] != b && t[2] != b) return;
      const Vector3d& corner = patch_.positions[t[0]];
      solid.add((patch_.positions[t[1]] - corner).cross(patch_.positions[t[2]] - corner), corner, -1);
    });
    q.scale(squared_length);  // what holds edges, in the same unit: m⁶
    q += solid.sweep;
    placeBySolid(a, b, solid, merger);
  } else {
    place(a, b, merger);
  }
  merger.cost = merger.value + kShortestFirst * q.weight * squared_length;
  return merger;
}

void Collapser::placeBySolid(std::uint32_t a, std::uint32_t b, const Solid& solid, Merger& merger) const {
  const Vector3d &pa = patch_.positions[a], &pb = patch_.positions[b], middle = 0.5 * (pa + pb);
  merger.position = pa;
  if (!fixed(a)) {
    merger.position =
        merger.q.minimumInPlane(middle, solid.normal, solid.offset).cwiseMax(-half_size_).cwiseMin(half_size_);
    if (!((merger.position - middle).squaredNorm() <= (pa - pb).squaredNorm() * 4)) merger.position = middle;
  }
  merger.value = merger.q(merger.position);
}

void Collapser::linkCorners() {
  for (std::uint32_t corner = 0; corner < next_corner_.size(); ++corner) {
    const auto v = patch_.triangles[corner / 3][corner % 3];
    if (first_corner_[v] == kNone)
      first_corner_[v] = corner;
    else
      next_corner_[last_corner_[v]] = corner;
    last_corner_[v] = corner;
    ++corner_count_[v];
  }
}

void Collapser::pushAll() {
  queue_.reserve(2 * patch_.triangles.size());
  for (std::uint32_t v = 0; v < patch_.positions.size(); ++v) {
    mark_[v] = ++epoch_;
    forTriangles(v, [&](std::uint32_t i) {
      for (const auto n : patch_.triangles[i]) {
        if (n < v || mark_[n] == epoch_) continue;
        mark_[n] = epoch_;
        if (const auto entry = candidate(v, n)) queue_.append(*entry);
      }
    });
  }
  queue_.arrange();
}

void Collapser::place(std::uint32_t a, std::uint32_t b, Merger& merger) const {
  const Quadric& q = merger.q;
  const Vector3d &pa = patch_.positions[a], &pb = patch_.positions[b];
  const auto take = [&](const Vector3d& p) {
    const double value = q(p);
    if (value >= merger.value) return;
    merger.position = p;
    merger.value = value;
  };
  merger.position = pa;
  merger.value = std::numeric_limits<double>::infinity();
  const double same = q.weight * rounding_ * rounding_;
  if (!options_.lossless && !fixed(a)) {
    const Vector3d middle = 0.5 * (pa + pb), best = q.minimum(middle);
    const bool inside = (best.cwiseAbs().array() <= half_size_.array()).all();
    const bool near =
        (best - middle).squaredNorm() <= 4 * (pb - pa).squaredNorm();  // else ill-conditioned, or not finite
    take(near ? best.cwiseMax(-half_size_).cwiseMin(half_size_) : middle);
    if (inside && near && merger.value > same) return;  // no end is better
  }
  // An end that is as good up to rounding keeps its exact position, so that planes stay planes.
  const Merger best = merger;
  merger.value = std::numeric_limits<double>::infinity();
  take(pa);
  if (!fixed(a)) take(pb);
  if (merger.value > same && best.value < merger.value) merger = best;
}

// Nothing where the two may not join.
std::optional<CollapseQueue::Entry> Collapser::candidate(std::uint32_t a, std::uint32_t b) {
  if (a > b) std::swap(a, b);
  if (fixed(b)) std::swap(a, b);
  if (fixed(b)) return std::nullopt;
  const Merger merger = merge(a, b);
  const auto& q = merger.q;
  if (!options_.memoryless && merger.value > 4 * q.weight * options_.max_deviation_m * options_.max_deviation_m)
    return std::nullopt;
  if (options_.lossless) {
    Quadric f = patch_.features[a];
    f += patch_.features[b];
    if (f(merger.position) > 4 * options_.max_deviation_m * options_.max_deviation_m) return std::nullopt;
  }
  return CollapseQueue::Entry(merger.cost, a, b, age_[a] + age_[b]);
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

// What a candidate really costs. Folding a triangle over costs as if its whole neighbourhood moved by the edge's
// length; a part that vanishes costs its area times its squared size. Both keep a shape able to reach any count, last
// of all.
double Collapser::price(std::uint32_t a, std::uint32_t b, const Merger& merger, const Effect& e) const {
  if (e.surviving == 0) return std::max(merger.cost, merger.q.weight * e.longest_edge * e.longest_edge / 4);
  if (e.flips)
    return std::max(merger.cost, merger.q.weight * (patch_.positions[a] - patch_.positions[b]).squaredNorm());
  return merger.cost;
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
                                       : std::max({distance(patch_.positions[a], after_),
                                                   distance(patch_.positions[b], after_), distance(p, before_)});
  deviation = before + here;
  return deviation > options_.max_deviation_m;
}

void Collapser::apply(std::uint32_t a, std::uint32_t b, const Vector3d& p) {
  for (std::uint32_t corner = first_corner_[b]; corner != kNone; corner = next_corner_[corner]) {
    auto& t = patch_.triangles[corner / 3];
    if (t[0] == kNone) continue;
    if (t[0] == a || t[1] == a || t[2] == a)
      t = {kNone, kNone, kNone}, --alive_;
    else
      t[corner % 3] = a;
  }
  if (first_corner_[a] == kNone)
    first_corner_[a] = first_corner_[b];
  else
    next_corner_[last_corner_[a]] = first_corner_[b];
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
      if (const auto entry = candidate(v, n)) queue_.push(*entry);
    }
  });
}

std::vector<Step> Collapser::run(std::size_t floor, const Progress& progress) {
  std::vector<Step> log;
  log.reserve(patch_.positions.size());
  double dearest = 0;
  for (std::size_t round = 0; !queue_.empty() && alive_ > floor; ++round) {
    if (round % 1024 == 0 && progress.cancelled()) return log;
    const auto c = queue_.pop();
    const auto a = c.a(), b = c.b;
    if (c.age != age_[a] + age_[b] || corner_count_[a] + corner_count_[b] > kMaxCorners) continue;
    const Merger merger = merge(a, b);
    if (c.isBelow(merger.cost)) {  // memoryless: what is around has changed since it was looked at
      queue_.push({merger.cost, a, b, c.age});
      continue;
    }
    const Effect e = effect(a, b, merger.position);
    if (e.vanishing == 0 || (options_.lossless && (e.flips || e.surviving == 0))) continue;
    const double cost = price(a, b, merger, e);
    double deviation = 0;
    if (tooFar(a, b, merger.position, e, deviation)) continue;
    if (c.isBelow(cost)) {
      queue_.push({cost, a, b, c.age});
      continue;
    }
    apply(a, b, merger.position);
    patch_.deviation_m[a] = static_cast<float>(deviation);
    dearest = std::max(dearest, cost);
    const bool flat = !options_.memoryless && merger.value <= 4 * merger.q.weight * rounding_ * rounding_;
    log.push_back({{a, b, e.vanishing, flat, merger.position}, dearest, static_cast<float>(deviation)});
    pushAround(a);
  }
  return log;
}

}  // namespace standpoint
