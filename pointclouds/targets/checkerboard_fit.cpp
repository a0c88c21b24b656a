// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "core/decompositions.h"
#include "pointclouds/statistics/cloud_sample.h"
#include "pointclouds/targets/place_grid.h"
#include "pointclouds/targets/target_fit.h"
#include "pointclouds/targets/tukey.h"

namespace standpoint {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kLook = 0.35;  // of the side: within this radius the pattern is looked for
constexpr double kUsed = 0.42;  // of the side, either way from the middle: the plate's border stays out
constexpr std::size_t kMostSeeds = 40000;
constexpr double kRival = 0.6;      // of the best score
constexpr double kExplained = 0.5;  // of the intensities' variance, by the pattern

struct BoardPlane {
  Vector3d place = Vector3d::Zero(), normal = Vector3d::Zero();
  double sigma_m = 0;
};

BoardPlane planeOf(const std::vector<Vector3d>& points, const std::vector<double>& weights) {
  Vector3d sum = Vector3d::Zero();
  double all = 0;
  for (std::size_t i = 0; i < points.size(); ++i) sum += weights[i] * points[i], all += weights[i];
  BoardPlane plane;
  plane.place = sum / all;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3d d = points[i] - plane.place;
    spread += weights[i] * d * d.transpose();
  }
  plane.normal = principalAxes(spread / all).axes.col(0);
  if (plane.normal.dot(plane.place) > 0) plane.normal = -plane.normal;
  return plane;
}

BoardPlane robustPlane(const std::vector<Vector3d>& points) {
  std::vector<double> weights(points.size(), 1), off;
  BoardPlane plane = planeOf(points, weights);
  for (int i = 0; i < 12; ++i) {
    off.clear();
    for (const auto& p : points) off.push_back(std::abs(plane.normal.dot(p - plane.place)));
    plane.sigma_m = std::max(medianScale(off), 1e-7);
    for (std::size_t k = 0; k < points.size(); ++k)
      weights[k] = tukeyWeight(plane.normal.dot(points[k] - plane.place) / (kTukey * plane.sigma_m));
    const double sigma_m = plane.sigma_m;
    plane = planeOf(points, weights);
    plane.sigma_m = sigma_m;
  }
  return plane;
}

// Round the middle of such a plate the intensity goes up and down twice a turn, at a single edge once: the second
// harmonic less the first is largest where the edges cross.
struct Harmonics {
  double score = 0;
  double turn_rad = 0;  // of the edges
};
Harmonics harmonics(const std::vector<Vector2d>& places, const std::vector<float>& intensity, double leave_out_m) {
  double mean = 0;
  for (const float i : intensity) mean += i / static_cast<double>(intensity.size());
  std::complex<double> one = 0, two = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double r = places[i].norm();
    if (r < leave_out_m) continue;
    const std::complex<double> e(places[i].x() / r, places[i].y() / r);
    one += (intensity[i] - mean) * e;
    two += (intensity[i] - mean) * e * e;
  }
  const auto n = static_cast<double>(places.size());
  return {(std::abs(two) - std::abs(one)) / n, (std::arg(two) - std::numbers::pi / 2) / 2};
}

struct Candidate {
  double score = 0;
  Vector3d place = Vector3d::Zero();
};

std::vector<Candidate> candidates(const std::vector<Vector3d>& seeds, const std::vector<float>& intensity,
                                  double side_m) {
  const double look_m = kLook * side_m;
  const PlaceGrid grid(seeds, look_m);
  std::vector<Candidate> all;
  std::vector<Vector3d> near;
  std::vector<Vector2d> flat;
  std::vector<float> bright;
  for (const auto& seed : seeds) {
    near.clear(), flat.clear(), bright.clear();
    grid.near(seed, look_m, [&](std::size_t i) { near.push_back(seeds[i]), bright.push_back(intensity[i]); });
    if (near.size() < 12) continue;
    const BoardPlane plane = planeOf(near, std::vector<double>(near.size(), 1));
    const Vector3d u = plane.normal.unitOrthogonal(), v = plane.normal.cross(u);
    for (const auto& p : near) flat.emplace_back(u.dot(p - seed), v.dot(p - seed));
    all.push_back({harmonics(flat, bright, 0.05 * side_m).score, seed});
  }
  std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  std::vector<Candidate> best;
  for (const auto& c : all) {
    if (best.size() == 6 || c.score <= 0 || c.score < kRival * all.front().score) break;
    const auto close = [&](const Candidate& b) { return (b.place - c.place).norm() < 0.75 * side_m; };
    if (std::none_of(best.begin(), best.end(), close)) best.push_back(c);
  }
  return best;
}

// I = m + a S(x'/w) S(y'/w), with S an edge blurred by the beam.
struct Pattern {
  Vector2d centre = Vector2d::Zero();
  double turn_rad = 0, mean = 0, contrast = 0, width_m = 0;
};
using Vector5d = Eigen::Matrix<double, 5, 1>;  // centre, turn, mean, contrast

