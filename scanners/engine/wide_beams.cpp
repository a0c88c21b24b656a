// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/wide_beams.h"

#include <algorithm>
#include <utility>

#include "core/random.h"

namespace standpoint {

namespace {

constexpr std::uint32_t kFootprintChannel = 9;

}  // namespace

void WideBeams::add(std::uint32_t column, std::uint32_t row, const NearestHit& axis, const Beam& beam) {
  if (count_ == beams_.size()) beams_.emplace_back();
  WideBeam& wide = beams_[count_++];
  wide.row = row;
  wide.axis = axis;
  wide.beam = beam;
  const RandomKey key{plan_.options.seed, plan_.options.station_key};
  drawFootprint(philox(key, column, row, kFootprintChannel), raysEach(), wide.rays);
}

void WideBeams::trace() {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    traceRays(beams_[i]);
    if (!severalSurfaces(beams_[i])) continue;
    if (kept != i) std::swap(beams_[kept], beams_[i]);
    ++kept;
  }
  count_ = kept;
}

void WideBeams::traceRays(WideBeam& beam) {
  RayPacket packet;
  for (int from = 0; from < raysEach(); from += kPacket) {
    for (int k = 0; k < kPacket; ++k) {
      const RayLine line = lineOf(beam.beam, beam.rays[from + k].across, beam.rays[from + k].upward, plan_.instrument);
      packet.set(k, line.origin, line.direction);
    }
    plan_.scene.intersect(packet, kPacket, static_cast<float>(plan_.farthest_m), beam.hits + from);
  }
}

bool WideBeams::severalSurfaces(const WideBeam& beam) {
  const NearestHit* end = beam.hits + raysEach();
  if (beam.axis.facet == kNoFacet)
    return std::any_of(beam.hits, end, [](const NearestHit& hit) { return hit.facet != kNoFacet; });
  if (plan_.forReference())
    return std::any_of(beam.hits, end, [&](const NearestHit& hit) { return hit.facet != beam.axis.facet; });
  const MetFacet& met = facets_.of(beam.axis.facet);
  const double tolerance = edgeTolerance(plan_.instrument, static_cast<double>(beam.axis.range_m));
  for (int k = 0; k < raysEach(); ++k)
    if (!met.holds(lineOf(beam.beam, beam.rays[k].across, beam.rays[k].upward, plan_.instrument), beam.hits[k],
                   tolerance))
      return true;
  return false;
}

}  // namespace standpoint
