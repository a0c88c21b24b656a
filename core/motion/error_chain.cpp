// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/motion/error_chain.h"

#include <array>
#include <cmath>
#include <numbers>

#include "core/motion/random_walk.h"
#include "core/motion/rotation_vector.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr double kHurried_radps = std::numbers::pi / 3;

double measured(const ErrorRow& row, const std::vector<ErrorState>& states) {
  double sum = 0;
  for (const auto& [knot, weight] : row.parts)
    for (int k = 0; k < weight.size(); ++k) sum += weight[k] * states[knot][k];
  return sum;
}

// Solves by Cholesky's factors, in place; a row that depends on those before it has no say. Plain loops: Eigen's blocks
// for large matrices follow the processor's caches, and so would the last bits.
using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

void solveSymmetric(Square& matrix, std::vector<double>& right) {
  const Eigen::Index n = matrix.rows();
  std::vector<bool> used(static_cast<std::size_t>(n), true);
  for (Eigen::Index j = 0; j < n; ++j) {
    double pivot = matrix(j, j);
    const double whole = pivot;
    for (Eigen::Index k = 0; k < j; ++k) pivot -= matrix(j, k) * matrix(j, k);
    used[static_cast<std::size_t>(j)] = pivot > 1e-14 * whole;
    const double root = used[static_cast<std::size_t>(j)] ? std::sqrt(pivot) : 0;
    matrix(j, j) = root;
    for (Eigen::Index i = j + 1; i < n; ++i) {
      double sum = matrix(i, j);
      for (Eigen::Index k = 0; k < j; ++k) sum -= matrix(i, k) * matrix(j, k);
      matrix(i, j) = root > 0 ? sum / root : 0;
    }
  }
  const auto divided = [&](double sum, Eigen::Index i) { return matrix(i, i) > 0 ? sum / matrix(i, i) : 0; };
  for (Eigen::Index i = 0; i < n; ++i) {
    double sum = right[static_cast<std::size_t>(i)];
    for (Eigen::Index k = 0; k < i; ++k) sum -= matrix(i, k) * right[static_cast<std::size_t>(k)];
    right[static_cast<std::size_t>(i)] = divided(sum, i);
  }
  for (Eigen::Index i = n - 1; i >= 0; --i) {
    double sum = right[static_cast<std::size_t>(i)];
    for (Eigen::Index k = i + 1; k < n; ++k) sum -= matrix(k, i) * right[static_cast<std::size_t>(k)];
    right[static_cast<std::size_t>(i)] = divided(sum, i);
  }
}

}  // namespace

ErrorChain::ErrorChain(std::span<const ErrorKnot> knots, const ErrorProfile& profile) {
  const double heading = profile.drifts() ? 0 : profile.heading_rad;
  first_sigma_ << profile.plan_m, profile.plan_m, profile.height_m, profile.tilt_rad, profile.tilt_rad, heading,
      profile.scale;
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const ErrorKnot &from = knots[i - 1], &to = knots[i];
    const double seconds = to.time_s - from.time_s, metres = to.way_m - from.way_m;
    const double tilt_kept = portable::exp(-std::min(700.0, seconds / profile.tilt_tau_s));
    const double tilt_sigma = profile.tilt_rad * std::sqrt(1 - tilt_kept * tilt_kept);
    Link link;
    link.way = to.pose.translation - from.pose.translation;
    if (profile.drifts()) {
      const double turn =
          rotationVector(to.pose.rotation * from.pose.rotation.conjugate()).norm() / (seconds * kHurried_radps);
      link.drift = profile.drift_m_sqrt_m * std::sqrt(metres) * (to.degeneracy * from.pose.rotation.toRotationMatrix());
      link.turn_kept = {tilt_kept, tilt_kept, 1};
      link.turn_sigma = {tilt_sigma, tilt_sigma, profile.heading_rad_sqrt_m * std::sqrt(metres) * (1 + turn * turn)};
    } else {
      link.levers = 0;
      link.kept = portable::exp(-std::min(700.0, seconds / profile.tau_s));
      const double fresh = std::sqrt(1 - link.kept * link.kept);
      link.drift = Vector3d(profile.plan_m, profile.plan_m, profile.height_m).asDiagonal();
      link.drift *= fresh;
      link.turn_kept = {tilt_kept, tilt_kept, link.kept};
      link.turn_sigma = {tilt_sigma, tilt_sigma, profile.heading_rad * fresh};
    }
    links_.push_back(link);
  }
}

