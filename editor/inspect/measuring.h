// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "editor/inspect/snapping.h"
#include "survey/measuring/measurement.h"

namespace standpoint {

// A place that can be measured: a point of a cloud, or of the model.
struct MeasurablePlace {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // local frame
  std::string cloud;                     // what lists call the one that it is a point of; "": it is of the model
  std::vector<Eigen::Vector3d> normals;  // unit: of the faces that it lies on, where they are known
  Snap snap = Snap::none;                // what it was moved to
  bool square = false;                   // moved to the foot of the perpendicular from the first point
};

// What the tool for measuring has so far.
struct Measuring {
  MeasurementKind kind = MeasurementKind::distance;
  std::vector<Eigen::Vector3d> points;  // clicked, local frame
  std::string problem;                  // why they could not be measured
  std::vector<Eigen::Vector3d> faces;   // unit normals: of those that the first point lies on
  bool square = false;                  // the last point is square to one of them
  bool operator==(const Measuring&) const = default;
};

// As it is with this place clicked.
Measuring with(Measuring measuring, const MeasurablePlace& place);
// The second end of a distance on a face that is parallel to one of the first: moved to where the distance between both
// is square to them. Any other place, and one that was snapped to an edge or a corner, stays.
MeasurablePlace squared(const Measuring& measuring, MeasurablePlace place);
// Along this normal of the only face of the first point lies what is opposite; nothing where there is none, or several.
std::optional<Eigen::Vector3d> towardsOpposite(const Measuring& measuring);

bool isFull(const Measuring& measuring);         // no further point can be added
bool isEnough(const Measuring& measuring);       // it can be measured, though more points could be added
std::string hintOf(const Measuring& measuring);  // what to do next
// As it would be with `next`, where that can be measured.
std::optional<Measurement> measuredSoFar(const Measuring& measuring, const std::optional<Eigen::Vector3d>& next);

// Where the result of a measurement is written in the view.
Eigen::Vector3d labelPlace(const Measurement& measurement);

}  // namespace standpoint
