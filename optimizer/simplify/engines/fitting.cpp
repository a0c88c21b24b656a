// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/simplify/engines/fitting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "optimizer/surface/deviation.h"
#include "optimizer/surface/farthest.h"
#include "optimizer/surface/manifold.h"

namespace standpoint {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t kPointsPerTriangle = 8, kFewestPoints = 20'000, kMostPoints = 200'000;
constexpr std::size_t kMostVertices = 400'000;  // of the shape, that are looked at beside the points
constexpr int kSolverSteps = 40;
constexpr double kAlong = 0.1;        // of a distance along the surface, what one across it weighs is 1
constexpr double kLeastOfMean = 0.3;  // distances below this fraction of the mean weigh alike
constexpr double kNearLimit = 0.75;   // of the maximum: from there on distances weigh more
constexpr double kStay = 0.02;        // of what the points of a vertex weigh, holds it where it is
constexpr double kLeastCosine = 0.3;  // between the normals of a triangle before and after
constexpr std::size_t kFitChunk = 1024;

struct Foot {  // of a point on the other surface, and what it says
  std::uint32_t triangle = std::numeric_limits<std::uint32_t>::max();  // of the form
  Vector3d weights = Vector3d::Zero();                                 // of its corners
  Vector3d residual = Vector3d::Zero();  // from the place on the form to that on the shape
  bool inside = false;                   // the foot is not on an edge: the residual is upright
  double share = 0;                      // of all points
};

struct Normal {                    // what a triangle adds to the equations
  std::array<Matrix3d, 6> blocks;  // 00 11 22 01 12 20
  std::array<Vector3d, 3> right;
};

struct Distances {
  double mean_m = 0, max_m = 0;
  bool isBetterThan(const Distances& o, double limit_m) const {
    const double over = std::max(max_m, limit_m), other_over = std::max(o.max_m, limit_m);
    return over < other_over * 0.999 || (over <= other_over * 1.001 && mean_m < o.mean_m);
  }
};

Vector3d weightsAt(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d normal = (b - a).cross(c - a);
  const double squared = normal.squaredNorm();
  if (!(squared > 0)) return {1, 0, 0};
  const double v = (p - a).cross(c - a).dot(normal) / squared, w = (b - a).cross(p - a).dot(normal) / squared;
  return {1 - v - w, v, w};
}

class Fitter {
 public:
  Fitter(const Shape& shape, const TriangleTree& tree, const Shape& form, const FitTarget& target);
  std::vector<Collapse> run(const Progress& progress);
  std::vector<FarSpot> farSpots();

 private:
  const Vector3d& at(std::uint32_t triangle, int k) const { return form_.positions[form_.triangles[triangle][k]]; }
  void takeFeet();
  void setFoot(Foot& foot, const Vector3d& place, const Vector3d& goal) const;
  Distances distances() const;
  void sumEquations(double mean_m);
  void solve();
  void apply();
  std::vector<Vector3d> times(const std::vector<Vector3d>& x) const;

