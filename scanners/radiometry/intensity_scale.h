// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace standpoint {

// Returns of one surface at about one range and incidence.
struct IntensityCell {
  double measured = 0;      // median of what the vendor stored
  double expected_db = 0;   // 10 lg of the received power, but for a constant of the group
  std::uint32_t group = 0;  // cells of a group share that constant
  double weight = 1;
};

// What a vendor's figure says of the received power: a rising, piecewise linear curve over the figure or its logarithm,
// up to a constant that nobody knows.
struct IntensityScale {
  bool logarithmic = false;          // the curve is over lg(measured)
  bool range_compensated = false;    // the figure does not fall with the range
  std::vector<double> measured, db;  // knots, rising
  double explained = 0;              // share of the expected spread within groups that the figures follow, 0..1
  double scatter_db = 0;             // 1.4826 medians of the cells' residuals
  double spread_db = 0;              // the same of the expectations within groups: what there was to learn from
  Eigen::MatrixXd step_covariance;   // of the knots' rises, dB²

  // Whether the figure lies within the knots, or not far beyond: elsewhere the curve was not learned.
  bool covers(double measured) const;
  double dbAt(double measured) const;
  // Share of each rise that lies below the figure: dbAt is its product with the rises.
  Eigen::VectorXd stepsAt(double measured) const;
  // "linear in dB: 0.0143 per dB", "power law: measured ~ x^0.45", "another rising curve"
  std::string describe() const;
};

// Only how the figures change within a group counts, so a group whose constant is wrong (a wall of the wrong material)
// cannot bend the curve. By iterated weights (Huber) and steps that are never negative. `scatter_db` is infinite where
// there is nothing to fit: fewer than 8 cells, or all of one figure.
IntensityScale fitIntensityScale(const std::vector<IntensityCell>& cells, bool logarithmic);

}  // namespace standpoint
