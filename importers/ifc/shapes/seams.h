// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/geometry/kernel.h"

namespace standpoint::ifc {

// What cuts by several planes leave behind, mended: points closer than a few micrometres become one; fins without
// thickness, which stay between tools that share an edge, and pairs of faces that cover each other go away; and where
// one piece has a corner on another's edge, the edge gets that corner, too, or a closed body would leak by a rounding
// error.
void mendSeams(geometry::PolyMesh& mesh);

// Moves points that are within micrometres of a plane onto it: a face that nearly lies in the plane of a cut, as bodies
// have that were cut by the same roof before, would otherwise be cut along a line that rounding chooses.
void snapToPlane(geometry::PolyMesh& mesh, const Eigen::Vector3d& normal_unit, double offset_m);

// What is below the plane, after that.
Result<geometry::PolyMesh> clipSnapped(geometry::PolyMesh mesh, const Eigen::Vector3d& normal_unit, double offset_m);

}  // namespace standpoint::ifc