Vector2d turned(const Pattern& p, const Vector2d& at) {
  const Vector2d d = at - p.centre;
  const double c = std::cos(p.turn_rad), s = std::sin(p.turn_rad);
  return {c * d.x() + s * d.y(), -s * d.x() + c * d.y()};
}
double edge(double x) { return std::erf(x / std::numbers::sqrt2); }
double slope(double x) { return std::sqrt(2 / std::numbers::pi) * std::exp(-x * x / 2); }

struct PatternFit {
  Pattern pattern;
  double squares = 0, variance = 0;  // of residuals in all; of the intensities in all
  std::size_t points = 0;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};

PatternFit refine(const std::vector<Vector2d>& places, const std::vector<float>& intensity, Pattern p, double side_m) {
  PatternFit fit;
  for (int iteration = 0; iteration < 40; ++iteration) {
    Eigen::Matrix<double, 5, 5> normal = Eigen::Matrix<double, 5, 5>::Zero();
    Vector5d right = Vector5d::Zero();
    double sum = 0, sum_squares = 0;
    fit = {p, 0, 0, 0, Eigen::Matrix2d::Zero()};
    const double c = std::cos(p.turn_rad), s = std::sin(p.turn_rad);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Vector2d q = turned(p, places[i]);
      if (q.cwiseAbs().maxCoeff() > kUsed * side_m) continue;
      const double x = q.x() / p.width_m, y = q.y() / p.width_m;
      const double along_x = p.contrast * slope(x) * edge(y) / p.width_m,
                   along_y = p.contrast * edge(x) * slope(y) / p.width_m;
      Vector5d row;
      row << -c * along_x + s * along_y, -s * along_x - c * along_y, q.y() * along_x - q.x() * along_y, 1,
          edge(x) * edge(y);
      const double r = intensity[i] - p.mean - p.contrast * edge(x) * edge(y);
      normal += row * row.transpose();
      right += row * r;
      fit.squares += r * r;
      sum += intensity[i], sum_squares += static_cast<double>(intensity[i]) * intensity[i];
      ++fit.points;
    }
    if (fit.points < 12) return fit;
    const auto n = static_cast<double>(fit.points);
    fit.variance = sum_squares - sum * sum / n;
    const Vector5d step = solveNormal(normal, right);
    if (!step.allFinite() || p.centre.norm() > side_m) return fit.points = 0, fit;
    fit.covariance = fit.squares / (n - 5) * inverseOfNormal(normal).topLeftCorner<2, 2>();
    // Never further than an edge is wide: beyond, its slope says nothing.
    const double most = p.width_m / std::max(p.width_m, step.head<2>().norm());
    p.centre += most * step.head<2>();
    p.turn_rad += std::clamp(most * step[2], -0.2, 0.2);
    p.mean += step[3];
    p.contrast += step[4];
    if (step.head<2>().norm() < 1e-8) break;
  }
  return fit;
}

// An edge that runs along a column of the scan lies somewhere between two of them, and nothing says where: the width of
// the empty strip across the pattern's axis x or y.
double emptyStrip(const std::vector<Vector2d>& places, const Pattern& p, double side_m, int axis) {
  double below = -side_m, above = side_m;
  for (const auto& place : places) {
    const Vector2d q = turned(p, place);
    if (q.cwiseAbs().maxCoeff() > kUsed * side_m) continue;
    if (q[axis] < 0)
      below = std::max(below, q[axis]);
    else
      above = std::min(above, q[axis]);
  }
  return above - below;
}

void addEmptyStrips(const std::vector<Vector2d>& places, double side_m, PatternFit& fit) {
  const double c = std::cos(fit.pattern.turn_rad), s = std::sin(fit.pattern.turn_rad);
  const Vector2d axes[] = {{c, s}, {-s, c}};
  for (int k = 0; k < 2; ++k)
    if (const double strip = emptyStrip(places, fit.pattern, side_m, k); fit.pattern.width_m < strip / 2)
      fit.covariance += strip * strip / 12 * axes[k] * axes[k].transpose();
}

// From a wide edge, which leads from afar, to the width that fits best.
PatternFit fitPattern(const std::vector<Vector2d>& places, const std::vector<float>& intensity, double side_m) {
  Pattern start;
  start.turn_rad = harmonics(places, intensity, 0.05 * side_m).turn_rad;
  const auto [low, high] = std::minmax_element(intensity.begin(), intensity.end());
  start.mean = (*low + *high) / 2.0;
  start.contrast = (*high - *low) / 2.0;
  start.width_m = side_m / 8;
  PatternFit best = refine(places, intensity, start, side_m);
  if (best.points == 0) return best;
  const double spacing = 2 * kUsed * side_m / std::sqrt(static_cast<double>(best.points));
  const Pattern wide = best.pattern;
  for (const double width : {4.0, 2.5, 1.6, 1.0, 0.6, 0.35}) {
    Pattern narrower = wide;
    narrower.width_m = width * spacing;
    if (narrower.width_m > side_m / 8) continue;
    const PatternFit next = refine(places, intensity, narrower, side_m);
    if (next.points > 0 &&
        next.squares / static_cast<double>(next.points) < best.squares / static_cast<double>(best.points))
      best = next;
  }
  addEmptyStrips(places, side_m, best);
  return best;
}

