// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/motion/trajectory_error.h"

namespace standpoint {

// Errors of position (m) and rotation (rad), and of the scale, at one knot.
using ErrorState = Eigen::Matrix<double, 7, 1>;

// A measurement of the errors: the sum of its parts' products with the states there, plus noise.
struct ErrorRow {
  struct Part {
    std::size_t knot = 0;
    ErrorState weight = ErrorState::Zero();
  };
  std::vector<Part> parts;
  double sigma = 0, noise = 0;
};

// The errors of a trajectory as a chain of states: each is a linear function of the one before, plus noise of its own.
// All its arithmetic is in a fixed order.
class ErrorChain {
 public:
  ErrorChain(std::span<const ErrorKnot> knots, const ErrorProfile& profile);

  // One draw, without constraints.
  std::vector<ErrorState> drawn(std::uint64_t seed, std::uint32_t trajectory) const;
  // Corrects a draw so that it is one under the condition that the rows measure nothing but their noise.
  Result<void> hold(std::vector<ErrorState>& states, std::span<const ErrorRow> rows, Progress& progress) const;
  // Of the states at some knots, rising, under the same condition.
  Result<std::vector<ErrorState>> heldVariances(std::span<const std::size_t> knots, std::span<const ErrorRow> rows,
                                                Progress& progress) const;

 private:
  struct Link {  // from a knot to the next
    Eigen::Vector3d way = Eigen::Vector3d::Zero();
    double kept = 1, levers = 1;  // of the position; whether rotation and scale move it
    Eigen::Vector3d turn_kept = Eigen::Vector3d::Ones();
    Eigen::Matrix3d drift = Eigen::Matrix3d::Zero();  // of three normal numbers
    Eigen::Vector3d turn_sigma = Eigen::Vector3d::Zero();
  };
  ErrorState forward(const Link& link, const ErrorState& state) const;
  ErrorState backward(const Link& link, const ErrorState& weight) const;  // its transpose
  // The covariances of all states with what weights add up to; `weights` is used up.
  std::vector<ErrorState> covariances(std::vector<ErrorState>& weights) const;
  std::vector<ErrorState> covariancesWith(const ErrorRow& row) const;
  std::vector<ErrorState> variances(std::span<const std::size_t> knots) const;

  std::vector<Link> links_;
  ErrorState first_sigma_ = ErrorState::Zero();
};

}  // namespace standpoint
