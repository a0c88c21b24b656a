// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

#include "core/progress.h"
#include "core/result.h"
#include "optimizer/simplify/engines/engine.h"
#include "optimizer/surface/deviation.h"

namespace standpoint {

// What one shape is to become.
struct FormRequest {
  const Shape& shape;
  const TriangleTree& tree;          // of the shape
  const DeviationMeter& meter;       // of the shape
  const std::vector<Collapse>& log;  // ours
  std::size_t triangles = 0;
  double cap_m = 0;        // on the maximum deviation
  std::uint32_t seed = 0;  // of the points that fitting looks at
};

// A form that an engine made, measured.
struct EngineForm {
  std::vector<Collapse> steps;
  Shape form;
  Deviation deviation;
  std::string_view engine;  // its id
};

// Errors: as of the engine; unusable where the form is over the cap.
Result<EngineForm> formBy(const Engine& engine, const FormRequest& request, const Progress& progress);

// Of all engines' forms, and what fitting makes of the nearest of them, the one of least mean deviation among those
// whose maximum is hardly more than the least of all engines. The other engines start from what our log leaves where a
// shape has more than 400 000 triangles; that limit is on work and not on time, so that the same is chosen on any
// machine. Not thorough: only CGAL's Lindstrom and Turk beside ours, one form fitted. `own` is ours, with the shape's
// vertices.
EngineForm bestForm(const FormRequest& request, EngineForm own, bool thorough, const Progress& progress);

// Whether ours is known to lose: large shapes of many parts, of which few triangles are left to each.
bool isOwnKnownToLose(const Shape& shape, std::size_t triangles);

}  // namespace standpoint
