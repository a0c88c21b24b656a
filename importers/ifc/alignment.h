// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>

#include "importers/ifc/mapping.h"

namespace standpoint::ifc {

// A frame on a directrix: x forward, y to the left, z up; of an IfcAxis2PlacementLinear, an IfcPointByDistanceExpression
// or an IfcDistanceExpression.
Result<Eigen::Isometry3d> placeAlong(const Entity& position, const Path& directrix, Scope& scope);

// IfcLinearPlacement relative to its parent: along its curve, else where its CartesianPosition says.
Result<Eigen::Isometry3d> linearPlacement(const Entity& placement, Scope& scope);

}  // namespace standpoint::ifc
