// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Geometry>

#include "importers/ifc/shapes/mapping.h"

namespace standpoint::ifc {

// Points closer than this are one point of a curve.
constexpr double kSamePoint_m = 1e-7;

void appendPoint(Path& path, const Eigen::Vector3d& point);  // unless it repeats the last one
void close(Path& path);  // sets `closed` when the ends meet, and drops the repeated end
void reverse(Path& path);
geometry::Loop2 loop2(const Path& path);  // x and y
double length(const Path& path);
// The part from `from_m` to `to_m` measured along the curve.
Path portion(const Path& path, double from_m, double to_m);

// A circle or ellipse in its frame.
struct Conic {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  double a = 0, b = 0;  // half axes in metres
  Eigen::Vector3d at(double angle) const {
    return frame * Eigen::Vector3d(a * std::cos(angle), b * std::sin(angle), 0);
  }
  Eigen::Vector3d tangent(double angle) const {
    return frame.linear() * Eigen::Vector3d(-a * std::sin(angle), b * std::cos(angle), 0).normalized();
  }
  double angleOf(const Eigen::Vector3d& point) const;
};
Result<Conic> conic(const Entity& entity, Scope& scope);
Path arc(const Conic& conic, double from, double sweep, const Scope& scope);
Path arcThrough(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Scope& scope);

// Samples `at` on [from, to] until chords keep the tolerance; `pieces` is how many to start from.
Path sample(const std::function<Eigen::Vector3d(double)>& at, double from, double to, int pieces, const Scope& scope);

std::vector<Eigen::Vector3d> pointList(const Entity& list, Scope& scope);  // IfcCartesianPointList2D, 3D

// A directrix cut to [start, end] in its own parameter; the whole where neither is given.
Result<Path> trimmedDirectrix(const Entity& directrix, const Value& start, const Value& end, Scope& scope);

// The rows of the table, grouped by the file that they are in.
// curve.cpp
Result<Path> polyline(const Entity&, Scope&);
Result<Path> line(const Entity&, Scope&);
Result<Path> indexedPolyCurve(const Entity&, Scope&);

// curve_composite.cpp
Result<Path> compositeCurve(const Entity&, Scope&);

// curve_conic.cpp
Result<Path> conicCurve(const Entity&, Scope&);
Result<Path> trimmedCurve(const Entity&, Scope&);

// bspline.cpp
Result<Path> bSplineCurve(const Entity&, Scope&);

// curve_offset.cpp
Result<Path> offsetCurve(const Entity&, Scope&);

// curve_on_surface.cpp
Result<Path> surfaceCurve(const Entity&, Scope&);
Result<Path> pcurve(const Entity&, Scope&);
Entity spatialCurve(const Entity& surface_curve);  // its curve in space, else its curve on a surface

// alignment_curve.cpp, alignment_cant.cpp
Result<Path> alignmentPlan(const Entity&, Scope&);  // a composite curve of IfcCurveSegments
Result<Path> gradientCurve(const Entity&, Scope&);
Result<Path> segmentedReferenceCurve(const Entity&, Scope&);

}  // namespace standpoint::ifc
