// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
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

using Eigen::Vector3d;

constexpr double kSine60 = 0.86602540378443865;
constexpr double kCaptured = 0.25;      // of the radius: how far a point may be off at first
constexpr double kLeastFraction = 0.7;  // of the beams that meet the sphere, to be used
constexpr int kMostIterations = 50;
constexpr std::size_t kMostSphereSeeds = 30000;
constexpr int kMostCandidates = 6;

std::string mm(double metres) {
  const auto tenths = static_cast<long long>(std::llround(std::abs(metres) * 1e4));
  return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " mm";
}

// How far the beam to p passes the centre: of noise in range it knows nothing, so choosing by it favours no point.
double passing(const Vector3d& p, const Vector3d& centre) {
  const Vector3d beam = p.normalized();
  return (centre - centre.dot(beam) * beam).norm();
}

struct Solved {
  TargetFit fit;
  std::size_t met = 0;  // beams within 60°, whatever they came back from
  bool settled = false;
};

Solved solve(std::span<const Vector3d> points, const Vector3d& start, double radius_m, bool free_radius,
             double captured_m) {
  Solved s;
  s.fit.centre = start;
  s.fit.radius_m = radius_m;
  const Eigen::Index unknowns = free_radius ? 4 : 3;
  std::vector<double> residuals;
  double scale = captured_m;
  for (int iteration = 0; iteration < kMostIterations && !s.settled; ++iteration) {
    const Vector3d c = s.fit.centre;
    const double gate = std::min(captured_m, std::max(kTukey * scale, 1e-6));
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero(), plain = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    double squares = 0;
    residuals.clear();
    s.met = s.fit.points = 0;
    for (const auto& p : points) {
      if (passing(p, c) > radius_m * kSine60 || p.dot(c) < 0) continue;
      ++s.met;
      const Vector3d out = p - c;
      const double distance = out.norm(), r = distance - s.fit.radius_m;
      if (std::abs(r) < captured_m) residuals.push_back(std::abs(r));
      if (!(std::abs(r) < gate)) continue;
      const double w = tukeyWeight(r / gate);
      Eigen::Vector4d row;
      row << out / distance, 1;
      normal += w * row * row.transpose();
      plain += row * row.transpose();
      right += w * row * r;
      squares += r * r;
      ++s.fit.points;
    }
    if (s.fit.points <= static_cast<std::size_t>(unknowns)) return s;
    const Eigen::MatrixXd a = normal.topLeftCorner(unknowns, unknowns);
    const Eigen::VectorXd step = solveNormal(a, right.head(unknowns));
    if (!step.allFinite() || step.head<3>().norm() > 2 * radius_m) return s;
    const double before = scale;
    scale = std::max(medianScale(residuals), 1e-7);
    s.settled = step.norm() < 1e-9 && std::abs(scale - before) < 1e-3 * scale;
    s.fit.centre += step.head<3>();
    if (free_radius) s.fit.radius_m += step[3];
    // Tukey's weights cost 5 % of efficiency; the scatter is that of all points they leave in.
    const double variance = squares / static_cast<double>(s.fit.points - static_cast<std::size_t>(unknowns));
    const Eigen::MatrixXd covariance = variance / 0.95 * inverseOfNormal(plain.topLeftCorner(unknowns, unknowns));
    s.fit.covariance_m2 = covariance.topLeftCorner<3, 3>();
    s.fit.radius_sigma_m = free_radius ? std::sqrt(std::max(0.0, covariance(3, 3))) : 0;
    s.fit.residual_m = std::sqrt(squares / static_cast<double>(s.fit.points));
  }
  s.settled = s.settled || s.fit.points > static_cast<std::size_t>(unknowns);
  return s;
}

// A cylinder, an edge or a half-hidden ball fills some sectors round the line of sight only.
int emptySectors(std::span<const Vector3d> points, const TargetFit& fit) {
  constexpr int kSectors = 8;
  std::array<std::size_t, kSectors> count{};
  const Vector3d sight = fit.centre.normalized(), u = sight.unitOrthogonal(), v = sight.cross(u);
  std::size_t all = 0;
  for (const auto& p : points) {
    const double off = passing(p, fit.centre);
    const Vector3d out = p - fit.centre;
    if (off > fit.radius_m * kSine60 || off < 0.5 * fit.radius_m || p.dot(fit.centre) < 0) continue;
    if (std::abs(out.norm() - fit.radius_m) > std::max(5 * fit.residual_m, 1e-5)) continue;
    const double turn = std::atan2(out.dot(v), out.dot(u)) / (2 * std::numbers::pi) + 0.5;
    ++count[std::min<std::size_t>(kSectors - 1, static_cast<std::size_t>(turn * kSectors))];
    ++all;
  }
  return static_cast<int>(
      std::count_if(count.begin(), count.end(), [&](std::size_t n) { return n * kSectors * 4 < all || all == 0; }));
}

