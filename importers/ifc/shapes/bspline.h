// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "importers/ifc/model/step_file.h"

namespace standpoint::ifc {

struct KnotVector {
  int degree = 1;
  std::vector<double> knots;  // with multiplicities written out
  double from() const { return knots[static_cast<std::size_t>(degree)]; }
  double to() const { return knots[knots.size() - 1 - static_cast<std::size_t>(degree)]; }
  std::size_t spanOf(double t) const;
  std::vector<double> breaks() const;  // different knots within [from, to]
};
// From the file's multiplicities and knots; uniform and clamped when those are missing or do not fit. Empty when the
// degree does not fit the number of control points.
KnotVector knotVector(int degree, std::size_t control_points, const Value& multiplicities, const Value& knots);
KnotVector bezierKnots(int degree, std::size_t control_points);

// De Boor on homogeneous control points (x w, y w, z w, w).
Eigen::Vector4d evaluate(const KnotVector& knots, const std::vector<Eigen::Vector4d>& control, double t);

struct SplineSurface {
  KnotVector u, v;
  std::vector<std::vector<Eigen::Vector4d>> control;  // [u][v]
  Eigen::Vector3d at(double s, double t) const;
};

}  // namespace standpoint::ifc
