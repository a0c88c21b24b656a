// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "importers/geometry/arrangement.h"
#include "importers/geometry/kernel.h"
#include "importers/geometry/polygon.h"

namespace standpoint::geometry {
namespace {

using Inside = std::function<bool(std::span<const int>)>;

struct Soup {
  std::vector<Eigen::Vector2d> points;
  std::vector<Segment> segments;

  void add(const Loop2& loop, std::uint32_t layer) {
    const auto base = static_cast<std::uint32_t>(points.size()), n = static_cast<std::uint32_t>(loop.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      points.push_back(loop[i]);
      segments.push_back({base + i, base + (i + 1) % n, layer, layer + 1});
    }
  }
  void add(std::span<const Region2> regions, std::uint32_t layer) {
    for (Region2 region : regions) {
      normalise(region);
      add(region.outer, layer);
      for (const Loop2& hole : region.holes) add(hole, layer);
    }
  }
};

// Corners only: what an edge was cut by and is no longer there leaves points on straight lines.
Loop2 corners(const Arrangement& arrangement, const BoundaryLoop& loop) {
  Loop2 kept;
  const std::size_t n = loop.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d& before = arrangement.points[loop.points[(i + n - 1) % n]];
    const Eigen::Vector2d& here = arrangement.points[loop.points[i]];
    const Eigen::Vector2d& after = arrangement.points[loop.points[(i + 1) % n]];
    if (std::abs(cross(before, here, after)) > 1e-9 * (after - before).norm()) kept.push_back(here);
  }
  return kept;
}

Result<std::vector<Region2>> combine(const Soup& soup, const Inside& inside) {
  const auto arrangement = arrange(soup.points, soup.segments, 2, kSnap_m);
  if (!arrangement) return failure(ErrorKind::unusable, "polygon Boolean: too many outlines, or no convergence");
  const auto loops = boundary(*arrangement, inside);
  if (!loops) return failure(ErrorKind::unusable, "polygon Boolean: the outline of the result is open");
  std::vector<Loop2> flat;
  for (const BoundaryLoop& loop : *loops) {
    Loop2 points = corners(*arrangement, loop);
    if (points.size() >= 3) flat.push_back(std::move(points));
  }
  std::vector<Region2> result;
  const Nesting nesting = nest(flat);
  for (std::size_t o = 0; o < nesting.outers.size(); ++o) {
    Region2& region = result.emplace_back(Region2{flat[nesting.outers[o]], {}});
    for (std::size_t h : nesting.holes[o]) region.holes.push_back(flat[h]);
  }
  return result;
}

Result<std::vector<Region2>> combine(std::span<const Region2> a, std::span<const Region2> b, const Inside& inside) {
  Soup soup;
  soup.add(a, 0);
  soup.add(b, 1);
  return combine(soup, inside);
}

}  // namespace

Result<std::vector<Region2>> difference(std::span<const Region2> a, std::span<const Region2> b) {
  return combine(a, b, [](std::span<const int> w) { return w[0] > 0 && w[1] <= 0; });
}

Result<std::vector<Region2>> intersection(std::span<const Region2> a, std::span<const Region2> b) {
  return combine(a, b, [](std::span<const int> w) { return w[0] > 0 && w[1] > 0; });
}

Result<std::vector<Region2>> unite(std::span<const Region2> a) {
  return combine(a, {}, [](std::span<const int> w) { return w[0] > 0; });
}

}  // namespace standpoint::geometry