  const Shape& shape_;
  const TriangleTree& tree_;
  Shape form_;
  FitTarget target_;
  std::vector<bool> held_;
  std::vector<SurfacePoint> points_;  // of the shape
  // Of the points, of the shape's vertices, of the farthest place of each triangle that is far, then of places on the
  // form.
  std::vector<Foot> feet_;
  std::size_t from_vertices_ = 0, from_far_ = 0;
  std::vector<Normal> normals_;
  std::vector<double> stay_;
  std::vector<Vector3d> moves_;
};

Fitter::Fitter(const Shape& shape, const TriangleTree& tree, const Shape& form, const FitTarget& target)
    : shape_(shape), tree_(tree), form_(form), target_(target), held_(form.positions.size(), false) {
  const auto manifold = manifoldOf(form);
  for (std::size_t i = 0; i < manifold.names.size(); ++i)
    if (manifold.holds[i] != Hold::free) held_[manifold.names[i]] = true;
  for (const auto corner : manifold.border_edges)
    for (const auto c : {corner, nextCorner(corner)}) held_[form.triangles[c / 3][c % 3]] = true;
  const auto count =
      static_cast<std::uint32_t>(std::clamp(kPointsPerTriangle * form.triangles.size(), kFewestPoints, kMostPoints));
  points_ = pointsByArea(shape.positions, shape.triangles, count, {target.seed, 7});
  from_vertices_ = points_.size();
  from_far_ = from_vertices_ + (shape.positions.size() <= kMostVertices ? shape.positions.size() : 0);
}

void Fitter::setFoot(Foot& foot, const Vector3d& place, const Vector3d& goal) const {
  foot.weights = weightsAt(place, at(foot.triangle, 0), at(foot.triangle, 1), at(foot.triangle, 2));
  foot.residual = goal - place;
  foot.inside = foot.weights.minCoeff() > 1e-6;
}

void Fitter::takeFeet() {
  const TriangleTree tree(form_.positions, form_.triangles);
  const auto farPlaces = [&](const Shape& from, const Shape& to, const TriangleTree& tree_of_to) {
    const std::vector<std::uint32_t> unknown;
    const double near_m = kNearLimit * target_.max_m;
    return near_m > 0 ? placesFurther({from, to, tree_of_to, unknown}, near_m * near_m) : std::vector<SurfacePoint>();
  };
  const auto far = farPlaces(shape_, form_, tree);
  auto on_form =
      pointsByArea(form_.positions, form_.triangles, static_cast<std::uint32_t>(points_.size()), {target_.seed, 8});
  const auto by_area = on_form.size();
  for (std::uint32_t i = 0; i < form_.triangles.size(); ++i)  // spikes have little area
    for (int k = 0; k < 3; ++k) on_form.push_back({i, at(i, k)});
  const auto far_on_form = farPlaces(form_, shape_, tree_);
  on_form.insert(on_form.end(), far_on_form.begin(), far_on_form.end());
  const auto first_on_form = from_far_ + far.size();
  feet_.resize(first_on_form + on_form.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, feet_.size(), kFitChunk), [&](const auto& range) {
    for (auto i = range.begin(); i < range.end(); ++i) {
      Foot& foot = feet_[i];
      if (i < first_on_form) {
        const Vector3d& p = i < from_vertices_ ? points_[i].position
                            : i < from_far_    ? shape_.positions[i - from_vertices_]
                                               : far[i - from_far_].position;
        foot.triangle = tree.nearestTriangle(p).triangle;
        foot.share = i < from_vertices_ ? 0.5 / static_cast<double>(from_vertices_) : 0;
        setFoot(foot, closestPoint(p, at(foot.triangle, 0), at(foot.triangle, 1), at(foot.triangle, 2)), p);
      } else {
        const auto& point = on_form[i - first_on_form];
        const auto& t = shape_.triangles[tree_.nearestTriangle(point.position).triangle];
        foot.triangle = point.triangle;
        foot.share = i - first_on_form < by_area ? 0.5 / static_cast<double>(by_area) : 0;
        setFoot(foot, point.position,
                closestPoint(point.position, shape_.positions[t[0]], shape_.positions[t[1]], shape_.positions[t[2]]));
      }
    }
  });
}

Distances Fitter::distances() const {
  Distances result;
  double max_squared = 0;
  for (const auto& foot : feet_) {
    const double squared = foot.residual.squaredNorm();
    max_squared = std::max(max_squared, squared);
    result.mean_m += foot.share * std::sqrt(squared);
  }
  result.max_m = std::sqrt(max_squared);
  return result;
}

void Fitter::sumEquations(double mean_m) {
  Normal nothing;
  nothing.blocks.fill(Matrix3d::Zero());
  nothing.right.fill(Vector3d::Zero());
  normals_.assign(form_.triangles.size(), nothing);
  stay_.assign(form_.positions.size(), 0);
  const double usual = 0.5 / static_cast<double>(points_.size());
  for (const auto& foot : feet_) {
    const double distance = foot.residual.norm(), near = kNearLimit * target_.max_m;
    double weight = foot.share / usual / std::max(distance, kLeastOfMean * mean_m);
    if (distance > near && near > 0) weight += (std::pow(distance / near, 8) - 1) / distance;
    if (!(weight > 0)) continue;
    Matrix3d metric = Matrix3d::Identity();
    if (foot.inside) {
      const Vector3d n =
          (at(foot.triangle, 1) - at(foot.triangle, 0)).cross(at(foot.triangle, 2) - at(foot.triangle, 0)).normalized();
      metric = kAlong * metric + (1 - kAlong) * n * n.transpose();
    }
    metric *= weight;
    const Vector3d pull = metric * foot.residual;
    Normal& sum = normals_[foot.triangle];
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      sum.blocks[k] += foot.weights[k] * foot.weights[k] * metric;
      sum.blocks[3 + k] += foot.weights[k] * foot.weights[next] * metric;
      sum.right[k] += foot.weights[k] * pull;
      stay_[form_.triangles[foot.triangle][k]] += kStay * weight * foot.weights[k];
    }
  }
}

std::vector<Vector3d> Fitter::times(const std::vector<Vector3d>& x) const {
  std::vector<Vector3d> y(x.size());
  for (std::size_t v = 0; v < x.size(); ++v) y[v] = stay_[v] * x[v];
  for (std::size_t i = 0; i < normals_.size(); ++i) {
    const auto& t = form_.triangles[i];
    const auto& sum = normals_[i];
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      y[t[k]] += sum.blocks[k] * x[t[k]] + sum.blocks[3 + k] * x[t[next]];
      y[t[next]] += sum.blocks[3 + k] * x[t[k]];
    }
  }
  for (std::size_t v = 0; v < x.size(); ++v)
    if (held_[v]) y[v].setZero();
  return y;
}

