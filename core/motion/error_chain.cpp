// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/motion/error_chain.h"

#include <algorithm>
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

using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Cholesky's factor of a symmetric matrix, in its lower half; a row that depends on those before it gets a pivot of 0
// and has no say. Plain loops: Eigen's blocks for large matrices follow the processor's caches, and so would the last
// bits.
void factorise(Square& matrix) {
  const Eigen::Index n = matrix.rows();
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j <= i; ++j) {
      double sum = matrix(i, j);
      for (Eigen::Index k = 0; k < j; ++k) sum -= matrix(i, k) * matrix(j, k);
      if (j < i)
        matrix(i, j) = matrix(j, j) > 0 ? sum / matrix(j, j) : 0;
      else
        matrix(i, i) = sum > 1e-14 * matrix(i, i) ? std::sqrt(sum) : 0;
    }
}

double divided(double sum, double pivot) { return pivot > 0 ? sum / pivot : 0; }

// L⁻¹ times a vector, in place; and after it L⁻ᵀ.
void solveLower(const Square& factor, Eigen::VectorXd& vector) {
  for (Eigen::Index i = 0; i < vector.size(); ++i) {
    double sum = vector[i];
    for (Eigen::Index k = 0; k < i; ++k) sum -= factor(i, k) * vector[k];
    vector[i] = divided(sum, factor(i, i));
  }
}
void solveUpper(const Square& factor, Eigen::VectorXd& vector) {
  for (Eigen::Index i = vector.size() - 1; i >= 0; --i) {
    double sum = vector[i];
    for (Eigen::Index k = i + 1; k < vector.size(); ++k) sum -= factor(k, i) * vector[k];
    vector[i] = divided(sum, factor(i, i));
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

std::vector<ErrorState> ErrorChain::covariancesWith(const ErrorRow& row) const {
  std::vector<ErrorState> weights(links_.size() + 1, ErrorState::Zero());
  for (const auto& [knot, weight] : row.parts) weights[knot] += weight;
  return covariances(weights);
}

Result<void> ErrorChain::hold(std::vector<ErrorState>& states, std::span<const ErrorRow> rows,
                              Progress& progress) const {
  if (rows.empty()) return {};
  const auto count = static_cast<Eigen::Index>(rows.size());
  Square matrix(count, count);
  Eigen::VectorXd right(count);
  for (Eigen::Index j = 0; j < count; ++j) {
    const ErrorRow& row = rows[static_cast<std::size_t>(j)];
    const auto covariance = covariancesWith(row);
    for (Eigen::Index i = j; i < count; ++i) matrix(i, j) = measured(rows[static_cast<std::size_t>(i)], covariance);
    matrix(j, j) += row.sigma * row.sigma;
    right[j] = measured(row, states) + row.noise;
    progress.advance(0.8 * static_cast<double>(j) / static_cast<double>(count));
    TRY(progress.check());
  }
  factorise(matrix);
  solveLower(matrix, right);
  solveUpper(matrix, right);
  std::vector<ErrorState> weights(states.size(), ErrorState::Zero());
  for (Eigen::Index j = 0; j < count; ++j)
    for (const auto& [knot, weight] : rows[static_cast<std::size_t>(j)].parts) weights[knot] += right[j] * weight;
  const auto correction = covariances(weights);
  for (std::size_t i = 0; i < states.size(); ++i) states[i] -= correction[i];
  return {};
}

std::vector<ErrorState> ErrorChain::variances(std::span<const std::size_t> knots) const {
  using Covariance = Eigen::Matrix<double, 7, 7>;
  Covariance covariance = first_sigma_.cwiseProduct(first_sigma_).asDiagonal();
  std::vector<ErrorState> result;
  std::size_t next = 0;
  for (std::size_t i = 0; next < knots.size(); ++i) {
    for (; next < knots.size() && knots[next] == i; ++next) result.push_back(covariance.diagonal());
    if (i == links_.size()) break;
    const Link& link = links_[i];
    Covariance half, whole;  // F P, then F (F P)ᵀ
    for (int k = 0; k < 7; ++k) half.row(k) = forward(link, covariance.col(k)).transpose();
    for (int k = 0; k < 7; ++k) whole.col(k) = forward(link, half.col(k));
    covariance = whole;
    covariance.topLeftCorner<3, 3>() += link.drift * link.drift.transpose();
    covariance.block<3, 3>(3, 3) += link.turn_sigma.cwiseProduct(link.turn_sigma).asDiagonal();
  }
  return result;
}

// What the rows take from a variance is |L⁻¹ c|², c being the covariances with them and L Lᵀ those among them.
Result<std::vector<ErrorState>> ErrorChain::heldVariances(std::span<const std::size_t> knots,
                                                          std::span<const ErrorRow> rows, Progress& progress) const {
  auto result = variances(knots);
  const auto count = static_cast<Eigen::Index>(rows.size());
  Square matrix(count, count);
  Eigen::MatrixXd with(count, static_cast<Eigen::Index>(7 * knots.size()));  // of each part of each knot
  for (Eigen::Index j = 0; j < count; ++j) {
    const ErrorRow& row = rows[static_cast<std::size_t>(j)];
    const auto covariance = covariancesWith(row);
    for (Eigen::Index i = j; i < count; ++i) matrix(i, j) = measured(rows[static_cast<std::size_t>(i)], covariance);
    matrix(j, j) += row.sigma * row.sigma;
    for (std::size_t i = 0; i < knots.size(); ++i)
      with.row(j).segment<7>(static_cast<Eigen::Index>(7 * i)) = covariance[knots[i]].transpose();
    progress.advance(0.5 * static_cast<double>(j) / static_cast<double>(count));
    TRY(progress.check());
  }
  factorise(matrix);
  for (std::size_t i = 0; i < knots.size() && count > 0; ++i) {
    for (int k = 0; k < 7; ++k) {
      Eigen::VectorXd column = with.col(static_cast<Eigen::Index>(7 * i) + k);
      solveLower(matrix, column);
      double taken = 0;
      for (const double part : column) taken += part * part;
      result[i][k] = std::max(0.0, result[i][k] - taken);
    }
    progress.advance(0.5 + 0.5 * static_cast<double>(i) / static_cast<double>(knots.size()));
    TRY(progress.check());
  }
  return result;
}

}  // namespace standpoint
