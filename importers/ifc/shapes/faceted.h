// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>

#include "importers/ifc/shapes/mapping.h"

namespace standpoint::ifc {

// Adds the faces of an IfcConnectedFaceSet (shell), plane polygons as well as faces on curved surfaces.
Result<void> appendShell(geometry::PolyMesh& mesh, const Entity& shell, Scope& scope);

// Turns a shell outward and drops faces that are there twice or without area, and counts what it did. A shell that is
// closed as it stands keeps its slivers: without them it would leak.
void orient(geometry::PolyMesh& shell, bool should_be_closed, Scope& scope);

// What the outlines enclose on a surface; `face` is named where that cannot be done.
using Outlines = std::vector<std::vector<Eigen::Vector3d>>;
Result<void> appendOnSurface(geometry::PolyMesh& mesh, const ParametricSurface& on, const Outlines& outlines,
                             bool turned, const Entity& face, Scope& scope);
// The faces of an advanced shell whose surface is curved (advanced_face.cpp).
Result<void> appendCurvedFace(geometry::PolyMesh& mesh, const Entity& face, Scope& scope);

// The corner points of an IfcPolyLoop or IfcEdgeLoop, along its curves.
Result<std::vector<Eigen::Vector3d>> loopPoints(const Entity& loop, Scope& scope);

// PnIndex of a triangulated or polygonal face set, if it has one.
Value pnIndex(const Entity& face_set);

}  // namespace standpoint::ifc
