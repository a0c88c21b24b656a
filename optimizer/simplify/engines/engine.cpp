// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/simplify/engines/engine.h"

#include <array>

namespace standpoint {

std::span<const Engine> engines() {
  static constexpr std::array kEngines = {
      Engine{"own", "Standpoint", "own quadrics, refined by Lindstrom and Turk",
             "Quadrics, refined by Lindstrom and Turk's cost", simplifyByOwn},
      Engine{"cgal-lt", "CGAL Lindstrom–Turk", "CGAL, Lindstrom and Turk",
             "Keeps volume and borders; several times slower", simplifyByLindstromTurk},
      Engine{"cgal-gh", "CGAL Garland–Heckbert", "CGAL, Garland and Heckbert",
             "Small maximum, larger mean deviation; several times slower", simplifyByGarlandHeckbert},
      Engine{"openmesh", "OpenMesh", "OpenMesh, quadrics", "Quadrics on half-edges; several times slower",
             simplifyByOpenMesh},
  };
  return kEngines;
}

std::size_t stepsDownTo(const Shape& shape, const std::vector<Collapse>& log, std::size_t triangles) {
  std::size_t steps = 0;
  for (auto left = shape.triangles.size(); steps < log.size() && left > triangles; ++steps)
    left -= log[steps].triangles;
  return steps;
}

Result<std::vector<Collapse>> simplifyFurther(const Engine& engine, const Shape& shape,
                                              const std::vector<Collapse>& log, std::size_t first,
                                              const EngineTarget& target, const Progress& progress) {
  if (first == 0) return engine.simplify(shape, target, progress);
  LogPlayer player(shape, log);
  std::vector<std::uint32_t> names;
  Shape start = withoutUnused(player.at(first), names);
  start.wedges = player.wedges();
  auto from_start = target;
  std::vector<bool> stays;
  if (target.stays != nullptr) {
    for (const auto name : names) stays.push_back((*target.stays)[name]);
    from_start.stays = &stays;
  }
  TRY_ASSIGN(auto steps, engine.simplify(start, from_start, progress));
  std::vector<Collapse> result(log.begin(), log.begin() + static_cast<std::ptrdiff_t>(first));
  for (auto& step : steps) {
    step.kept = names[step.kept];
    step.removed = names[step.removed];
    result.push_back(step);
  }
  return result;
}

}  // namespace standpoint
