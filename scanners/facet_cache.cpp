// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/facet_cache.h"

namespace standpoint {

namespace {

constexpr unsigned kCacheBits = 11;

std::size_t slot(std::uint64_t facet) { return (facet * 0x9E3779B97F4A7C15ULL) >> (64U - kCacheBits); }

}  // namespace

FacetCache::FacetCache(const ScanPlan& plan) : plan_(plan), entries_(std::size_t{1} << kCacheBits) {}

std::int32_t FacetCache::materialAt(const Facet& facet) const {
  if (plan_.assignment.faces.empty()) return materialOf(plan_.assignment, facet.product, facet.surface);
  return plan_.triangles.materialOf(facet.instance, facet.triangle);
}

const MetFacet& FacetCache::of(std::uint64_t number) {
  MetFacet& entry = entries_[slot(number)];
  if (entry.number == number) return entry;
  entry.number = number;
  entry.facet = plan_.scene.facet(number);
  const std::int32_t material = materialAt(entry.facet);
  const bool assigned = material >= 0;
  entry.material = assigned ? static_cast<std::uint32_t>(material) : plan_.unassignedLabel();
  entry.optics = &plan_.optics[assigned ? entry.material : entry.material + entry.facet.surface];
  // A retroreflector's gain is no figure of the lanes (signal_lanes.h).
  entry.plain = !plan_.passes(*entry.optics) && !plan_.mirrors(*entry.optics) && entry.optics->retro_gain == 0;
  return entry;
}

}  // namespace standpoint