double dot(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

// Conjugate gradients, preconditioned by each vertex's own block.
void Fitter::solve() {
  const auto count = form_.positions.size();
  std::vector<Matrix3d> own(count, Matrix3d::Zero());
  std::vector<Vector3d> rest(count, Vector3d::Zero());
  for (std::size_t i = 0; i < normals_.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      own[form_.triangles[i][k]] += normals_[i].blocks[k];
      rest[form_.triangles[i][k]] += normals_[i].right[k];
    }
  for (std::size_t v = 0; v < count; ++v) {
    const double scale = own[v].trace() + stay_[v];
    if (held_[v] || !(scale > 0)) {
      rest[v].setZero();
      own[v].setZero();
      continue;
    }
    own[v] = (own[v] + (stay_[v] + 1e-9 * scale) * Matrix3d::Identity()).inverse().eval();
  }
  const auto preconditioned = [&](const std::vector<Vector3d>& r) {
    std::vector<Vector3d> z(count);
    for (std::size_t v = 0; v < count; ++v) z[v] = own[v] * r[v];
    return z;
  };
  moves_.assign(count, Vector3d::Zero());
  auto z = preconditioned(rest), direction = z;
  double product = dot(rest, z);
  const double enough = 1e-8 * product;
  for (int step = 0; step < kSolverSteps && product > enough; ++step) {
    const auto image = times(direction);
    const double length = product / dot(direction, image);
    if (!std::isfinite(length)) return;
    for (std::size_t v = 0; v < count; ++v) {
      moves_[v] += length * direction[v];
      rest[v] -= length * image[v];
    }
    z = preconditioned(rest);
    const double next = dot(rest, z);
    for (std::size_t v = 0; v < count; ++v) direction[v] = z[v] + next / product * direction[v];
    product = next;
  }
}

// As far as no triangle turns too much.
void Fitter::apply() {
  const auto target = [&](std::uint32_t v) {
    return Vector3d((form_.positions[v] + moves_[v]).cwiseMax(-shape_.half_size).cwiseMin(shape_.half_size));
  };
  for (int attempt = 0; attempt < 6; ++attempt) {
    std::vector<bool> shorter(form_.positions.size(), false);
    bool any = false;
    for (std::uint32_t i = 0; i < form_.triangles.size(); ++i) {
      const auto& t = form_.triangles[i];
      const Vector3d a = target(t[0]), b = target(t[1]), c = target(t[2]);
      const Vector3d was = (at(i, 1) - at(i, 0)).cross(at(i, 2) - at(i, 0)), is = (b - a).cross(c - a);
      if (is.dot(was) >= kLeastCosine * is.norm() * was.norm() && is.norm() >= 0.05 * was.norm()) continue;
      any = true;
      for (const auto v : t) shorter[v] = true;
    }
    if (!any) break;
    for (std::size_t v = 0; v < shorter.size(); ++v)
      if (shorter[v]) moves_[v] *= attempt < 4 ? 0.5 : 0.0;
  }
  std::vector<Vector3d> next(form_.positions.size());
  for (std::uint32_t v = 0; v < next.size(); ++v) next[v] = moves_[v].isZero() ? form_.positions[v] : target(v);
  form_.positions = std::move(next);
}

std::vector<Collapse> Fitter::run(const Progress& progress) {
  const auto before = form_.positions;
  auto best = before;
  Distances least;
  for (int round = 0; round <= target_.rounds && !progress.cancelled(); ++round) {
    takeFeet();
    const auto now = distances();
    if (round == 0 || now.isBetterThan(least, target_.max_m)) {
      least = now;
      best = form_.positions;
    }
    if (round == target_.rounds) break;
    sumEquations(now.mean_m);
    solve();
    apply();
  }
  std::vector<Collapse> steps;
  for (std::uint32_t v = 0; v < best.size(); ++v)
    if (best[v] != before[v]) steps.push_back({v, v, 0, false, best[v]});
  return steps;
}

std::vector<FarSpot> Fitter::farSpots() {
  takeFeet();
  std::vector<FarSpot> spots;
  for (const auto& foot : feet_) {
    const double distance = foot.residual.norm();
    if (!(distance > target_.max_m)) continue;
    Vector3d place = foot.residual;
    for (int k = 0; k < 3; ++k) place += foot.weights[k] * at(foot.triangle, k);
    spots.push_back({place, distance});
  }
  return spots;
}

}  // namespace

std::vector<FarSpot> farSpots(const Shape& shape, const TriangleTree& tree, const Shape& form,
                              const FitTarget& target) {
  return form.triangles.empty() || shape.triangles.empty() ? std::vector<FarSpot>()
                                                           : Fitter(shape, tree, form, target).farSpots();
}

std::vector<Collapse> fitted(const Shape& shape, const TriangleTree& tree, const Shape& form, const FitTarget& target,
                             const Progress& progress) {
  if (form.triangles.empty() || shape.triangles.empty()) return {};
  return Fitter(shape, tree, form, target).run(progress);
}

}  // namespace standpoint
