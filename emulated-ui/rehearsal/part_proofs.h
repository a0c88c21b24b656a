// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>

#include "emulated-ui/device/device.h"
#include "emulated-ui/rehearsal/exercise.h"
#include "project/document.h"

namespace standpoint {

// What the points of all stored setups show of the exercise's parts (ExercisePart), each by its name:
//   part.NAME.area     m², its surface that light gets to
//   part.NAME.seen     share of it that has a point within 5 cm
//   part.NAME.points   that are on it
//   part.NAME.spacing  mm between neighbouring points, were they a grid on what is seen
//   part.NAME.hole     m², the largest patch that is not seen; .hole_x, .hole_y, .hole_z: its middle, m, file frame
// What is measured is told at its true place, whatever the file's pose is.
std::map<std::string, double> readParts(const Exercise& exercise, const Device& device, const Document& document);

// The unit of such a fact, and what it can be; nothing: no part of the exercise has that name, or no such figure.
struct PartFigure {
  const char* unit;
  FactDomain domain;
};
std::optional<PartFigure> partFigure(const std::string& fact, const Exercise& exercise);

}  // namespace standpoint
