// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/result.h"

namespace standpoint {

enum class MeasurementKind {
  distance,  // of two points
  height,    // the second point above the first
  angle,     // at the second of three points
  area,      // of a polygon, in its own plane
  plane,     // through three points or more, by total least squares
};

// What somebody has measured in a model or a cloud, by the points that were clicked.
struct Measurement {
  std::string name;
  MeasurementKind kind = MeasurementKind::distance;
  std::vector<Eigen::Vector3d> points;  // local frame, m
  std::string note;
};
bool operator==(const Measurement& a, const Measurement& b);

// One row of the table of kinds.
struct MeasurementKindRow {
  MeasurementKind kind;
  const char* name;          // "distance", as options and files have it
  std::size_t fewest, most;  // points
};
std::span<const MeasurementKindRow> measurementKinds();
const MeasurementKindRow& rowOf(MeasurementKind kind);

// One result: a length in m, an angle in radians, an area in m². Lengths are written in m, and those that are small by
// their nature, as residuals are, in mm.
enum class MeasuredUnit { metre, radian, square_metre, millimetre };
struct MeasuredFigure {
  const char* key;    // "horizontal": of answers
  const char* label;  // "Horizontal": for people
  double value = 0;
  MeasuredUnit unit = MeasuredUnit::metre;
};

// The result that the kind is named after first. Of a measurement that checkMeasurement has passed.
std::vector<MeasuredFigure> figuresOf(const Measurement& measurement);
std::string figureText(const MeasuredFigure& figure);  // "3.250 m", "90.00°", "12.50 m²", "0.4 mm"

// Why it cannot be measured: too few points or too many, points that coincide or lie on a line, edges of a polygon that
// cross.
Result<void> checkMeasurement(const Measurement& measurement);

// A line for each figure and point, to be pasted; `shift_m` leads from the local frame to the model's file frame.
std::string measurementText(const Measurement& measurement, const Eigen::Vector3d& shift_m);

}  // namespace standpoint
