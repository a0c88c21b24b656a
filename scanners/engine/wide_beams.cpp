// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/wide_beams.h"

#include <algorithm>

#include "core/random.h"

namespace standpoint {

void WideBeams::add(const ColumnHits& column, std::uint32_t row, const BeamEdges* edges) {
  if (count_ == beams_.size()) beams_.emplace_back();
  WideBeam& wide = beams_[count_++];
  wide.row = row;
  wide.axis = column.hit(row);
  wide.time_s = column.bodiesTime_s(row);
  wide.beam = column.beam(row);
  wide.several = false;
  wide.ray_count = 0;
  wide.numbers = philox({plan_.options.seed, plan_.options.station_key}, column.column(), row, kFootprintChannel);
  if (edges != nullptr) {
    wide.ray_count = drawStrips(plan_.scene, plan_.instrument, wide.beam, *edges, wide.numbers, wide.rays);
    wide.hidden_m = edges->hidden_m;
  }
  wide.strips = wide.ray_count > 0;
  if (!wide.strips) draw(wide);
}

void WideBeams::draw(WideBeam& beam) {
  beam.ray_count = plan_.forReference() ? kReferenceSubRays : kSubRays;
  drawFootprint(beam.numbers, beam.ray_count, beam.rays);
}

void WideBeams::trace() {
  for (std::size_t i = 0; i < count_; ++i)
    if (beams_[i].ray_count > 1) send(beams_[i]);
  flush();
  for (std::size_t i = 0; i < count_; ++i) {
    WideBeam& beam = beams_[i];
    if (!beam.strips || beam.ray_count == 1 || !showsMore(beam)) continue;
    beam.strips = false;
    draw(beam);
    send(beam);
  }
  flush();
  for (std::size_t i = 0; i < count_; ++i) beams_[i].several = beams_[i].ray_count > 1 && severalSurfaces(beams_[i]);
}

void WideBeams::send(WideBeam& beam) {
  for (int k = 0; k < beam.ray_count; ++k) {
    const RayLine line = lineOf(beam.beam, beam.rays[k].across, beam.rays[k].upward, plan_.instrument);
    packet_.set(sent_count_, line.origin, line.direction);
    packet_.time_s[sent_count_] = beam.time_s;
    sent_[sent_count_++] = {&beam, k};
    if (sent_count_ == kPacket) flush();
  }
}

void WideBeams::flush() {
  if (sent_count_ == 0) return;
  NearestHit hits[kPacket];
  scene_.intersect(packet_, sent_count_, static_cast<float>(plan_.farthest_m), hits);
  for (int k = 0; k < sent_count_; ++k) sent_[k].beam->hits[sent_[k].ray] = hits[k];
  sent_count_ = 0;
}

// May there be more beside the axis' surface than the edges that are seen say?
bool WideBeams::showsMore(const WideBeam& beam) {
  if (isRound(beam.axis.facet)) return true;
  for (int k = 0; k < beam.ray_count; ++k) {
    const auto range = static_cast<double>(beam.hits[k].range_m);
    if (static_cast<double>(beam.hidden_m) < range + edgeTolerance(plan_.instrument, range)) return true;
    if (isRound(beam.hits[k].facet)) return true;
  }
  return false;
}

bool WideBeams::severalSurfaces(const WideBeam& beam) {
  const NearestHit* end = beam.hits + beam.ray_count;
  if (beam.axis.facet == kNoFacet)
    return std::any_of(beam.hits, end, [](const NearestHit& hit) { return hit.facet != kNoFacet; });
  if (plan_.forReference())
    return std::any_of(beam.hits, end, [&](const NearestHit& hit) { return hit.facet != beam.axis.facet; });
  const MetFacet& seen = facets_.of(beam.axis.facet);
  const MetFacet moved = seen.facet.body != kNoBody
                             ? facets_.met(beam.axis.facet, beam.beam.origin, beam.beam.direction, beam.time_s)
                             : MetFacet{};
  const MetFacet& met = seen.facet.body != kNoBody ? moved : seen;
  const double tolerance = edgeTolerance(plan_.instrument, static_cast<double>(beam.axis.range_m));
  for (int k = 0; k < beam.ray_count; ++k)
    if (!met.holds(lineOf(beam.beam, beam.rays[k].across, beam.rays[k].upward, plan_.instrument), beam.hits[k],
                   tolerance))
      return true;
  return false;
}

}  // namespace standpoint
