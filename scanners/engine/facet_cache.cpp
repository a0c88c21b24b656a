// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/facet_cache.h"

#include <bit>
#include <cmath>

namespace standpoint {

namespace {

// Planes that are the same to 3 arcsec and 0.1 mm, as coplanar facets are but for the rounding of their corners. Near
// the limits of the steps they can be told apart all the same. Two others have the same number once in four thousand
// million.
std::uint32_t planeNumber(const Facet& facet) {
  std::uint64_t hash = 0;
  const auto add = [&hash](double steps) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(std::nearbyint(steps) + 0.0)) *
           0x9E3779B97F4A7C15ULL;  // one zero, not two
    hash ^= hash >> 32U;
  };
  for (int k = 0; k < 3; ++k) add(0x1p16 * facet.normal[k]);
  add(0x1p13 * facet.offset);
  return static_cast<std::uint32_t>(hash) | 1U;
}

}  // namespace

FacetCache::FacetCache(const ScanPlan& plan) : plan_(plan), entries_(std::size_t{1} << kBits) {}

std::int32_t FacetCache::materialAt(const Facet& facet) const {
  if (plan_.assignment.faces.empty()) return materialOf(plan_.assignment, facet.product, facet.surface);
  return plan_.triangles.materialOf(facet.instance, facet.triangle);
}

void FacetCache::lookUp(std::uint64_t number, MetFacet& entry) const {
  entry.number = number;
  entry.facet = plan_.scene.facet(number);
  const std::int32_t material = materialAt(entry.facet);
  const bool assigned = material >= 0;
  entry.material = assigned ? static_cast<std::uint32_t>(material) : plan_.unassignedLabel();
  entry.optics = &plan_.optics[assigned ? entry.material : entry.material + entry.facet.surface];
  entry.painted = assigned && plan_.paint && plan_.paint->paints(entry.facet);
  // A retroreflector's gain is no figure of the lanes (signal_lanes.h).
  entry.plain =
      !entry.painted && !plan_.passes(*entry.optics) && !plan_.mirrors(*entry.optics) && entry.optics->retro_gain == 0;
  entry.plane = planeNumber(entry.facet);
}

}  // namespace standpoint
