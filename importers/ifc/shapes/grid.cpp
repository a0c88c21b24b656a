// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/shapes/grid.h"

#include <algorithm>
#include <optional>

#include "importers/ifc/shapes/curve.h"
#include "importers/ifc/shapes/placement.h"

namespace standpoint::ifc {
namespace {

// Where the lines through two segments meet; `outside` is how far beyond the segments that is, in their own lengths.
std::optional<Eigen::Vector2d> meet(const Eigen::Vector2d& a0, const Eigen::Vector2d& a1, const Eigen::Vector2d& b0,
                                    const Eigen::Vector2d& b1, double& outside) {
  const Eigen::Vector2d a = a1 - a0, b = b1 - b0, d = b0 - a0;
  const double cross = a.x() * b.y() - a.y() * b.x();
  if (std::abs(cross) < 1e-12 * a.norm() * b.norm() || cross == 0) return {};
  const double s = (d.x() * b.y() - d.y() * b.x()) / cross, t = (d.x() * a.y() - d.y() * a.x()) / cross;
  outside = std::max({0.0, -s, s - 1, -t, t - 1});
  return Eigen::Vector2d(a0 + a * s);
}

// The axis moved sideways by its offset, to the left of its direction.
geometry::Loop2 moved(const Path& path, double offset) {
  geometry::Loop2 line = loop2(path);
  if (offset == 0 || line.size() < 2) return line;
  geometry::Loop2 result;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Eigen::Vector2d d =
        i + 1 < line.size() ? Eigen::Vector2d(line[i + 1] - line[i]) : Eigen::Vector2d(line[i] - line[i - 1]);
    result.push_back(line[i] + Eigen::Vector2d(-d.y(), d.x()).normalized() * offset);
  }
  return result;
}

Result<geometry::Loop2> axisLine(const Entity& axis, double offset, Scope& scope) {
  TRY_ASSIGN(auto path, curve(axis.ref(1), scope));
  if (axis[2].symbol() == "F") reverse(path);
  return moved(path, offset);
}

Result<Eigen::Vector3d> crossing(const Entity& intersection, Scope& scope) {
  const auto axes = intersection.refs(0);
  if (axes.size() < 2) return fail(intersection, "two grid axes are required");
  double offsets[3] = {0, 0, 0};
  int i = 0;
  const Value list = intersection[1];
  for (const Value v : list)
    if (i < 3) offsets[i++] = scope.metres(v.number(0));
  TRY_ASSIGN(const auto a, axisLine(axes[0], offsets[0], scope));
  TRY_ASSIGN(const auto b, axisLine(axes[1], offsets[1], scope));
  std::optional<Eigen::Vector3d> best;
  double best_outside = 1e300;
  for (std::size_t k = 1; k < a.size(); ++k)
    for (std::size_t l = 1; l < b.size(); ++l) {
      double outside = 0;
      const auto p = meet(a[k - 1], a[k], b[l - 1], b[l], outside);
      if (p && outside < best_outside) best = Eigen::Vector3d(p->x(), p->y(), offsets[2]), best_outside = outside;
    }
  if (!best) return fail(intersection, "the grid axes do not intersect");
  return *best;
}

}  // namespace

Result<Eigen::Isometry3d> gridPlacement(const Entity& placement, Scope& scope) {
  const std::size_t first = placement.ref(0).is("IFCVIRTUALGRIDINTERSECTION") ? 0 : 1;
  const Entity location = placement.ref(first), reference = placement.ref(first + 1);
  if (!location) return fail(placement, "the grid placement has no location");
  TRY_ASSIGN(const auto here, crossing(location, scope));
  Eigen::Vector3d x = Eigen::Vector3d::UnitX();  // the grid's own x where no direction is asked for
  if (reference.is("IFCDIRECTION"))
    x = direction(reference, x, scope);
  else if (reference.is("IFCVIRTUALGRIDINTERSECTION")) {
    TRY_ASSIGN(const auto there, crossing(reference, scope));
    if (const Eigen::Vector3d d = there - here; d.norm() > 1e-9) x = d;
  }
  return frame(here, Eigen::Vector3d::UnitZ(), x);
}

}  // namespace standpoint::ifc
