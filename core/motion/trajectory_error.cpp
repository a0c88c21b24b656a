// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/motion/trajectory_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/motion/error_chain.h"
#include "core/motion/random_walk.h"
#include "core/motion/rotation_vector.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr double kStep_m = 0.25, kStep_s = 0.25, kShortest_s = 0x1p-10;
constexpr std::size_t kMostConstraints = 600;
constexpr double kLeastSigma_m = 1e-6, kLeastSigma_rad = 1e-8;
constexpr double kShakeFrom_hz = 5, kShakeTo_hz = 20;

// A value with its first two derivatives, so that the curve between two of them is C2 and depends on no third knot.
struct ErrorPiece {
  double time_s = 0;
  std::array<Eigen::Matrix<double, 6, 1>, 3> derivative;  // position, then rotation
};

std::vector<ErrorPiece> piecesOf(const std::vector<KnotError>& errors) {
  std::vector<ErrorPiece> pieces;
  for (const auto& error : errors) {
    ErrorPiece piece{error.time_s, {}};
    piece.derivative[0] << error.position_m, error.rotation_rad;
    piece.derivative[1].setZero();
    piece.derivative[2].setZero();
    pieces.push_back(piece);
  }
  // By the parabola through a knot and its neighbours; the ends stand.
  for (std::size_t i = 1; i + 1 < pieces.size(); ++i) {
    const double a = pieces[i].time_s - pieces[i - 1].time_s, b = pieces[i + 1].time_s - pieces[i].time_s;
    const Eigen::Matrix<double, 6, 1> before = (pieces[i].derivative[0] - pieces[i - 1].derivative[0]) / a,
                                      after = (pieces[i + 1].derivative[0] - pieces[i].derivative[0]) / b;
    pieces[i].derivative[1] = (before * b + after * a) / (a + b);
    pieces[i].derivative[2] = (after - before) * (2 / (a + b));
  }
  return pieces;
}

class ErringPose : public PoseFunction {
 public:
  ErringPose(PoseFunctionPtr truth, const std::vector<KnotError>& errors, const ErrorProfile& profile,
             std::uint64_t seed, std::uint32_t trajectory)
      : truth_(std::move(truth)), pieces_(piecesOf(errors)) {
    for (std::uint32_t k = 0; k < 6; ++k) {
      const double amplitude = k < 3 ? profile.shake_m : profile.shake_rad;
      if (amplitude <= 0) continue;
      const BandNoise noise({seed, trajectory, MotionProcess::within_scan, k}, kShakeFrom_hz, kShakeTo_hz);
      shakes_.push_back({noise, amplitude, k});
    }
  }

  Pose pose(double time_s) const override {
    const double time = std::clamp(time_s, first_s(), last_s());
    const Pose truth = truth_->pose(time);
    const auto error = errorAt(time);
    Eigen::Matrix<double, 6, 1> shaken = Eigen::Matrix<double, 6, 1>::Zero();
    for (const auto& shake : shakes_) shaken[shake.part] += shake.amplitude * shake.noise.at(time);
    return {unitRotation(rotationBy(error.tail<3>()) * truth.rotation * rotationBy(shaken.tail<3>())),
            truth.translation + error.head<3>() + truth.rotation * shaken.head<3>()};
  }
  double first_s() const override { return truth_->first_s(); }
  double last_s() const override { return truth_->last_s(); }

 private:
  struct Shake {
    BandNoise noise;
    double amplitude;
    std::uint32_t part;
  };

  // Hermite's polynomial of the fifth degree.
  Eigen::Matrix<double, 6, 1> errorAt(double time) const {
    if (time <= pieces_.front().time_s) return pieces_.front().derivative[0];
    if (time >= pieces_.back().time_s) return pieces_.back().derivative[0];
    const auto to = std::upper_bound(pieces_.begin(), pieces_.end(), time,
                                     [](double t, const ErrorPiece& piece) { return t < piece.time_s; });
    const auto from = to - 1;
    const double h = to->time_s - from->time_s, u = (time - from->time_s) / h, v = 1 - u;
    const double rise = u * u * u * (10 + u * (6 * u - 15));
    const double slope_from = u * v * v * v * (1 + 3 * u) * h, slope_to = -v * u * u * u * (1 + 3 * v) * h;
    const double bend_from = 0.5 * u * u * v * v * v * h * h, bend_to = 0.5 * v * v * u * u * u * h * h;
    return from->derivative[0] + rise * (to->derivative[0] - from->derivative[0]) + slope_from * from->derivative[1] +
           slope_to * to->derivative[1] + bend_from * from->derivative[2] + bend_to * to->derivative[2];
  }

  PoseFunctionPtr truth_;
  std::vector<ErrorPiece> pieces_;
  std::vector<Shake> shakes_;
};

std::size_t knotAt(std::span<const ErrorKnot> knots, double time_s) {
  const auto after = std::lower_bound(knots.begin(), knots.end(), time_s,
                                      [](const ErrorKnot& knot, double time) { return knot.time_s < time; });
  const auto i = static_cast<std::size_t>(after - knots.begin());
  if (i == knots.size()) return i - 1;
  return i > 0 && time_s - knots[i - 1].time_s < knots[i].time_s - time_s ? i - 1 : i;
}

