// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/ifc/shapes/mapping.h"
#include "importers/ifc/shapes/placement.h"
#include "importers/ifc/shapes/profile.h"

namespace standpoint::ifc {

// All in surface.cpp.
Result<SurfacePtr> planeSurface(const Entity&, Scope&);
Result<SurfacePtr> basisSurface(const Entity&, Scope&);  // of a trimmed or bounded one: a face brings its own bounds
Result<SurfacePtr> cylindricalSurface(const Entity&, Scope&);
Result<SurfacePtr> sphericalSurface(const Entity&, Scope&);
Result<SurfacePtr> toroidalSurface(const Entity&, Scope&);
Result<SurfacePtr> bSplineSurface(const Entity&, Scope&);
Result<SurfacePtr> surfaceOfLinearExtrusion(const Entity&, Scope&);
Result<SurfacePtr> surfaceOfRevolution(const Entity&, Scope&);
// Of an IfcSurfaceOfRevolution, in the frame of its position.
Axis axisOfRevolution(const Entity& entity, const Eigen::Isometry3d& position, Scope& scope);

}  // namespace standpoint::ifc
