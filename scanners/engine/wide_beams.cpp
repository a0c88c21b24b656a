// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/wide_beams.h"

#include <algorithm>
#include <utility>

namespace standpoint {

void WideBeams::add(std::uint32_t row, const NearestHit& axis, const Beam& beam) {
  if (count_ == beams_.size()) beams_.emplace_back();
  WideBeam& wide = beams_[count_++];
  wide.row = row;
  wide.axis = axis;
  wide.beam = beam;
}

void WideBeams::trace() {
  traceRays(0, kProbes);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    if (!severalSurfaces(beams_[i])) continue;
    if (kept != i) std::swap(beams_[kept], beams_[i]);
    ++kept;
  }
  count_ = kept;
  traceRays(kProbes, kSubRays);
}

void WideBeams::traceRays(int from, int to) {
  const auto& sub_rays = subRays();
  for (std::size_t i = 0; i < count_; ++i) {
    WideBeam& beam = beams_[i];
    for (int k = from; k < to; ++k) {
      const RayLine& line = beam.lines[k] = lineOf(beam.beam, sub_rays[static_cast<std::size_t>(k)], plan_.instrument);
      packet_.set(waiting_count_, line.origin, line.direction);
      waiting_[waiting_count_++] = &beam.hits[k];
      if (waiting_count_ == kPacket) traceWaiting();
    }
  }
  if (waiting_count_ > 0) traceWaiting();
}

void WideBeams::traceWaiting() {
  NearestHit hits[kPacket];
  plan_.scene.intersect(packet_, waiting_count_, static_cast<float>(plan_.farthest_m), hits);
  for (int k = 0; k < waiting_count_; ++k) *waiting_[k] = hits[k];
  waiting_count_ = 0;
}

bool WideBeams::severalSurfaces(const WideBeam& beam) {
  if (beam.axis.facet == kNoFacet)
    return std::any_of(beam.hits, beam.hits + kProbes, [](const NearestHit& hit) { return hit.facet != kNoFacet; });
  const MetFacet& met = facets_.of(beam.axis.facet);
  const double tolerance = edgeTolerance(plan_.instrument, static_cast<double>(beam.axis.range_m));
  for (int k = 0; k < kProbes; ++k)
    if (!met.holds(beam.lines[k], beam.hits[k], tolerance)) return true;
  return false;
}

}  // namespace standpoint
