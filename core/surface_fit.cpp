// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/surface_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include <Eigen/Dense>

namespace standpoint {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Eigen::Vector3d;

constexpr std::size_t kFewest = 100;
constexpr double kTukey = 4.685, kFinest_m = 2e-4, kSettled_m = 2e-6;
constexpr double kAtRest = 0.02, kClosing = 0.6;  // shares of the reach

double medianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The linearised problem: unknowns are the turn times `lever_m`, and the shift, both about `middle`, so that an
// eigenvalue over the sum of weights is the share of the points that hold a motion.
struct Equations {
  Matrix6 normal = Matrix6::Zero();
  Vector6 right = Vector6::Zero();
  double weights = 0, squares = 0;
  std::size_t used = 0;
};

struct Frame {
  Vector3d middle = Vector3d::Zero();
  double lever_m = 1;
  Vector6 row(const Vector3d& p, const Vector3d& n) const {
    Vector6 j;
    j << (p - middle).cross(n) / lever_m, n;
    return j;
  }
};

struct Round {
  std::vector<Vector3d> placed;
  std::vector<SurfaceTouch> touches;
  std::vector<double> off_m;   // along the normal
  std::vector<double> weight;  // 0 where not used
  Frame frame;
};

std::size_t touch(Round& round, const SurfaceSearch& search, double reach_m) {
  std::fill(round.touches.begin(), round.touches.end(), SurfaceTouch());
  search(round.placed, reach_m, round.touches);
  std::size_t met = 0;
  for (std::size_t i = 0; i < round.placed.size(); ++i) {
    const auto& t = round.touches[i];
    if (t.normal.isZero()) continue;
    round.off_m[i] = t.normal.dot(t.position - round.placed[i]);
    ++met;
  }
  return met;
}

// Tukey's biweight about zero; the scale is 1.4826 medians of |off|, and no narrower than `width_m`.
void weigh(Round& round, double width_m) {
  std::vector<double> off;
  for (std::size_t i = 0; i < round.placed.size(); ++i)
    if (!round.touches[i].normal.isZero()) off.push_back(std::abs(round.off_m[i]));
  const double sigma = std::max(kFinest_m, 1.4826 * medianOf(std::move(off)));
  const double width = std::max(width_m, kTukey * sigma);
  for (std::size_t i = 0; i < round.placed.size(); ++i) {
    const double u = round.off_m[i] / width;
    round.weight[i] = round.touches[i].normal.isZero() || std::abs(u) >= 1 ? 0 : (1 - u * u) * (1 - u * u);
  }
}

Equations assemble(Round& round) {
  Vector3d sum = Vector3d::Zero();
  double weights = 0;
  for (std::size_t i = 0; i < round.placed.size(); ++i) {
    sum += round.weight[i] * (round.placed[i] - round.placed.front());
    weights += round.weight[i];
  }
  round.frame.middle = round.placed.front() + sum / weights;
  double lever = 0;
  for (std::size_t i = 0; i < round.placed.size(); ++i)
    lever += round.weight[i] * (round.placed[i] - round.frame.middle).squaredNorm();
  round.frame.lever_m = std::max(1e-3, std::sqrt(lever / weights));
  Equations e;
  for (std::size_t i = 0; i < round.placed.size(); ++i) {
    const double w = round.weight[i];
    if (w == 0) continue;
    const Vector6 j = round.frame.row(round.placed[i], round.touches[i].normal);
    e.normal += w * j * j.transpose();
    e.right += w * round.off_m[i] * j;
    e.squares += w * round.off_m[i] * round.off_m[i];
    e.weights += w;
    ++e.used;
  }
  return e;
}

struct Solution {
  Vector6 step = Vector6::Zero();
  Matrix6 inverse = Matrix6::Zero();  // of the held part
  std::vector<FreeMotion> free;
};

FreeMotion freeMotion(const Vector6& direction, double fraction) {
  FreeMotion motion;
  const Vector3d turn = direction.head<3>(), shift = direction.tail<3>();
  if (turn.norm() > 0.1) motion.axis = turn.normalized();
  if (shift.norm() > 0.1) motion.shift = shift.normalized();
  motion.held_fraction = std::max(0.0, fraction);
  return motion;
}

Solution solve(const Equations& e) {
  const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(e.normal);
  Solution s;
  for (int k = 0; k < 6; ++k) {
    const Vector6 v = eigen.eigenvectors().col(k);
    const double fraction = eigen.eigenvalues()[k] / e.weights;
    if (fraction < kHeldFraction) {
      s.free.push_back(freeMotion(v, fraction));
      continue;
    }
    s.step += v * v.dot(e.right) / eigen.eigenvalues()[k];
    s.inverse += v * v.transpose() / eigen.eigenvalues()[k];
  }
  return s;
}

Pose moved(const Pose& pose, const Frame& frame, const Vector6& step) {
  const Vector3d turn = step.head<3>() / frame.lever_m;
  const double angle = turn.norm();
  const Eigen::Quaterniond by(angle > 0 ? Eigen::AngleAxisd(angle, turn / angle) : Eigen::AngleAxisd::Identity());
  Pose result;
  result.rotation = (by * pose.rotation).normalized();
  if (result.rotation.w() < 0) result.rotation.coeffs() *= -1;
  result.translation = frame.middle + by * (pose.translation - frame.middle) + step.tail<3>();
  return result;
}

// The sandwich of Huber (1967) with one term for each block of space (Liang and Zeger 1986).
Matrix6 covariance(const Round& round, const Matrix6& inverse, double block_m) {
  std::map<std::array<std::int64_t, 3>, Vector6> blocks;
  for (std::size_t i = 0; i < round.placed.size(); ++i) {
    if (round.weight[i] == 0) continue;
    const Vector3d cell = ((round.placed[i] - round.frame.middle) / block_m).array().floor();
    const std::array<std::int64_t, 3> key = {static_cast<std::int64_t>(cell.x()), static_cast<std::int64_t>(cell.y()),
                                             static_cast<std::int64_t>(cell.z())};
    auto& sum = blocks.try_emplace(key, Vector6::Zero()).first->second;
    sum += round.weight[i] * round.off_m[i] * round.frame.row(round.placed[i], round.touches[i].normal);
  }
  Matrix6 meat = Matrix6::Zero();
  for (const auto& [key, sum] : blocks) meat += sum * sum.transpose();
  return inverse * meat * inverse;
}

void place(Round& round, std::span<const Vector3d> points, const Pose& pose) {
  for (std::size_t i = 0; i < points.size(); ++i) round.placed[i] = pose * points[i];
}

double movedBy(std::span<const Vector3d> points, const Pose& a, const Pose& b) {
  double sum = 0;
  for (const auto& p : points) sum += (a * p - b * p).squaredNorm();
  return std::sqrt(sum / static_cast<double>(points.size()));
}

}  // namespace

