// SPDX-License-Identifier: GPL-3.0-or-later
#include <utility>

#include "optimizer/simplify/engines/engine.h"

namespace standpoint {

namespace {

constexpr std::size_t kRefineAt = 6;  // times the triangles that are left in the end

std::size_t trianglesAfter(const Shape& shape, const std::vector<Collapse>& log) {
  auto left = shape.triangles.size();
  for (const auto& step : log) left -= step.triangles;
  return left;
}

}  // namespace

Result<std::vector<Collapse>> simplifyByOwn(const Shape& shape, const EngineTarget& target, const Progress& progress) {
  CollapseOptions options;
  options.max_deviation_m = target.max_deviation_m;
  options.floor = target.triangles;
  auto log = recordCollapses(shape, options, progress);
  TRY(progress.check());
  if (trianglesAfter(shape, log) > target.triangles)
    return failure(ErrorKind::unusable, "the allowed deviation ends the simplification before the target");
  static constexpr Engine kRefining{
      "", "", "", "",
      [](const Shape& form, const EngineTarget& end, const Progress& p) -> Result<std::vector<Collapse>> {
        return refined(form, end.triangles, p, end.stays);
      }};
  TRY_ASSIGN(auto finer, simplifyFurther(kRefining, shape, log, stepsDownTo(shape, log, kRefineAt * target.triangles),
                                         target, progress));
  TRY(progress.check());
  const auto left = trianglesAfter(shape, finer);
  return left > 0 && left <= target.triangles && 100 * left >= 99 * target.triangles ? std::move(finer)
                                                                                     : std::move(log);
}

}  // namespace standpoint
