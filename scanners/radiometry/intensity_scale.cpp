// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/radiometry/intensity_scale.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include <Eigen/Core>

#include "core/decompositions.h"

namespace standpoint {

namespace {

constexpr std::size_t kKnots = 12, kFewestCells = 8;
constexpr int kReweightings = 15, kSweeps = 400;
constexpr double kHuber = 1.345, kStiffness = 1e-3;
constexpr double kBeyond_db = 1, kBeyondSteps = 10, kClearlyLess = 0.5;
constexpr double kStraight_db = 0.25;  // to which the curve is called a straight line

// What the curve is taken over.
double axis(const IntensityScale& scale, double measured) {
  return scale.logarithmic ? std::log10(std::max(measured, 1e-12)) : measured;
}

double medianAbsolute(std::vector<double> values) {
  if (values.empty()) return 0;
  for (auto& v : values) v = std::abs(v);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Knots so that each interval has the same weight of cells.
std::vector<double> knotsOf(const std::vector<IntensityCell>& cells) {
  std::vector<double> sorted;
  for (const auto& cell : cells) sorted.push_back(cell.measured);
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> knots;
  for (std::size_t k = 0; k < kKnots; ++k) {
    const double at = sorted[k * (sorted.size() - 1) / (kKnots - 1)];
    if (knots.empty() || at > knots.back()) knots.push_back(at);
  }
  return knots;
}

struct Problem {
  Eigen::MatrixXd rows;  // cells × steps
  Eigen::VectorXd expected, weight;
  std::vector<std::uint32_t> group;
  std::uint32_t groups = 0;
};

// Takes each group's weighted mean out of rows and expectations.
void centre(const Problem& problem, const Eigen::VectorXd& weight, Eigen::MatrixXd& rows, Eigen::VectorXd& expected) {
  Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(problem.groups, rows.cols() + 1);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(problem.groups);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const auto g = problem.group[static_cast<std::size_t>(i)];
    mean.row(g).head(rows.cols()) += weight[i] * problem.rows.row(i);
    mean(g, rows.cols()) += weight[i] * problem.expected[i];
    sum[g] += weight[i];
  }
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const auto g = problem.group[static_cast<std::size_t>(i)];
    rows.row(i) = problem.rows.row(i) - mean.row(g).head(rows.cols()) / sum[g];
    expected[i] = problem.expected[i] - mean(g, rows.cols()) / sum[g];
  }
}

// min ½ uᵀ A u − bᵀ u with u ≥ 0, by one coordinate after the other.
Eigen::VectorXd nonNegative(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(b.size());
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (Eigen::Index k = 0; k < u.size(); ++k) u[k] = std::max(0.0, u[k] + (b[k] - a.row(k).dot(u)) / a(k, k));
  return u;
}

// Neighbouring slopes are alike where the cells do not say otherwise. Slopes, not steps: the outermost knots, which few
// cells hold, stand far from the next.
Eigen::MatrixXd stiffness(const IntensityScale& scale, double strength) {
  const auto steps = static_cast<Eigen::Index>(scale.measured.size()) - 1;
  const auto at = [&](Eigen::Index k) { return axis(scale, scale.measured[static_cast<std::size_t>(k)]); };
  const double mean_width = (at(steps) - at(0)) / static_cast<double>(steps);
  Eigen::VectorXd per_width(steps);
  for (Eigen::Index k = 0; k < steps; ++k) per_width[k] = mean_width / (at(k + 1) - at(k));
  Eigen::MatrixXd s = Eigen::MatrixXd::Identity(steps, steps) * (strength * 1e-6);
  for (Eigen::Index k = 0; k + 1 < steps; ++k) {
    const double here = per_width[k], next = per_width[k + 1];
    s(k, k) += strength * here * here, s(k + 1, k + 1) += strength * next * next;
    s(k, k + 1) -= strength * here * next, s(k + 1, k) -= strength * here * next;
  }
  return s;
}

Problem problemOf(const std::vector<IntensityCell>& cells, const IntensityScale& scale) {
  Problem p;
  const auto n = static_cast<Eigen::Index>(cells.size());
  p.rows.resize(n, static_cast<Eigen::Index>(scale.measured.size()) - 1);
  p.expected.resize(n), p.weight.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& cell = cells[static_cast<std::size_t>(i)];
    p.rows.row(i) = scale.stepsAt(cell.measured).transpose();
    p.expected[i] = cell.expected_db;
    p.weight[i] = cell.weight;
    p.group.push_back(cell.group);
    p.groups = std::max(p.groups, cell.group + 1);
  }
  return p;
}

// Root mean square of what a straight line leaves of the points, and its slope.
double offLine(const std::vector<double>& x, const std::vector<double>& y, double& slope) {
  const auto n = static_cast<double>(x.size());
  double sx = 0, sy = 0, sxx = 0, syy = 0, sxy = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    sx += x[i], sy += y[i], sxx += x[i] * x[i], syy += y[i] * y[i], sxy += x[i] * y[i];
  const double xx = sxx - sx * sx / n, yy = syy - sy * sy / n, xy = sxy - sx * sy / n;
  slope = xx > 0 ? xy / xx : 0;
  return std::sqrt(std::max(0.0, yy - slope * xy) / n);
}

}  // namespace

