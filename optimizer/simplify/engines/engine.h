// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "core/progress.h"
#include "core/result.h"
#include "optimizer/simplify/collapses/collapse.h"
#include "optimizer/surface/shape.h"

namespace standpoint {

// Beside the engines' ids, as options spell them (optimizer.h).
inline constexpr std::string_view kAutoEngine = "auto", kBestEngine = "best";

struct EngineTarget {
  std::size_t triangles = 0;                                         // that are left in the end, or one or two less
  double max_deviation_m = std::numeric_limits<double>::infinity();  // of the shape; a hint: what counts is measured
  const std::vector<bool>* stays =
      nullptr;  // vertices of the shape that no step may move or remove; ours heeds it where it refines
};

// An algorithm that simplifies one shape. What it gives is a log of collapses of that shape, so that levels, replay,
// attribute transfer and measurement are the same for all engines. Borders between surfaces, seams of textures and
// edges of three triangles are held. Nothing depends on the number of threads. Errors: unusable with the reason where
// the engine cannot simplify this shape, cancelled.
struct Engine {
  std::string_view id;      // as options spell it
  const char* title;        // as screens spell it
  const char* description;  // as reports spell it
  const char* help;         // what it is good for
  Result<std::vector<Collapse>> (*simplify)(const Shape& shape, const EngineTarget& target, const Progress& progress);
};

std::span<const Engine> engines();  // the first is ours, which refuses nothing

// The log of a simplification that goes on from the form that `first` steps of `log` lead to.
Result<std::vector<Collapse>> simplifyFurther(const Engine& engine, const Shape& shape,
                                              const std::vector<Collapse>& log, std::size_t first,
                                              const EngineTarget& target, const Progress& progress);

// How many steps of a log lead to no more than so many triangles.
std::size_t stepsDownTo(const Shape& shape, const std::vector<Collapse>& log, std::size_t triangles);

Result<std::vector<Collapse>> simplifyByOwn(const Shape&, const EngineTarget&, const Progress&);
Result<std::vector<Collapse>> simplifyByLindstromTurk(const Shape&, const EngineTarget&, const Progress&);
Result<std::vector<Collapse>> simplifyByGarlandHeckbert(const Shape&, const EngineTarget&, const Progress&);
Result<std::vector<Collapse>> simplifyByOpenMesh(const Shape&, const EngineTarget&, const Progress&);

}  // namespace standpoint
