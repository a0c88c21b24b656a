// SPDX-License-Identifier: GPL-3.0-or-later
// IfcOpenCrossProfileDef: straight pieces, each by its width and slope (IFC 4.3, 8.15.3.24).
#include <cmath>
#include <numbers>

#include "importers/ifc/shapes/curve.h"
#include "importers/ifc/shapes/placement.h"
#include "importers/ifc/shapes/profile.h"

namespace standpoint::ifc {

Result<Path> openCrossProfile(const Entity& entity, Scope& scope) {
  const bool horizontal = entity[2].isTrue();
  Path path{{cartesianPoint(entity.ref(6), scope)}, false};
  const Value widths = entity[3], slopes = entity[4];
  auto slope = slopes.begin();
  for (const Value width : widths) {
    if (!(slope != slopes.end())) return fail(entity, "there are fewer slopes than widths");
    const double angle = (*slope).number(0) * scope.model.units.angle_rad, run = scope.metres(width.number(0));
    ++slope;
    if (horizontal && std::abs(std::cos(angle)) < 1e-6)
      return fail(entity, "a segment is vertical, but its width is measured horizontally");
    const double along = horizontal ? run / std::abs(std::cos(angle)) : run;
    path.points.push_back(path.points.back() + along * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0));
    if (!scope.spend(1)) return fail(entity, "too many points");
  }
  if (path.points.size() < 2) return fail(entity, "the profile has no length");
  return path;
}

}  // namespace standpoint::ifc
