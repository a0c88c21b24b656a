// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/facet_cache.h"

#include <cmath>

#include "scanners/noise/surface_texture.h"

namespace standpoint {

FacetCache::FacetCache(const ScanPlan& plan, TimedScene& scene)
    : plan_(plan), scene_(scene), entries_(std::size_t{1} << kBits) {}

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
  if (assigned && plan_.surfaces_differ)
    entry.factor =
        surfaceFactor(plan_.surfaceKey(entry.facet.product, entry.facet.surface), entry.optics->surface_spread);
  else
    entry.factor = 1;
  // A retroreflector's gain is no figure of the lanes (signal_lanes.h).
  entry.plain =
      !entry.painted && !plan_.passes(*entry.optics) && !plan_.mirrors(*entry.optics) && entry.optics->retro_gain == 0;
}

}  // namespace standpoint
