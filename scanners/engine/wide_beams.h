// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "scanners/engine/beam_strips.h"
#include "scanners/engine/column_hits.h"
#include "scanners/engine/facet_cache.h"
#include "scanners/engine/footprint.h"

namespace standpoint {

// A beam whose rays are traced, besides its axis.
struct WideBeam {
  std::uint32_t row = 0;
  NearestHit axis;
  double time_s = 0;
  Beam beam;
  float hidden_m = 0;                      // of an edge that the axis' surface hides (edge_map.h)
  std::array<std::uint32_t, 4> numbers{};  // random, its own
  bool strips = false;
  bool several = false;  // surfaces that it meets
  int ray_count = 0;
  SubRay rays[kReferenceSubRays];
  NearestHit hits[kReferenceSubRays];
};

// Beams of one column that may meet several surfaces. Where edges run side by side a ray through each strip between
// them is enough (beam_strips.h); else a pattern of rays is drawn (footprint.h). All are traced sixteen at a time.
class WideBeams {
 public:
  // `seen`: as that of a column.
  WideBeams(const ScanPlan& plan, FacetCache& facets, TimedScene& scene, SeenFaces* seen)
      : plan_(plan), facets_(facets), scene_(scene) {
    packet_.seen = seen;
  }
  void clear() { count_ = 0; }
  // `edges`: null where they are not known.
  void add(const ColumnHits& column, std::uint32_t row, const BeamEdges* edges);
  // Traces them all and finds those that meet something else than their axis does: for reference another facet is, too.
  void trace();
  std::size_t size() const { return count_; }
  const WideBeam& operator[](std::size_t i) const { return beams_[i]; }

 private:
  // Rays on their way.
  struct Sent {
    WideBeam* beam = nullptr;
    int ray = 0;
  };
  void draw(WideBeam& beam);
  void send(WideBeam& beam);
  void flush();
  bool showsMore(const WideBeam& beam);
  bool isRound(std::uint64_t facet) { return facet != kNoFacet && facets_.of(facet).facet.ball != nullptr; }
  bool severalSurfaces(const WideBeam& beam);

  const ScanPlan& plan_;
  FacetCache& facets_;
  TimedScene& scene_;
  std::vector<WideBeam> beams_;  // the first `count_`; the others are kept for their memory
  std::size_t count_ = 0;
  RayPacket packet_{};
  Sent sent_[kPacket];
  int sent_count_ = 0;
};

}  // namespace standpoint
