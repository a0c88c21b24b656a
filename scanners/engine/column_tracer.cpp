// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/column_tracer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <utility>

#include "core/portable_math.h"

namespace standpoint {

namespace {

// Noise of the second and further returns of a pulse: a channel each.
constexpr std::uint32_t kFurtherReturns = 16;
constexpr std::uint32_t kInterferenceChannel = 8;
constexpr std::uint64_t kOverwritten = kNoFacet - 1;  // instead of the number of a facet

std::array<std::uint32_t, 4> interferenceDraw(const ScanOptions& options, std::uint32_t column, std::uint32_t row) {
  return philox({options.seed, options.station_key}, column, row, kInterferenceChannel);
}

}  // namespace

ColumnTracer::ColumnTracer(const ScanPlan& plan, const Edges& edges, std::shared_ptr<SweptBodies> bodies)
    : plan_(plan),
      scene_(std::move(bodies)),
      facets_(plan, scene_),
      paths_(plan, facets_, scene_),
      edges_(edges),
      corner_light_(plan, facets_),
      column_(plan, scene_),
      wide_(plan, facets_, scene_, column_.seen()),
      powers_(plan.receiver),
      points_(plan),
      writer_(plan) {
  std::fill_n(held_, kPacket, kOverwritten);
}

std::uint64_t ColumnTracer::trace(std::uint32_t from, std::uint32_t to, PointBlock& block) {
  std::uint64_t pulses = 0;
  writer_.begin(block);
  for (std::uint32_t c = from; c < to; ++c) {
    column_.trace(c);
    traceColumn();
    pulses += column_.pulses();
  }
  writer_.end();
  return pulses;
}

void ColumnTracer::traceColumn() {
  points_.begin(column_);
  writer_.beginColumn(column_);
  found_.begin(plan_.settings.rows);
  found_corners_.begin(plan_.settings.rows);
  if (edges_.map != nullptr) edges_.map->mark(column_, facets_, found_);
  if (edges_.finder != nullptr) edges_.finder->mark(column_, scene_, facets_, found_);
  if (edges_.corners != nullptr) edges_.corners->mark(column_, facets_, found_corners_);
  for (std::uint32_t first = 0; first < plan_.settings.rows; first += kPacket) traceRows(first);
  writer_.endColumn();
}

void ColumnTracer::traceRows(std::uint32_t first_row) {
  returns_.begin(first_row, column_.sines(first_row), column_.cosines(first_row));
  const Surfaces met = setSurfaces(first_row);
  const std::uint32_t edges = traceEdges(first_row);
  std::uint32_t present = 0;
  if (met.plain != 0) {
    const RayLanes& axes = column_.axes(first_row);
    const bool folds = plan_.unambiguous_m > 0;
    present = meetPlanes(planes_, axes, column_.ranges_m(first_row), plan_.nearest_reported_m,
                         folds ? plan_.farthest_m : plan_.farthest_reported_m, returns_);
    if (folds) present = reported(present);
    if (plan_.daylight) setNormals(axes, present & met.plain);
  }
  const std::uint32_t rows = std::min<std::uint32_t>(kPacket, plan_.settings.rows - first_row);
  const std::uint32_t stray = straying(first_row, rows);
  const std::uint32_t corners = edges_.corners != nullptr ? found_corners_.rows(first_row) : 0;
  const std::uint32_t special = met.other | edges | corners | stray;
  present &= met.plain & ~special;
  specials_.clear(), ends_.clear(), further_.clear();
  std::size_t next_wide = 0;
  for (std::uint32_t left = special; left != 0; left &= left - 1) {
    const Special pulse{std::countr_zero(left), ends_.size()};
    specials_.push_back(pulse);
    const bool edge = (edges & left & -left) != 0;
    const std::uint32_t row = first_row + static_cast<std::uint32_t>(pulse.lane);
    if (scene_.moves()) paths_.setTime(column_.bodiesTime_s(row));
    if (edge)
      while (!wide_[next_wide].several) ++next_wide;
    gatherEnds(row, edge ? &wide_[next_wide++] : nullptr);
    if ((corners & left & -left) != 0) corner_light_.add(column_.beam(row), column_.column(), row, ends_, pulse.from);
    if ((stray & left & -left) != 0) gatherStray(row, pulse.from);
  }
  const std::vector<float>& powers = powers_.of(ends_);
  for (std::size_t i = 0; i < specials_.size(); ++i) {
    const std::size_t to = i + 1 < specials_.size() ? specials_[i + 1].from : ends_.size();
    if (addEchoes(powers, specials_[i].lane, specials_[i].from, to))
      present |= 1U << static_cast<unsigned>(specials_[i].lane);
  }
  if (present == 0) return;
  points_.drawRows(first_row, returns_);
  if (plan_.daylight) light(returns_, kReturnLanes);
  const std::uint32_t detected = points_.receive(returns_, kReturnLanes) & present;
  if (further_.empty())
    writer_.write(returns_, detected);
  else
    writeSeveral(detected);
}

// Neighbouring rows mostly meet the same facet, and so do the next sixteen.
ColumnTracer::Surfaces ColumnTracer::setSurfaces(std::uint32_t first_row) {
  const std::uint64_t* facets = column_.facets(first_row);
  std::uint64_t other = 0;
  for (int k = 0; k < kPacket; ++k) other |= facets[k] ^ held_[k];
  if (other == 0 && !held_passing_) return held_surfaces_;
  held_passing_ = false;
  Surfaces surfaces;
  for (int from = 0, to = 1; from < kPacket; from = to++) {
    while (to < kPacket && facets[to] == facets[from]) ++to;
    if (facets[from] == kNoFacet) continue;
    const MetFacet& met = facets_.of(facets[from]);
    if (met.facet.stays()) {
      planes_.set(from, to, met.facet);
    } else {
      held_passing_ = true;
      for (int k = from; k < to; ++k) {
        const std::uint32_t row = first_row + static_cast<std::uint32_t>(k);
        const RayLine line = column_.axis(row);
        planes_.set(k, k + 1, scene_.at(met.facet, column_.bodiesTime_s(row)).metBy(line.origin, line.direction));
        if (met.facet.body != kNoBody) returns_.flag(k, point_flag::kMoving);
      }
    }
    returns_.setSurface(plan_, from, to, met);
    (met.plain ? surfaces.plain : surfaces.other) |=
        (1U << static_cast<unsigned>(to)) - (1U << static_cast<unsigned>(from));
  }
  std::copy_n(facets, kPacket, held_);
  return held_surfaces_ = surfaces;
}

// Of the sixteen rows from `first_row` on those whose beams meet several surfaces. They are among `wide_`, in order.
std::uint32_t ColumnTracer::traceEdges(std::uint32_t first_row) {
  const std::uint32_t rows = std::min<std::uint32_t>(kPacket, plan_.settings.rows - first_row);
  const std::uint32_t all = plan_.everyBeamWide() ? column_.measured(first_row, rows) : 0;
  const std::uint32_t marked = edgesKnown() ? found_.rows(first_row) : all;
  if (marked == 0) return 0;
  wide_.clear();
  for (std::uint32_t left = marked; left != 0; left &= left - 1) {
    const std::uint32_t row = first_row + static_cast<std::uint32_t>(std::countr_zero(left));
    wide_.add(column_, row, edgesKnown() ? &found_.of(row) : nullptr);
  }
  wide_.trace();
  std::uint32_t edges = 0;
  for (std::size_t i = 0; i < wide_.size(); ++i)
    if (wide_[i].several) edges |= 1U << (wide_[i].row - first_row);
  return edges;
}

// Where the light of one pulse ends; `wide` is its beam where that meets several surfaces.
void ColumnTracer::gatherEnds(std::uint32_t row, const WideBeam* wide) {
  if (wide != nullptr) return gatherWide(*wide);
  const NearestHit hit = column_.hit(row);
  const RayLine axis = column_.axis(row);
  if (hit.facet != kNoFacet) paths_.follow(axis.origin, axis.direction, hit, 1, ends_);
}

// Rays that meet one facet are one end, where their mean by power meets it: a triangle holds the mean of its places.
// Behind panes and by way of mirrors they may meet different ones, and are followed one by one.
void ColumnTracer::gatherWide(const WideBeam& wide) {
  struct OnFacet {  // not initialised: there are as many as rays
    std::uint64_t facet;
    double across, upward, range_m, weight;  // sums by weight
  };
  OnFacet met[kReferenceSubRays];
  int count = 0;
  for (int k = 0; k < wide.ray_count; ++k) {
    const NearestHit& hit = wide.hits[k];
    if (hit.facet == kNoFacet) continue;
    const SubRay& ray = wide.rays[k];
    int at = 0;
    while (at < count && met[at].facet != hit.facet) ++at;
    const MetFacet& facet = facets_.of(hit.facet);
    // A ball bends away within the beam: the mean of its rays would be off by what it is deep there.
    if (at == count || !facet.plain || facet.facet.ball != nullptr) met[at = count++] = {hit.facet, 0, 0, 0, 0};
    const auto weight = static_cast<double>(ray.weight);
    met[at].across += weight * ray.across, met[at].upward += weight * ray.upward;
    met[at].range_m += weight * static_cast<double>(hit.range_m), met[at].weight += weight;
  }
  for (int i = 0; i < count; ++i) {
    const OnFacet& on = met[i];
    const RayLine line = lineOf(wide.beam, on.across / on.weight, on.upward / on.weight, plan_.instrument);
    const NearestHit mean{on.facet, static_cast<float>(on.range_m / on.weight)};
    paths_.follow(line.origin, line.direction, mean, static_cast<float>(on.weight), ends_);
  }
}

// Rows of which something may come back that is not on the beam's own way.
std::uint32_t ColumnTracer::straying(std::uint32_t first_row, std::uint32_t rows) const {
  const std::uint32_t measured = column_.measured(first_row, rows);
  if (plan_.scatterers) return measured;
  std::uint32_t lanes = 0;
  if (!plan_.halo && plan_.interference <= 0) return lanes;
  for (std::uint32_t k = 0; k < rows; ++k) {
    const bool wings = plan_.halo && plan_.halo->reaches(column_.column(), first_row + k);
    if (wings || (plan_.interference > 0 && struck(first_row + k))) lanes |= 1U << k;
  }
  return lanes & measured;
}

// Does another instrument's light come in while this pulse is listened for?
bool ColumnTracer::struck(std::uint32_t row) const {
  return uniform(interferenceDraw(plan_.options, column_.column(), row)[0]) < plan_.interference;
}

// `from`: where the ends of its pulse begin.
void ColumnTracer::gatherStray(std::uint32_t row, std::size_t from) {
  const RayLine axis = column_.axis(row);
  if (plan_.halo && plan_.halo->reaches(column_.column(), row)) gatherWings(column_.beam(row));
  if (plan_.scatterers) {  // the air's return, from before the nearest surface
    double nearest = plan_.settings.max_range_m;
    for (std::size_t i = from; i < ends_.size(); ++i) nearest = std::min(nearest, ends_[i].path_m);
    if (const auto found = plan_.scatterers->strongest(column_.column(), row, nearest, plan_.drop_threshold))
      addSurfaceless(axis, found->range_m, found->x, point_flag::kWeather);
  }
  if (plan_.interference <= 0 || !struck(row)) return;
  // At any time of the listening window, as strong as it may be: the power of a source at an unknown distance is above
  // the threshold by a factor f with the chance 1/f.
  const auto draw = interferenceDraw(plan_.options, column_.column(), row);
  const double nearest = plan_.instrument.min_range_m;
  addSurfaceless(axis, nearest + uniform(draw[1]) * (plan_.settings.max_range_m - nearest),
                 detectionThreshold(plan_.settings, 0) / std::max(1e-3, uniform(draw[2])), point_flag::kNoise);
}

// What the beam's wings find of retroreflectors.
void ColumnTracer::gatherWings(const Beam& beam) {
  const std::size_t before = ends_.size();
  const auto fraction = static_cast<float>(plan_.instrument.saturation.pedestal);
  for (const SubRay& ray : wingRays()) {
    const RayLine line = lineOf(beam, ray.across, ray.upward, plan_.instrument);
    const NearestHit hit = scene_.nearest(line.origin, line.direction, 0, plan_.farthest_m, paths_.time_s());
    if (hit.facet != kNoFacet && facets_.of(hit.facet).optics->retro_gain > 0)
      paths_.follow(line.origin, line.direction, hit, fraction * ray.weight, ends_);
  }
  for (std::size_t i = before; i < ends_.size(); ++i) ends_[i].flags |= point_flag::kMirrored;
}

void ColumnTracer::addSurfaceless(const RayLine& axis, double range_m, double x, std::uint8_t flag) {
  static const Optics kNothing;
  PathEnd& end = ends_.emplace_back();
  end.path_m = range_m;
  end.flags = flag;
  end.place = (axis.origin + range_m * axis.direction).cast<float>();
  end.optics = &kNothing;
  end.product = plan_.nothingLabel(), end.surface = kNoSurface, end.material = plan_.unassignedLabel();
  end.known_x = static_cast<float>(x);
}

// Of a phase-shift instrument: what is folded into its range stays, and is flagged.
std::uint32_t ColumnTracer::reported(std::uint32_t lanes) {
  std::uint32_t kept = lanes;
  for (std::uint32_t left = lanes; left != 0; left &= left - 1) {
    const int lane = std::countr_zero(left);
    if (!plan_.reports(returns_.range_m[lane]))
      kept &= ~(left & -left);
    else if (returns_.range_m[lane] >= plan_.unambiguous_m)
      returns_.flag(lane, point_flag::kMirrored);
  }
  return kept;
}

void ColumnTracer::setNormals(const RayLanes& axes, std::uint32_t lanes) {
  for (std::uint32_t left = lanes; left != 0; left &= left - 1) {
    const int k = std::countr_zero(left);
    const Eigen::Vector3d normal(planes_.normal_x[k], planes_.normal_y[k], planes_.normal_z[k]);
    const Eigen::Vector3d way(axes.direction.x[k], axes.direction.y[k], axes.direction.z[k]);
    const Eigen::Vector3f towards = (normal.dot(way) < 0 ? normal : Eigen::Vector3d(-normal)).cast<float>();
    returns_.normal_x[k] = towards.x(), returns_.normal_y[k] = towards.y(), returns_.normal_z[k] = towards.z();
  }
}

// Daylight on what the returns come from, and in the beam's direction; shadows by rays towards the sun.
void ColumnTracer::light(ReturnLanes& r, int count) {
  RayPacket rays{};
  std::uint64_t shade[kPacket];
  float ranges[kPacket];
  const Daylight& day = *plan_.daylight;
  constexpr float kOff_m = 0.002F;
  for (int k = 0; k < count; ++k)
    rays.set(k,
             {static_cast<double>(r.place_x[k] + kOff_m * r.normal_x[k]),
              static_cast<double>(r.place_y[k] + kOff_m * r.normal_y[k]),
              static_cast<double>(r.place_z[k] + kOff_m * r.normal_z[k])},
             day.towards());
  if (scene_.moves())
    for (int k = 0; k < count; ++k) rays.time_s[k] = column_.bodiesTime_s(r.row[k]);
  scene_.intersect(rays, count, std::numeric_limits<float>::infinity(), shade, ranges, nullptr);
  for (int k = 0; k < count; ++k) {
    r.signal.background[k] = day.ofDirection(column_.axis(r.row[k]).direction);
    if (shade[k] != kNoFacet && !plan_.passes(*facets_.of(shade[k]).optics)) continue;
    r.signal.background[k] += day.ofSurface(r.signal.diffuse[k], {r.normal_x[k], r.normal_y[k], r.normal_z[k]});
  }
}

// The first echo of the ends takes the pulse's lane.
bool ColumnTracer::addEchoes(const std::vector<float>& powers, int lane, std::size_t from, std::size_t to) {
  contributions_.clear();
  for (std::size_t i = from; i < to; ++i)
    contributions_.push_back({ends_[i].path_m + ends_[i].excess_m, powers[i], static_cast<int>(i)});
  receiveEchoes(plan_.instrument.waveform, contributions_, echoes_);
  std::uint32_t returns = 0;
  for (const Echo& echo : echoes_) {
    if (!plan_.reports(echo.range_m)) continue;
    const PathEnd& end = ends_[static_cast<std::size_t>(echo.strongest)];
    if (returns == 0) {
      returns_.setEcho(plan_, lane, end, echo);
      held_[lane] = kOverwritten;
    } else {
      further_.push_back({lane, returns, end, echo});
    }
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
    if (plan_.daylight) light(further_lanes_[batch], static_cast<int>(count));
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