// Votes for the centre: a known radius beneath each place of the surface, along its normal.
std::vector<Vector3d> votes(const std::vector<Vector3d>& seeds, double radius_m) {
  const double around_m = 0.5 * radius_m;
  const PlaceGrid grid(seeds, around_m);
  std::vector<Vector3d> result;
  for (const auto& p : seeds) {
    Vector3d sum = Vector3d::Zero();
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    int n = 0;
    grid.near(p, around_m, [&](std::size_t i) {
      const Vector3d d = seeds[i] - p;
      sum += d, squares += d * d.transpose(), ++n;
    });
    if (n < 5) continue;
    const Eigen::Matrix3d spread = squares / n - sum * sum.transpose() / (n * n);
    Vector3d up = principalAxes(spread).axes.col(0);
    if (up.dot(p) > 0) up = -up;
    result.push_back(p - up * radius_m);
  }
  return result;
}

// Where votes crowd, best first, a radius or more apart.
std::vector<Vector3d> peaks(const std::vector<Vector3d>& all, double radius_m) {
  const double near_m = 0.25 * radius_m;
  const PlaceGrid grid(all, near_m);
  std::vector<std::pair<int, std::size_t>> ranked;
  for (std::size_t i = 0; i < all.size(); ++i) {
    int n = 0;
    grid.near(all[i], near_m, [&](std::size_t) { ++n; });
    ranked.emplace_back(-n, i);
  }
  std::sort(ranked.begin(), ranked.end());
  std::vector<Vector3d> result;
  for (const auto& [n, i] : ranked) {
    if (static_cast<int>(result.size()) == kMostCandidates || n * 4 > ranked.front().first) break;
    if (std::any_of(result.begin(), result.end(),
                    [&, at = i](const Vector3d& r) { return (r - all[at]).norm() < radius_m; }))
      continue;
    Vector3d sum = Vector3d::Zero();
    grid.near(all[i], near_m, [&](std::size_t k) { sum += all[k]; });
    result.emplace_back(sum / -n);
  }
  return result;
}

}  // namespace

Result<TargetFit> fitSphere(std::span<const Vector3d> points, const Vector3d& start, const SphereSearch& search) {
  const double radius = search.radius_m;
  const Solved fixed = solve(points, start, radius, false, kCaptured * radius);
  if (fixed.fit.points < search.min_points)
    return failure(noFit(NoFit::few_points, " on the target: " + std::to_string(fixed.fit.points) + " of at least " +
                                                std::to_string(search.min_points) +
                                                "; scan with higher resolution or from closer"));
  const Solved loose = solve(points, fixed.fit.centre, radius, true, 2 * kCaptured * radius);
  const double off = loose.fit.radius_m - radius;
  const bool is_ball = loose.settled && emptySectors(points, loose.fit) <= 2 &&
                       static_cast<double>(loose.fit.points) > kLeastFraction * static_cast<double>(loose.met);
  if (is_ball && std::abs(off) > search.radius_tolerance_m + 3 * loose.fit.radius_sigma_m &&
      loose.fit.residual_m < 0.1 * radius)
    return failure(noFit(NoFit::other_radius, ": fitted " + mm(loose.fit.radius_m) + ", expected " + mm(radius)));
  const double fraction =
      static_cast<double>(fixed.fit.points) / static_cast<double>(std::max<std::size_t>(1, fixed.met));
  if (fraction < kLeastFraction)
    return failure(noFit(NoFit::mixed, ": " + std::to_string(static_cast<int>(fraction * 100)) +
                                           " % of the expected beams hit the target"));
  if (emptySectors(points, fixed.fit) > 2) return failure(noFit(NoFit::parts, ": only parts are visible"));
  return search.free_radius ? loose.fit : fixed.fit;
}

Result<TargetFit> findSphere(std::span<const Vector3d> points, const Vector3d& predicted, const SphereSearch& search) {
  std::vector<Vector3d> region;
  for (const auto& p : points)
    if ((p - predicted).norm() <= search.search_m + 2 * search.radius_m) region.push_back(p);
  if (region.size() < search.min_points)
    return failure(noFit(NoFit::few_points, " near the predicted position: " + std::to_string(region.size())));
  std::vector<Vector3d> seeds;
  for (const auto i : thinned(region, search.radius_m / 8, kMostSphereSeeds)) seeds.push_back(region[i]);
  std::vector<Vector3d> all = votes(seeds, search.radius_m);
  std::erase_if(all, [&](const Vector3d& v) { return (v - predicted).norm() > search.search_m; });
  std::vector<TargetFit> found;
  Error first = noFit(NoFit::none);
  bool tried = false;
  for (const auto& peak : peaks(all, search.radius_m)) {
    auto fit = fitSphere(region, peak, search);
    if (!fit && !tried) first = fit.error();
    tried = true;
    if (!fit) continue;
    const auto same = [&](const TargetFit& f) { return (f.centre - fit->centre).norm() < search.radius_m; };
    if (std::none_of(found.begin(), found.end(), same)) found.push_back(*fit);
  }
  if (found.empty()) return failure(std::move(first));
  if (found.size() > 1)
    return failure(noFit(NoFit::two, " " + mm((found[0].centre - found[1].centre).norm()) +
                                         " apart: specify a position accurate to half of that"));
  return found.front();
}

}  // namespace standpoint