Result<TargetFit> fitAt(const std::vector<Vector3d>& points, const std::vector<float>& intensity, const Vector3d& start,
                        const CheckerboardSearch& search) {
  std::vector<Vector3d> near;
  for (const auto& p : points)
    if ((p - start).norm() < 0.45 * search.side_m) near.push_back(p);
  if (near.size() < search.min_points)
    return failure(noFit(NoFit::few_points, " on the target: " + std::to_string(near.size()) + " of at least " +
                                                std::to_string(search.min_points) +
                                                "; scan with higher resolution or from closer"));
  const BoardPlane plane = robustPlane(near);
  const Vector3d u = plane.normal.unitOrthogonal(), v = plane.normal.cross(u);
  std::vector<Vector2d> flat;
  std::vector<float> bright;
  double squares = 0;
  const double reach = 5 * std::max(plane.sigma_m, 1e-5);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if ((points[i] - start).norm() > 0.75 * search.side_m) continue;
    const double off = plane.normal.dot(points[i] - plane.place);
    if (std::abs(off) > reach) continue;
    // Where the beam passes the plane: noise in range, and what black shifts it by, do not move it.
    const Vector3d q = points[i] * (plane.normal.dot(plane.place) / plane.normal.dot(points[i]));
    flat.emplace_back(u.dot(q - start), v.dot(q - start));
    bright.push_back(intensity[i]);
    squares += off * off;
  }
  const PatternFit pattern = fitPattern(flat, bright, search.side_m);
  if (pattern.points < search.min_points) return failure(noFit(NoFit::few_points, " on the target"));
  if (!(pattern.squares < (1 - kExplained) * pattern.variance) || !(pattern.pattern.contrast > 0))
    return failure(noFit(NoFit::no_pattern, " found in the intensities"));
  TargetFit fit;
  const Vector3d on_start_plane = start + u * pattern.pattern.centre.x() + v * pattern.pattern.centre.y();
  fit.centre = on_start_plane - plane.normal * plane.normal.dot(on_start_plane - plane.place);
  fit.points = pattern.points;
  fit.residual_m = std::sqrt(squares / static_cast<double>(flat.size()));
  fit.incidence_rad = std::acos(std::clamp(-plane.normal.dot(fit.centre.normalized()), -1.0, 1.0));
  const Eigen::Matrix<double, 3, 2> in_plane = (Eigen::Matrix<double, 3, 2>() << u, v).finished();
  fit.covariance_m2 =
      in_plane * pattern.covariance * in_plane.transpose() +
      plane.normal * plane.normal.transpose() * (fit.residual_m * fit.residual_m / static_cast<double>(fit.points));
  return fit;
}

}  // namespace

Result<TargetFit> findCheckerboard(std::span<const Vector3d> points, std::span<const float> intensity,
                                   const Vector3d& predicted, const CheckerboardSearch& search) {
  if (intensity.size() != points.size())
    return failure(
        noFit(NoFit::no_intensity, ", so checkerboards cannot be detected: use spheres, or a file with intensity"));
  std::vector<Vector3d> region, seeds;
  std::vector<float> bright, seed_bright;
  for (std::size_t i = 0; i < points.size(); ++i)
    if ((points[i] - predicted).norm() <= search.search_m + search.side_m)
      region.push_back(points[i]), bright.push_back(intensity[i]);
  if (region.size() < search.min_points)
    return failure(noFit(NoFit::few_points, " near the predicted position: " + std::to_string(region.size())));
  for (const auto i : thinned(region, search.side_m / 12, kMostSeeds))
    seeds.push_back(region[i]), seed_bright.push_back(bright[i]);
  std::vector<TargetFit> found;
  Error first = noFit(NoFit::none);
  bool tried = false;
  for (const auto& c : candidates(seeds, seed_bright, search.side_m)) {
    if ((c.place - predicted).norm() > search.search_m + 0.25 * search.side_m) continue;
    auto fit = fitAt(region, bright, c.place, search);
    if (!fit && !tried) first = fit.error();
    tried = true;
    if (!fit) continue;
    const auto same = [&](const TargetFit& f) { return (f.centre - fit->centre).norm() < search.side_m / 2; };
    if (std::none_of(found.begin(), found.end(), same)) found.push_back(*fit);
  }
  if (found.empty()) return failure(std::move(first));
  if (found.size() > 1) return failure(noFit(NoFit::two, ": specify a more accurate position"));
  return found.front();
}

}  // namespace standpoint
