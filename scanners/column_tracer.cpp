// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/column_tracer.h"

#include <algorithm>
#include <bit>

#include "scanners/portable_math.h"

namespace standpoint {

namespace {

// Noise of the second and further returns of a pulse: a channel each.
constexpr std::uint32_t kFurtherReturns = 16;

}  // namespace

ColumnTracer::ColumnTracer(const ScanPlan& plan)
    : plan_(plan),
      facets_(plan),
      paths_(plan, facets_),
      columns_(plan, facets_),
      edges_(plan, columns_, facets_),
      wide_(plan, facets_),
      points_(plan),
      writer_(plan) {}

void ColumnTracer::trace(std::uint32_t from, std::uint32_t to, PointBlock& block) {
  for (std::uint32_t c = from; c < to; ++c) {
    columns_.moveTo(c);
    current_ = &columns_.current();
    traceColumn(block);
  }
}

void ColumnTracer::traceColumn(PointBlock& block) {
  points_.begin(current_->column(), current_->ahead(), current_->lateral());
  writer_.begin(current_->column(), block);
  for (std::uint32_t first = 0; first < plan_.settings.rows; first += kPacket) traceRows(first);
  writer_.end();
}

void ColumnTracer::traceRows(std::uint32_t first_row) {
  returns_.begin(plan_, first_row);
  const Surfaces met = setSurfaces(first_row);
  const std::uint32_t edges = plan_.reach() > 0 ? traceEdges(first_row) : 0;
  std::uint32_t present = 0;
  if (met.plain != 0) {
    current_->axes(first_row, axes_);
    present = meetPlanes(planes_, axes_, current_->ranges_m(first_row), plan_.instrument.min_range_m,
                         plan_.settings.max_range_m, returns_);
  }
  const std::uint32_t rows = std::min<std::uint32_t>(kPacket, plan_.settings.rows - first_row);
  const std::uint32_t special = plan_.scatterers ? (1U << rows) - 1 : met.other | edges;
  present &= met.plain & ~special;
  further_.clear();
  std::size_t wide = 0;
  for (std::uint32_t left = special; left != 0; left &= left - 1) {
    const int lane = std::countr_zero(left);
    const bool edge = (edges >> static_cast<unsigned>(lane) & 1U) != 0;
    gatherEnds(first_row + static_cast<std::uint32_t>(lane), edge ? &wide_[wide++] : nullptr);
    if (addEchoes(lane)) present |= left & -left;
  }
  if (present == 0) return;
  points_.drawRows(first_row, returns_);
  const std::uint32_t detected = points_.receive(returns_, kReturnLanes) & present;
  if (further_.empty())
    writer_.write(returns_, detected);
  else
    writeSeveral(detected);
}

// Neighbouring rows mostly meet the same facet.
ColumnTracer::Surfaces ColumnTracer::setSurfaces(std::uint32_t first_row) {
  const std::uint64_t* facets = current_->facets(first_row);
  Surfaces surfaces;
  for (int from = 0, to = 1; from < kPacket; from = to++) {
    while (to < kPacket && facets[to] == facets[from]) ++to;
    if (facets[from] == kNoFacet) continue;
    const MetFacet& met = facets_.of(facets[from]);
    planes_.set(from, to, met.facet);
    returns_.setSurface(plan_, from, to, met);
    (met.plain ? surfaces.plain : surfaces.other) |=
        (1U << static_cast<unsigned>(to)) - (1U << static_cast<unsigned>(from));
  }
  return surfaces;
}

std::uint32_t ColumnTracer::traceEdges(std::uint32_t first_row) {
  wide_.clear();
  for (std::uint32_t left = edges_.find(first_row); left != 0; left &= left - 1) {
    const std::uint32_t row = first_row + static_cast<std::uint32_t>(std::countr_zero(left));
    wide_.add(row, current_->hit(row), current_->beam(row));
  }
  wide_.trace();
  std::uint32_t edges = 0;
  for (std::size_t i = 0; i < wide_.size(); ++i) edges |= 1U << (wide_[i].row - first_row);
  return edges;
}

// Where the light of one pulse ends; `wide` is its beam where that meets several surfaces.
void ColumnTracer::gatherEnds(std::uint32_t row, const WideBeam* wide) {
  ends_.clear();
  const NearestHit hit = current_->hit(row);
  const RayLine axis = current_->axis(row);
  if (hit.facet != kNoFacet) paths_.follow(axis.origin, axis.direction, hit, wide != nullptr ? kAxisWeight : 1, ends_);
  const auto& sub_rays = subRays();
  for (std::size_t k = 0; wide != nullptr && k < kSubRays; ++k)
    if (wide->hits[k].facet != kNoFacet)
      paths_.follow(wide->lines[k].origin, wide->lines[k].direction, wide->hits[k], sub_rays[k].weight, ends_);
  if (plan_.scatterers) addScatterer(row, axis);
}

// What the air sends back, from before the nearest surface.
void ColumnTracer::addScatterer(std::uint32_t row, const RayLine& axis) {
  double nearest = plan_.settings.max_range_m;
  for (const PathEnd& end : ends_) nearest = std::min(nearest, end.path_m);
  const auto found = plan_.scatterers->strongest(current_->column(), row, nearest, plan_.drop_threshold);
  if (!found) return;
  static const Optics kDrop;
  PathEnd& end = ends_.emplace_back();
  end.path_m = found->range_m;
  end.flags = point_flag::kWeather;
  end.place = (axis.origin + found->range_m * axis.direction).cast<float>();
  end.optics = &kDrop;
  end.product = plan_.nothingLabel(), end.surface = kNoSurface, end.material = plan_.unassignedLabel();
  end.known_x = static_cast<float>(found->x);
}

float ColumnTracer::powerOf(const PathEnd& end) const {
  if (end.known_x >= 0) return end.known_x;
  const auto range = static_cast<float>(end.path_m);
  const float near = plan_.options.effects.has(Effect::near_range) ? nearRangeFactor(plan_.instrument, range) : 1;
  const float air = portable::exp2(std::max(-100.0F, plan_.receiver.decay_per_m * range));
  return lambertEquivalent(*end.optics, end.cosine) * end.gain * near * air / (range * range);
}

// The first echo of the ends takes the pulse's lane.
bool ColumnTracer::addEchoes(int lane) {
  contributions_.clear();
  for (const PathEnd& end : ends_) contributions_.push_back({end.path_m + end.excess_m, powerOf(end)});
  receiveEchoes(plan_.instrument.waveform, contributions_, order_, echoes_);
  std::uint32_t returns = 0;
  for (const Echo& echo : echoes_) {
    if (!inRange(echo.range_m)) continue;
    const PathEnd& end = ends_[static_cast<std::size_t>(echo.strongest)];
    if (returns == 0)
      returns_.setEcho(plan_, lane, end, echo);
    else
      further_.push_back({lane, returns, end, echo});
    ++returns;
  }
  return returns > 0;
}

// Points in order of their returns, of which some pulses have several.
void ColumnTracer::writeSeveral(std::uint32_t detected) {
  const auto batches = (further_.size() + kReturnLanes - 1) / kReturnLanes;
  if (further_lanes_.size() < batches) further_lanes_.resize(batches);
  for (std::size_t i = 0; i < further_.size(); ++i) {
    ReturnLanes& lanes = further_lanes_[i / kReturnLanes];
    const int lane = static_cast<int>(i % kReturnLanes);
    points_.drawFurther(returns_, further_[i].pulse, static_cast<NoiseChannel>(kFurtherReturns + further_[i].number),
                        lanes, lane);
    lanes.setEcho(plan_, lane, further_[i].end, further_[i].echo);
  }
  further_detected_.clear();
  for (std::size_t batch = 0; batch < batches; ++batch) {
    const auto count = std::min<std::size_t>(kReturnLanes, further_.size() - batch * kReturnLanes);
    further_detected_.push_back(points_.receive(further_lanes_[batch], static_cast<int>(count)));
  }
  places_.clear();
  std::size_t next = 0;
  for (int pulse = 0; pulse < kReturnLanes; ++pulse) {
    const std::size_t from = places_.size();
    if ((detected >> static_cast<unsigned>(pulse) & 1U) != 0) places_.push_back({&returns_, pulse});
    for (; next < further_.size() && further_[next].pulse == pulse; ++next)
      if ((further_detected_[next / kReturnLanes] >> next % kReturnLanes & 1U) != 0)
        places_.push_back({&further_lanes_[next / kReturnLanes], static_cast<int>(next % kReturnLanes)});
    for (std::size_t i = from; i < places_.size(); ++i) {
      places_[i].return_number = static_cast<std::uint8_t>(i - from + 1);
      places_[i].return_count = static_cast<std::uint8_t>(places_.size() - from);
    }
  }
  writer_.write(places_);
}

}  // namespace standpoint
