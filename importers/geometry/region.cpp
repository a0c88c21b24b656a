// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "importers/geometry/kernel.h"
#include "importers/geometry/polygon.h"

namespace standpoint::geometry {
namespace {

constexpr double kSamePoint_m = 1e-9;

// True when the way from a over b to c turns back on itself: b is the tip of a spike.
bool isSpike(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const Eigen::Vector2d in = b - a, out = c - b;
  return in.dot(out) < 0 && std::abs(cross(in, out)) <= kSamePoint_m * std::max(in.norm(), out.norm());
}

// Repeated points and spikes out, in one walk with a stack: what a removal uncovers is looked at again.
void clean(Loop2& loop) {
  Loop2 kept;
  const auto redundant = [&](const Eigen::Vector2d& next) {
    const std::size_t n = kept.size();
    return (kept[n - 1] - next).norm() <= kSamePoint_m || (n >= 2 && isSpike(kept[n - 2], kept[n - 1], next));
  };
  for (const Eigen::Vector2d& p : loop) {
    while (!kept.empty() && redundant(p)) kept.pop_back();
    kept.push_back(p);
  }
  std::size_t first = 0;
  for (bool changed = true; changed && kept.size() - first >= 3;) {
    const std::size_t n = kept.size();
    changed = true;
    if ((kept[n - 1] - kept[first]).norm() <= kSamePoint_m || isSpike(kept[n - 2], kept[n - 1], kept[first]))
      kept.pop_back();
    else if (isSpike(kept[n - 1], kept[first], kept[first + 1]))
      ++first;
    else
      changed = false;
  }
  loop.assign(kept.begin() + static_cast<std::ptrdiff_t>(first), kept.end());
  if (loop.size() < 3 || signedArea(loop) == 0) loop.clear();
}

}  // namespace

void normalise(Region2& region) {
  clean(region.outer);
  if (signedArea(region.outer) < 0) std::reverse(region.outer.begin() + 1, region.outer.end());
  for (Loop2& hole : region.holes) {
    clean(hole);
    if (signedArea(hole) > 0) std::reverse(hole.begin() + 1, hole.end());
  }
  std::erase_if(region.holes, [](const Loop2& hole) { return hole.empty(); });
}

double area(const Region2& region) {
  double sum = std::abs(signedArea(region.outer));
  for (const Loop2& hole : region.holes) sum -= std::abs(signedArea(hole));
  return sum;
}

}  // namespace standpoint::geometry
