// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "survey/measuring/measurement.h"

namespace standpoint {

// What the tool for measuring has so far.
struct Measuring {
  MeasurementKind kind = MeasurementKind::distance;
  std::vector<Eigen::Vector3d> points;  // clicked, local frame
  std::string problem;                  // why they could not be measured
  bool operator==(const Measuring&) const = default;
};

bool isFull(const Measuring& measuring);         // no further point can be added
bool isEnough(const Measuring& measuring);       // it can be measured, though more points could be added
std::string hintOf(const Measuring& measuring);  // what to do next
// As it would be with `next`, where that can be measured.
std::optional<Measurement> measuredSoFar(const Measuring& measuring, const std::optional<Eigen::Vector3d>& next);

// Where the result of a measurement is written in the view.
Eigen::Vector3d labelPlace(const Measurement& measurement);

}  // namespace standpoint