// The rows of all constraints: what each measures of the errors, and with which sigma.
Result<std::vector<ErrorRow>> rowsOf(std::span<const ErrorKnot> knots, std::span<const MotionConstraint> constraints,
                                     std::uint64_t seed, std::uint32_t trajectory) {
  if (constraints.size() > kMostConstraints)
    return failure(ErrorKind::unusable, fmt::format("a trajectory has at most {} closures and control points, not {}",
                                                    kMostConstraints, constraints.size()));
  std::vector<ErrorRow> rows;
  for (const auto& constraint : constraints) {
    const std::size_t here = knotAt(knots, constraint.time_s);
    const std::size_t there = constraint.same_as_s ? knotAt(knots, *constraint.same_as_s) : here;
    if (constraint.same_as_s && there == here) continue;  // a time is always where it is
    const Vector3d between = knots[here].pose.translation - knots[there].pose.translation;
    for (std::uint32_t k = 0; k < 6; ++k) {
      if (k >= 3 && !constraint.angle_sigma_rad) break;
      ErrorRow row;
      const Vector3d unit = Vector3d::Unit(k % 3);
      ErrorState of_here = ErrorState::Zero(), of_there = ErrorState::Zero();
      if (k < 3) {
        of_here.head<3>() = unit;
        of_there.head<3>() = -unit;
        of_there.segment<3>(3) = -between.cross(unit);
      } else {
        of_here.segment<3>(3) = unit;
        of_there.segment<3>(3) = -unit;
      }
      row.parts.push_back({here, of_here});
      if (constraint.same_as_s) row.parts.push_back({there, of_there});
      row.sigma = k < 3 ? std::max(constraint.position_sigma_m, kLeastSigma_m)
                        : std::max(*constraint.angle_sigma_rad, kLeastSigma_rad);
      const MotionKey key{seed, trajectory, MotionProcess::constraint, k};
      const auto level = constraint.same_as_s ? static_cast<std::uint32_t>(there) + 1 : 0;
      row.noise = row.sigma * normalNumber(key, level, static_cast<std::uint32_t>(here));
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

}  // namespace

Result<std::vector<ErrorKnot>> errorKnots(const PoseFunction& path) {
  const double last = path.last_s();
  if (!std::isfinite(path.first_s()) || !std::isfinite(last))
    return failure(ErrorKind::unusable, "a trajectory without a beginning or an end has no error");
  std::vector<ErrorKnot> knots;
  knots.push_back({path.first_s(), path.pose(path.first_s()), 0});
  while (knots.back().time_s < last) {
    const ErrorKnot& before = knots.back();
    const double left = last - before.time_s;
    double step = left < 2 * kStep_s && left > kStep_s ? left / 2 : kStep_s;  // no step is much shorter than the others
    ErrorKnot next;
    for (;; step /= 2) {
      next.time_s = left <= step ? last : before.time_s + step;
      next.pose = path.pose(next.time_s);
      const double way = (next.pose.translation - before.pose.translation).norm();
      next.way_m = before.way_m + way;
      if (way <= kStep_m || step <= kShortest_s) break;
    }
    if (knots.size() == RandomWalk::kLastKnot || next.time_s <= before.time_s)
      return failure(ErrorKind::unusable, "the trajectory is too long for an error of its own; split it");
    knots.push_back(next);
  }
  return knots;
}

Result<SolvedTrajectory> solveTrajectory(PoseFunctionPtr truth, std::span<const ErrorKnot> knots,
                                         const ErrorProfile& profile, std::span<const MotionConstraint> constraints,
                                         std::uint64_t seed, std::uint32_t trajectory, Progress& progress) {
  if (knots.empty()) return failure(ErrorKind::internal, "a trajectory has at least one knot");
  TRY_ASSIGN(const auto rows, rowsOf(knots, constraints, seed, trajectory));
  const ErrorChain chain(knots, profile);
  auto states = chain.drawn(seed, trajectory);
  TRY(chain.hold(states, rows, progress));
  SolvedTrajectory solved;
  for (std::size_t i = 0; i < knots.size(); ++i)
    solved.errors.push_back({knots[i].time_s, states[i].head<3>(), states[i].segment<3>(3)});
  solved.pose = std::make_shared<ErringPose>(std::move(truth), solved.errors, profile, seed, trajectory);
  return solved;
}

Result<std::vector<ExpectedError>> expectedErrors(std::span<const ErrorKnot> knots, const ErrorProfile& profile,
                                                  std::span<const MotionConstraint> constraints, Progress& progress,
                                                  std::size_t places) {
  if (knots.empty()) return failure(ErrorKind::internal, "a trajectory has at least one knot");
  TRY_ASSIGN(const auto rows, rowsOf(knots, constraints, 0, 0));
  std::vector<std::size_t> at;
  const std::size_t pieces = std::min(std::max<std::size_t>(places, 2), knots.size()) - 1;
  for (std::size_t i = 0; i <= pieces; ++i) at.push_back(pieces > 0 ? i * (knots.size() - 1) / pieces : 0);
  TRY_ASSIGN(const auto variances, ErrorChain(knots, profile).heldVariances(at, rows, progress));
  std::vector<ExpectedError> expected;
  for (std::size_t i = 0; i < at.size(); ++i)
    expected.push_back(
        {knots[at[i]].time_s, variances[i].head<3>().cwiseSqrt(), variances[i].segment<3>(3).cwiseSqrt()});
  return expected;
}

}  // namespace standpoint