ErrorState ErrorChain::forward(const Link& link, const ErrorState& state) const {
  const Vector3d turn = state.segment<3>(3);
  ErrorState next;
  next.head<3>() = link.kept * state.head<3>() + link.levers * (turn.cross(link.way) + state[6] * link.way);
  next.segment<3>(3) = link.turn_kept.cwiseProduct(turn);
  next[6] = state[6];
  return next;
}

ErrorState ErrorChain::backward(const Link& link, const ErrorState& weight) const {
  const Vector3d position = weight.head<3>();
  ErrorState before;
  before.head<3>() = link.kept * position;
  before.segment<3>(3) = link.turn_kept.cwiseProduct(weight.segment<3>(3)) + link.levers * link.way.cross(position);
  before[6] = weight[6] + link.levers * link.way.dot(position);
  return before;
}

std::vector<ErrorState> ErrorChain::drawn(std::uint64_t seed, std::uint32_t trajectory) const {
  const auto count = static_cast<std::uint32_t>(links_.size() + 1);
  std::array<std::vector<double>, 6> walk;
  for (std::uint32_t k = 0; k < 6; ++k) walk[k] = RandomWalk({seed, trajectory, MotionProcess::drift, k}).first(count);
  std::vector<ErrorState> states(count);
  for (std::uint32_t k = 0; k < 7; ++k)
    states[0][k] = first_sigma_[k] * normalNumber({seed, trajectory, MotionProcess::first_error, k}, 0, 0);
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const auto fresh = [&](std::size_t k) { return walk[k][i + 1] - walk[k][i]; };
    states[i + 1] = forward(links_[i], states[i]);
    states[i + 1].head<3>() += links_[i].drift * Vector3d(fresh(0), fresh(1), fresh(2));
    states[i + 1].segment<3>(3) += links_[i].turn_sigma.cwiseProduct(Vector3d(fresh(3), fresh(4), fresh(5)));
  }
  return states;
}

std::vector<ErrorState> ErrorChain::covariances(std::vector<ErrorState>& weights) const {
  for (std::size_t i = links_.size(); i > 0; --i) weights[i - 1] += backward(links_[i - 1], weights[i]);
  std::vector<ErrorState> result(weights.size());
  result[0] = first_sigma_.cwiseProduct(first_sigma_).cwiseProduct(weights[0]);
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Link& link = links_[i];
    result[i + 1] = forward(link, result[i]);
    result[i + 1].head<3>() += link.drift * (link.drift.transpose() * weights[i + 1].head<3>());
    result[i + 1].segment<3>(3) +=
        link.turn_sigma.cwiseProduct(link.turn_sigma).cwiseProduct(weights[i + 1].segment<3>(3));
  }
  return result;
}

Result<void> ErrorChain::hold(std::vector<ErrorState>& states, std::span<const ErrorRow> rows,
                              Progress& progress) const {
  if (rows.empty()) return {};
  const auto count = static_cast<Eigen::Index>(rows.size());
  const auto weightsOf = [&](const ErrorRow& row, double by, std::vector<ErrorState>& weights) {
    for (const auto& [knot, weight] : row.parts) weights[knot] += by * weight;
  };
  Square matrix(count, count);
  std::vector<double> right;
  for (Eigen::Index j = 0; j < count; ++j) {
    const ErrorRow& row = rows[static_cast<std::size_t>(j)];
    std::vector<ErrorState> weights(states.size(), ErrorState::Zero());
    weightsOf(row, 1, weights);
    const auto covariance = covariances(weights);
    for (Eigen::Index i = j; i < count; ++i) matrix(i, j) = measured(rows[static_cast<std::size_t>(i)], covariance);
    matrix(j, j) += row.sigma * row.sigma;
    right.push_back(measured(row, states) + row.noise);
    progress.advance(0.8 * static_cast<double>(j) / static_cast<double>(count));
    TRY(progress.check());
  }
  solveSymmetric(matrix, right);
  std::vector<ErrorState> weights(states.size(), ErrorState::Zero());
  for (std::size_t j = 0; j < rows.size(); ++j) weightsOf(rows[j], right[j], weights);
  const auto correction = covariances(weights);
  for (std::size_t i = 0; i < states.size(); ++i) states[i] -= correction[i];
  return {};
}

}  // namespace standpoint