Eigen::VectorXd IntensityScale::stepsAt(double figure) const {
  const auto steps = static_cast<Eigen::Index>(measured.size()) - 1;
  Eigen::VectorXd fraction(steps);
  for (Eigen::Index k = 0; k < steps; ++k) {
    const double from = axis(*this, measured[static_cast<std::size_t>(k)]);
    const double to = axis(*this, measured[static_cast<std::size_t>(k) + 1]);
    // The first and the last go on beyond their knots, but not far: nothing was learned there.
    fraction[k] = std::clamp((axis(*this, figure) - from) / (to - from), k == 0 ? -kBeyondSteps : 0.0,
                             k + 1 == steps ? 1 + kBeyondSteps : 1.0);
  }
  return fraction;
}

bool IntensityScale::covers(double figure) const {
  const double at = dbAt(figure);
  return at >= db.front() - kBeyond_db && at <= db.back() + kBeyond_db;
}

double IntensityScale::dbAt(double figure) const {
  const auto fraction = stepsAt(figure);
  double result = db.front();
  for (Eigen::Index k = 0; k < fraction.size(); ++k)
    result += fraction[k] * (db[static_cast<std::size_t>(k) + 1] - db[static_cast<std::size_t>(k)]);
  return result;
}

std::string IntensityScale::describe() const {
  std::vector<double> plain, lg, y;  // without the outermost knots, which few cells hold
  for (std::size_t k = 1; k + 1 < measured.size(); ++k) {
    plain.push_back(measured[k]);
    lg.push_back(std::log10(std::max(measured[k], 1e-12)));
    y.push_back(db[k]);
  }
  double slope = 0, lg_slope = 0;
  const double off = offLine(plain, y, slope), lg_off = measured.front() > 0 ? offLine(lg, y, lg_slope) : off;
  char text[96];
  if (std::min(off, lg_off) > kStraight_db || !(slope > 0)) return "another rising curve";
  if (lg_off < kClearlyLess * off)
    std::snprintf(text, sizeof text, "power law: measured ~ power^%.2f", 10 / lg_slope);
  else
    std::snprintf(text, sizeof text, "linear in dB: %.4g per dB", 1 / slope);
  return text;
}

IntensityScale fitIntensityScale(const std::vector<IntensityCell>& cells, bool logarithmic) {
  IntensityScale scale;
  scale.logarithmic = logarithmic;
  scale.scatter_db = std::numeric_limits<double>::infinity();
  if (cells.size() < kFewestCells) return scale;
  scale.measured = knotsOf(cells);
  if (scale.measured.size() < 3) return scale;
  const Problem problem = problemOf(cells, scale);
  Eigen::MatrixXd rows = problem.rows;
  Eigen::VectorXd expected = problem.expected, weight = problem.weight, steps, residual;
  double scatter = 0;
  for (int round = 0; round < kReweightings; ++round) {
    centre(problem, weight, rows, expected);
    if (round == 0) scale.spread_db = 1.4826 * medianAbsolute({expected.data(), expected.data() + expected.size()});
    Eigen::MatrixXd a = rows.transpose() * weight.asDiagonal() * rows;
    a += stiffness(scale, kStiffness * std::max(1e-12, a.trace() / static_cast<double>(a.rows())));
    steps = nonNegative(a, rows.transpose() * weight.asDiagonal() * expected);
    residual = expected - rows * steps;
    scatter = 1.4826 * medianAbsolute({residual.data(), residual.data() + residual.size()});
    scale.step_covariance = inverseOfNormal(a) * std::max(1e-6, scatter * scatter) * problem.weight.mean();
    for (Eigen::Index i = 0; i < weight.size(); ++i)
      weight[i] =
          problem.weight[i] * std::min(1.0, kHuber * std::max(scatter, 1e-3) / std::max(1e-12, std::abs(residual[i])));
  }
  scale.scatter_db = scatter;
  // By all cells, outliers too, and for what is left free: a dozen steps follow a few cells of any noise.
  centre(problem, problem.weight, rows, expected);
  residual = expected - rows * steps;
  std::vector<bool> has_cells(problem.groups, false);
  for (const auto g : problem.group) has_cells[g] = true;
  const double free = static_cast<double>(problem.group.size()) -
                      static_cast<double>(std::count(has_cells.begin(), has_cells.end(), true));
  const double left =
      problem.weight.dot(residual.cwiseAbs2()) / std::max(1e-9, free - static_cast<double>(steps.size()));
  const double all = problem.weight.dot(expected.cwiseAbs2()) / std::max(1e-9, free);
  scale.explained = free > static_cast<double>(steps.size()) && all > 0 ? std::clamp(1 - left / all, 0.0, 1.0) : 0;
  scale.db = {0};
  for (Eigen::Index k = 0; k < steps.size(); ++k) scale.db.push_back(scale.db.back() + steps[k]);
  return scale;
}

}  // namespace standpoint
