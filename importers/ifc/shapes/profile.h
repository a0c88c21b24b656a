// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/ifc/shapes/mapping.h"

namespace standpoint::ifc {

// Outer loops of a profile with its Position applied; several for a composite profile. Grouped by the file that they
// are in.

// profile_parameterised.cpp
Result<Regions> rectangleProfile(const Entity&, Scope&);
Result<Regions> roundedRectangleProfile(const Entity&, Scope&);
Result<Regions> rectangleHollowProfile(const Entity&, Scope&);
Result<Regions> trapeziumProfile(const Entity&, Scope&);
Result<Regions> circleProfile(const Entity&, Scope&);
Result<Regions> circleHollowProfile(const Entity&, Scope&);
Result<Regions> ellipseProfile(const Entity&, Scope&);
Result<Regions> iShapeProfile(const Entity&, Scope&);
Result<Regions> asymmetricIShapeProfile(const Entity&, Scope&);
Result<Regions> lShapeProfile(const Entity&, Scope&);
Result<Regions> tShapeProfile(const Entity&, Scope&);
Result<Regions> uShapeProfile(const Entity&, Scope&);
Result<Regions> cShapeProfile(const Entity&, Scope&);
Result<Regions> zShapeProfile(const Entity&, Scope&);
Result<Regions> craneRailAProfile(const Entity&, Scope&);
Result<Regions> craneRailFProfile(const Entity&, Scope&);

// profile_arbitrary.cpp
Result<Regions> arbitraryClosedProfile(const Entity&, Scope&);
Result<Regions> centreLineProfile(const Entity&, Scope&);
Result<Regions> compositeProfile(const Entity&, Scope&);
Result<Regions> derivedProfile(const Entity&, Scope&);
// The curve of an open profile (arbitrary, open cross), or the outline of an area where that is what is given.
Result<Path> profileCurve(const Entity& profile, Scope& scope);

// profile_open_cross.cpp
Result<Path> openCrossProfile(const Entity&, Scope&);

}  // namespace standpoint::ifc
