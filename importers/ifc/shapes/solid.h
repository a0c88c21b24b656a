// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Representation items with a volume or a surface. Each returns its faces in metres, in the frame of the
// representation. Grouped by the file that they are in.

#include "importers/ifc/shapes/mapping.h"

namespace standpoint::ifc {

// extruded.cpp
Result<geometry::PolyMesh> extrudedAreaSolid(const Entity&, Scope&);
Result<geometry::PolyMesh> extrudedAreaSolidTapered(const Entity&, Scope&);

// revolved.cpp
Result<geometry::PolyMesh> revolvedAreaSolid(const Entity&, Scope&);

// sweep.cpp
Result<geometry::PolyMesh> revolvedAreaSolidTapered(const Entity&, Scope&);
Result<geometry::PolyMesh> sweptDiskSolid(const Entity&, Scope&);
Result<geometry::PolyMesh> curveSweptAreaSolid(const Entity&, Scope&);
Result<geometry::PolyMesh> sectionedSpine(const Entity&, Scope&);

// faceted.cpp
Result<geometry::PolyMesh> faceItem(const Entity&, Scope&);
Result<geometry::PolyMesh> facetedBrep(const Entity&, Scope&);
Result<geometry::PolyMesh> surfaceModel(const Entity&, Scope&);
Result<geometry::PolyMesh> faceSetItem(const Entity&, Scope&);

// bounded_surface.cpp
Result<geometry::PolyMesh> curveBoundedPlane(const Entity&, Scope&);
Result<geometry::PolyMesh> curveBoundedSurface(const Entity&, Scope&);
Result<geometry::PolyMesh> rectangularTrimmedSurface(const Entity&, Scope&);
Result<geometry::PolyMesh> extrudedSurface(const Entity&, Scope&);
Result<geometry::PolyMesh> revolvedSurface(const Entity&, Scope&);
Result<geometry::PolyMesh> geometricSet(const Entity&, Scope&);

// sectioned.cpp
Result<geometry::PolyMesh> sectionedSolidHorizontal(const Entity&, Scope&);
Result<geometry::PolyMesh> sectionedSurface(const Entity&, Scope&);

// tessellated.cpp
Result<geometry::PolyMesh> triangulatedFaceSet(const Entity&, Scope&);
Result<geometry::PolyMesh> polygonalFaceSet(const Entity&, Scope&);

// csg_primitive.cpp
Result<geometry::PolyMesh> block(const Entity&, Scope&);
Result<geometry::PolyMesh> rectangularPyramid(const Entity&, Scope&);
Result<geometry::PolyMesh> rightCircularCone(const Entity&, Scope&);
Result<geometry::PolyMesh> rightCircularCylinder(const Entity&, Scope&);
Result<geometry::PolyMesh> sphereSolid(const Entity&, Scope&);
Result<geometry::PolyMesh> csgSolid(const Entity&, Scope&);

// boolean.cpp
Result<geometry::PolyMesh> booleanResult(const Entity&, Scope&);

}  // namespace standpoint::ifc
