// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>

#include "importers/ifc/model/model.h"

namespace standpoint::ifc {

// IfcGridPlacement: where two axes of a grid cross, in the frame of the grid.
Result<Eigen::Isometry3d> gridPlacement(const Entity& placement, Scope& scope);

}  // namespace standpoint::ifc
