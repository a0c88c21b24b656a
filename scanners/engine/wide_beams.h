// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "scanners/engine/facet_cache.h"
#include "scanners/engine/footprint.h"

namespace standpoint {

// A beam whose rays are traced, besides its axis.
struct WideBeam {
  std::uint32_t row = 0;
  NearestHit axis;
  Beam beam;
  SubRay rays[kReferenceSubRays];
  NearestHit hits[kReferenceSubRays];
};

// Beams that may meet several surfaces. Their rays are traced sixteen at a time.
class WideBeams {
 public:
  WideBeams(const ScanPlan& plan, FacetCache& facets) : plan_(plan), facets_(facets) {}
  void clear() { count_ = 0; }
  void add(std::uint32_t column, std::uint32_t row, const NearestHit& axis, const Beam& beam);
  // Traces them all and keeps those that meet something else than their axis does: for reference another facet is, too.
  void trace();
  std::size_t size() const { return count_; }
  const WideBeam& operator[](std::size_t i) const { return beams_[i]; }
  int raysEach() const { return plan_.forReference() ? kReferenceSubRays : kSubRays; }

 private:
  void traceRays(WideBeam& beam);
  bool severalSurfaces(const WideBeam& beam);

  const ScanPlan& plan_;
  FacetCache& facets_;
  std::vector<WideBeam> beams_;  // the first `count_`; the others are kept for their memory
  std::size_t count_ = 0;
};

}  // namespace standpoint