Result<SurfaceFit> fitToSurface(std::span<const Vector3d> points, const Pose& start, const SurfaceSearch& search,
                                const SurfaceFitOptions& options, Progress& progress) {
  if (points.size() < kFewest)
    return failure(ErrorKind::unusable, "only " + std::to_string(points.size()) +
                                            " distinct points in the cloud; at least 100 are required");
  Round round{std::vector<Vector3d>(points.size()),
              std::vector<SurfaceTouch>(points.size()),
              std::vector<double>(points.size(), 0),
              std::vector<double>(points.size(), 0),
              {}};
  SurfaceFit fit;
  fit.to_from = start;
  // It closes in by steps, each begun when the last has come to rest: floors find their place at once, and by
  // themselves would outvote the few walls that hold a motion along them.
  double reach = options.reach_m;
  Equations equations;
  Solution solution;
  while (fit.iterations < options.max_iterations && !fit.settled) {
    TRY(progress.check());
    progress.advance(static_cast<double>(fit.iterations) / options.max_iterations);
    place(round, points, fit.to_from);
    if (touch(round, search, reach) < kFewest)
      return failure(
          ErrorKind::unusable,
          "fewer than 100 points are near a surface: place the cloud by pairs of points first, or increase the "
          "search distance");
    const bool closed_in = reach <= options.min_reach_m;
    weigh(round, closed_in ? 0 : reach);
    equations = assemble(round);
    solution = solve(equations);
    const Pose next = moved(fit.to_from, round.frame, solution.step);
    const double step_m = solution.step.norm();
    fit.settled = closed_in && step_m < kSettled_m;
    if (!closed_in && step_m < kAtRest * reach) reach = std::max(options.min_reach_m, kClosing * reach);
    fit.to_from = next;
    ++fit.iterations;
  }
  fit.rms_m = std::sqrt(equations.squares / equations.weights);
  fit.used_fraction = static_cast<double>(equations.used) / static_cast<double>(points.size());
  fit.moved_m = movedBy(points, fit.to_from, start);
  fit.free = solution.free;
  const Matrix6 c = covariance(round, solution.inverse, options.block_m);
  fit.sigma_turn_rad = c.diagonal().head<3>().cwiseMax(0).cwiseSqrt() / round.frame.lever_m;
  fit.sigma_shift_m = c.diagonal().tail<3>().cwiseMax(0).cwiseSqrt();
  return fit;
}

}  // namespace standpoint
