// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Geometry>

#include "importers/ifc/shapes/mapping.h"

namespace standpoint::ifc {

struct Station {
  Eigen::Vector3d point, tangent;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  // leans with the cant of the path, across the tangent
};
// By the distance along the plan of the path; beyond its ends straight on.
Station stationAt(const Path& path, double distance_m);
// How long the path itself is up to a distance in its plan.
double lengthTo(const Path& path, double distance_m);
// Where between two distances the path has corners.
std::vector<double> distancesBetween(const Path& path, double from_m, double to_m);

struct Offsets {
  double along = 0, lateral = 0, vertical = 0, longitudinal = 0;  // metres
};
// Of an IfcAxis2PlacementLinear, IfcPointByDistanceExpression or IfcDistanceExpression.
Offsets offsetsAt(const Entity& position, const Scope& scope);

// A frame on a directrix: x forward, y to the left, z up; of an IfcAxis2PlacementLinear, an
// IfcPointByDistanceExpression or an IfcDistanceExpression.
Result<Eigen::Isometry3d> placeAlong(const Entity& position, const Path& directrix, Scope& scope);

// How far the curvature of an IfcCurveSegment has gone from its start to its end, by the share of its length (0 to 1
// for 0 to 1); in step with the length where the curvature does not change.
std::function<double(double)> curvatureFraction(const Entity& segment, Scope& scope);

// IfcLinearPlacement relative to its parent: along its curve, or where its CartesianPosition says, if that is another
// place or there is no such curve.
Result<Eigen::Isometry3d> linearPlacement(const Entity& placement, Scope& scope);

}  // namespace standpoint::ifc
