// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/column_tracer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "scanners/portable_math.h"
#include "scanners/surface_texture.h"

namespace standpoint {

namespace {

// Noise of the second and further returns of a pulse: a channel each.
constexpr std::uint32_t kFurtherReturns = 16;
constexpr std::uint32_t kInterferenceChannel = 8;
constexpr std::array<std::uint8_t, 3> kWhite = {255, 255, 255};

std::array<std::uint32_t, 4> interferenceDraw(const ScanOptions& options, std::uint32_t column, std::uint32_t row) {
  return philox({options.seed, options.station_key}, column, row, kInterferenceChannel);
}

Pose relative(const Pose& from, const Pose& to) {
  const Eigen::Quaterniond back = from.rotation.conjugate();
  return {back * to.rotation, back * (to.translation - from.translation)};
}

}  // namespace

ColumnTracer::ColumnTracer(const ScanPlan& plan)
    : plan_(plan),
      facets_(plan),
      paths_(plan, facets_),
      columns_(2 * plan.reach() + 1, ColumnHits(plan)),
      row_step_(plan.rowStep_rad()),
      column_step_(plan.columnStep_rad()),
      start_(at(plan.trajectory, 0)),
      sub_rays_{},
      signal_{},
      noise_{} {
  if (plan.column_noise) along_.resize(plan.column_noise->paddedRows());
  std::fill_n(signal_.range_m, kSignalLanes, 1.0F);
  std::fill_n(signal_.cosine, kSignalLanes, 1.0F);
  std::fill_n(signal_.variation, kSignalLanes, 1.0F);
}

void ColumnTracer::trace(std::uint32_t from, std::uint32_t to, PointBlock& block) {
  const std::uint32_t reach = plan_.reach();
  const std::uint32_t columns = plan_.settings.columns;
  for (std::uint32_t c = from - std::min(from, reach); c < std::min(columns, from + reach); ++c) column(c).trace(c);
  for (std::uint32_t c = from; c < to; ++c) {
    if (c + reach < columns) column(c + reach).trace(c + reach);
    current_ = &column(c);
    traceColumn(block);
  }
}

void ColumnTracer::traceColumn(PointBlock& block) {
  const std::uint32_t column = current_->column();
  face_ = plan_.clock.behind(column) ? -1 : 1;
  const double azimuth = plan_.azimuth_rad(column);
  ahead_ = {std::cos(azimuth), -std::sin(azimuth), 0};     // clockwise seen from above
  lateral_ = {-std::sin(azimuth), -std::cos(azimuth), 0};
  if (plan_.column_noise) plan_.column_noise->along(column, along_.data());
  azimuth_error_ = plan_.errors.azimuthError_rad(azimuth);
  const bool wide = plan_.options.effects.has(Effect::footprint);
  for (std::uint32_t first = 0; first < plan_.settings.rows; first += kPacket) {
    const std::uint32_t end = std::min(plan_.settings.rows, first + kPacket);
    const std::uint32_t unlike = wide ? unlikeNeighbours(first) : 0;
    for (std::uint32_t row = first; row < end; ++row) {
      const NearestHit hit = current_->hit(row);
      const bool suspect = (unlike >> (row - first) & 1U) != 0;
      const bool wings = plan_.halo && plan_.halo->reaches(column, row);
      const bool stray = plan_.scatterers || (plan_.interference > 0 && struck(row));
      if (hit.facet == kNoFacet && !suspect && !stray && !wings) continue;
      const bool edge = suspect && atEdge(row) && probe(current_->beam(row), hit);
      if (!edge && !stray && !wings) {
        if (hit.facet == kNoFacet) continue;
        if (const MetFacet& met = facets_.of(hit.facet); met.plain) {
          addSurface(row, current_->axis(row), hit, met);
          continue;
        }
      }
      const Beam beam = current_->beam(row);
      gatherEnds(beam, hit, edge);
      if (wings) gatherWings(beam);
      if (stray) addStray(row, beam);
      addEchoes(row);
    }
    if (targets_.empty()) continue;
    drawNoise(first, 0);
    if (plan_.column_noise) plan_.column_noise->wobble(column, first, wobble_);
    receiveAll(block);
  }
}

ColumnTracer::Reach ColumnTracer::reachAt(double range_m, std::uint32_t row) const {
  const double start = plan_.instrument.exit_diameter_m / range_m, spread = plan_.instrument.divergence_rad;
  const double square = 0.25 * kOuterShare * kOuterShare * (start * start + spread * spread);   // of the beam's edge, in rad
  const auto pulses = [&](double step) {
    std::uint32_t n = 1;
    while (n < plan_.reach() && n * step * n * step < square) ++n;
    return n;
  };
  return {pulses(row_step_), pulses(column_step_ * std::max(1e-3, plan_.cosine[row]))};
}

namespace {

// Next to the axis, at the beam's edge, and half-way.
std::array<std::uint32_t, 3> places(std::uint32_t reach) { return {1, (reach + 1) / 2, reach}; }

}  // namespace

// Rows, from `first_row` on, of which a neighbour up, down, left or right meets another facet.
std::uint32_t ColumnTracer::unlikeNeighbours(std::uint32_t first_row) {
  float nearest = static_cast<float>(plan_.farthest_m);
  for (std::uint32_t row = first_row; row < std::min(plan_.settings.rows, first_row + kPacket); ++row)
    if (const NearestHit hit = current_->hit(row); hit.facet != kNoFacet) nearest = std::min(nearest, hit.range_m);
  const Reach reach = reachAt(std::max(0.01, static_cast<double>(nearest)), first_row);
  const std::uint32_t own_column = current_->column();
  const std::uint64_t* own = current_->facets(first_row);
  std::uint64_t differs[kPacket] = {};
  const auto compare = [&](const std::uint64_t* other) {
    for (int k = 0; k < kPacket; ++k) differs[k] |= own[k] ^ other[k];
  };
  std::uint32_t done = 0;
  for (const std::uint32_t apart : places(reach.rows)) {
    if (apart == done) continue;
    compare(own - apart), compare(own + apart);
    done = apart;
  }
  done = 0;
  for (const std::uint32_t apart : places(reach.columns)) {
    if (apart == done) continue;
    if (own_column >= apart) compare(column(own_column - apart).facets(first_row));
    if (own_column + apart < plan_.settings.columns) compare(column(own_column + apart).facets(first_row));
    done = apart;
  }
  std::uint32_t unlike = 0;
  for (int k = 0; k < kPacket; ++k) unlike |= static_cast<std::uint32_t>(differs[k] != 0) << static_cast<unsigned>(k);
  return unlike;
}

// Is a neighbour's axis on another surface than this one's, or on none?
bool ColumnTracer::atEdge(std::uint32_t row) {
  const NearestHit own = current_->hit(row);
  MetFacet met;
  double tolerance = 0;
  Reach reach{plan_.reach(), plan_.reach()};
  if (own.facet != kNoFacet) {
    met = facets_.of(own.facet);
    const auto range = std::max(0.01, static_cast<double>(own.range_m));
    tolerance = edgeTolerance(plan_.instrument, range);
    reach = reachAt(range, row);
  }
  const auto differs = [&](const ColumnHits& column, std::uint32_t there) {
    const NearestHit hit = column.hit(there);
    if (hit.facet == own.facet) return false;
    if (hit.facet == kNoFacet || own.facet == kNoFacet) return true;
    return !onSameSurface(met, column.axis(there), hit, tolerance);
  };
  for (const std::uint32_t apart : places(reach.rows))
    if ((row >= apart && differs(*current_, row - apart)) || (row + apart < plan_.settings.rows && differs(*current_, row + apart)))
      return true;
  const std::uint32_t own_column = current_->column();
  for (const std::uint32_t apart : places(reach.columns))
    if ((own_column >= apart && differs(column(own_column - apart), row)) ||
        (own_column + apart < plan_.settings.columns && differs(column(own_column + apart), row)))
      return true;
  return false;
}

// A facet beside it that lies in the same plane, or bends away from it gently, is the same surface to a beam.
bool ColumnTracer::onSameSurface(const MetFacet& surface, const RayLine& line, const NearestHit& hit, double tolerance_m) const {
  if (hit.facet == kNoFacet) return false;
  if (hit.facet == surface.number) return true;
  const double slope = surface.facet.normal.dot(line.direction);
  const double range = (surface.facet.offset - surface.facet.normal.dot(line.origin)) / slope;
  return std::abs(range - static_cast<double>(hit.range_m)) < tolerance_m;
}

// Does the beam meet anything else than its axis?
bool ColumnTracer::probe(const Beam& beam, const NearestHit& axis) {
  traceRays(beam, 0, kProbes);
  if (axis.facet == kNoFacet)
    return std::any_of(sub_hits_, sub_hits_ + kProbes, [](const NearestHit& hit) { return hit.facet != kNoFacet; });
  const MetFacet met = facets_.of(axis.facet);
  const double tolerance = edgeTolerance(plan_.instrument, static_cast<double>(axis.range_m));
  for (int k = 0; k < kProbes; ++k)
    if (!onSameSurface(met, sub_lines_[k], sub_hits_[k], tolerance)) return true;
  return false;
}

void ColumnTracer::traceRays(const Beam& beam, int from, int to) {
  for (int k = from; k < to; ++k) {
    const RayLine& line = sub_lines_[k] = lineOf(beam, subRays()[static_cast<std::size_t>(k)], plan_.instrument);
    const int lane = k - from;
    sub_rays_.origin_x[lane] = static_cast<float>(line.origin.x());
    sub_rays_.origin_y[lane] = static_cast<float>(line.origin.y());
    sub_rays_.origin_z[lane] = static_cast<float>(line.origin.z());
    sub_rays_.direction_x[lane] = static_cast<float>(line.direction.x());
    sub_rays_.direction_y[lane] = static_cast<float>(line.direction.y());
    sub_rays_.direction_z[lane] = static_cast<float>(line.direction.z());
  }
  plan_.scene.intersect(sub_rays_, to - from, static_cast<float>(plan_.farthest_m), sub_hits_ + from);
}

void ColumnTracer::gatherEnds(const Beam& beam, const NearestHit& axis, bool edge) {
  ends_.clear();
  if (axis.facet != kNoFacet) paths_.follow(beam.origin, beam.direction, axis, edge ? kAxisWeight : 1, ends_);
  if (!edge) return;
  traceRays(beam, kProbes, kSubRays);
  for (int k = 0; k < kSubRays; ++k)
    if (sub_hits_[k].facet != kNoFacet)
      paths_.follow(sub_lines_[k].origin, sub_lines_[k].direction, sub_hits_[k], subRays()[static_cast<std::size_t>(k)].weight, ends_);
}

void ColumnTracer::addSurface(std::uint32_t row, const RayLine& axis, const NearestHit& hit, const MetFacet& met) {
  const double range = rangeOnPlane(met.facet, axis.origin, axis.direction, hit.range_m);
  if (!plan_.reports(range)) return;
  Target& target = targets_.emplace_back();
  target.row = row;
  target.range_m = target.end.path_m = range;
  target.end.cosine = static_cast<float>(std::min(1.0, std::abs(met.facet.normal.dot(axis.direction))));
  target.end.place = (axis.origin + range * axis.direction).cast<float>();
  target.end.optics = met.optics;
  if (plan_.daylight) target.end.normal = (met.facet.normal * (met.facet.normal.dot(axis.direction) < 0 ? 1 : -1)).cast<float>();
  if (plan_.unambiguous_m > 0 && range >= plan_.unambiguous_m) target.flags = point_flag::kMirrored;
  target.end.product = met.facet.product, target.end.surface = met.facet.surface, target.end.material = met.material;
}

// What the beam's wings find of retroreflectors.
void ColumnTracer::gatherWings(const Beam& beam) {
  const std::size_t before = ends_.size();
  const auto share = static_cast<float>(plan_.instrument.saturation.pedestal);
  for (const SubRay& ray : wingRays()) {
    const RayLine line = lineOf(beam, ray, plan_.instrument);
    const NearestHit hit = plan_.scene.nearest(line.origin, line.direction, 0, plan_.farthest_m);
    if (hit.facet != kNoFacet && facets_.of(hit.facet).optics->retro_gain > 0)
      paths_.follow(line.origin, line.direction, hit, share * ray.weight, ends_);
  }
  for (std::size_t i = before; i < ends_.size(); ++i) ends_[i].flags |= point_flag::kMirrored;
}

// Does another instrument's light come in while this pulse is listened for?
bool ColumnTracer::struck(std::uint32_t row) const {
  return uniform(interferenceDraw(plan_.options, current_->column(), row)[0]) < plan_.interference;
}

// What is no surface: the air's return, from before the nearest surface, and another instrument's light.
void ColumnTracer::addStray(std::uint32_t row, const Beam& beam) {
  const double least = detectionThreshold(plan_.settings, 0);
  if (plan_.scatterers) {
    double nearest = plan_.settings.max_range_m;
    for (const PathEnd& end : ends_) nearest = std::min(nearest, end.path_m);
    if (const auto found = plan_.scatterers->strongest(current_->column(), row, nearest, least))
      addSurfaceless(beam, found->range_m, found->x, point_flag::kWeather);
  }
  if (plan_.interference <= 0 || !struck(row)) return;
  // At any time of the listening window, as strong as it may be: the power of a source at an unknown distance is above the
  // threshold by a factor f with the chance 1/f.
  const auto draw = interferenceDraw(plan_.options, current_->column(), row);
  const double range = plan_.instrument.min_range_m + uniform(draw[1]) * (plan_.settings.max_range_m - plan_.instrument.min_range_m);
  addSurfaceless(beam, range, least / std::max(1e-3, uniform(draw[2])), point_flag::kNoise);
}

void ColumnTracer::addSurfaceless(const Beam& beam, double range_m, double x, std::uint8_t flag) {
  static const Optics kNothing;
  PathEnd& end = ends_.emplace_back();
  end.path_m = range_m;
  end.flags = flag;
  end.place = (beam.origin + range_m * beam.direction).cast<float>();
  end.optics = &kNothing;
  end.product = plan_.nothingLabel(), end.surface = kNoSurface, end.material = plan_.unassignedLabel();
  end.known_x = static_cast<float>(x);
}

float ColumnTracer::powerOf(const PathEnd& end) const {
  if (end.known_x >= 0) return end.known_x;
  const auto range = static_cast<float>(end.path_m);
  const float near = plan_.options.effects.has(Effect::near_range) ? nearRangeFactor(plan_.instrument, range) : 1;
  const float air = portable::exp2(std::max(-100.0F, plan_.receiver.decay_per_m * range));
  return lambertEquivalent(*end.optics, end.cosine) * end.gain * near * air / (range * range);
}

void ColumnTracer::addEchoes(std::uint32_t row) {
  contributions_.clear();
  for (const PathEnd& end : ends_) contributions_.push_back({end.path_m + end.excess_m, powerOf(end)});
  receiveEchoes(plan_.instrument.waveform, contributions_, order_, echoes_);
  for (const Echo& echo : echoes_) {
    const PathEnd& end = ends_[static_cast<std::size_t>(echo.strongest)];
    if (!plan_.reports(echo.range_m)) continue;
    Target& target = targets_.emplace_back();
    target.row = row;
    target.range_m = echo.range_m;
    target.known_x = echo.x;
    target.end = end;
    target.flags = end.flags;
    target.deviation_m = echo.deviation_m;
    if (plan_.unambiguous_m > 0 && echo.range_m >= plan_.unambiguous_m) target.flags |= point_flag::kMirrored;
    if (static_cast<double>(echo.spread_m) > edgeTolerance(plan_.instrument, end.path_m)) target.flags |= point_flag::kMixed;
  }
}

// By row, not by target: a pulse's numbers are its own.
void ColumnTracer::drawNoise(std::uint32_t first_row, std::size_t first_target) {
  const RandomKey key{plan_.options.seed, plan_.options.station_key};
  pulseNoise(key, current_->column(), first_row, NoiseChannel::pulse, noise_);
  std::uint32_t further = 0;
  for (std::size_t i = first_target; i < targets_.size(); ++i) {
    Target& target = targets_[i];
    const std::uint32_t lane = target.row - first_row;
    further = i > first_target && targets_[i - 1].row == target.row ? further + 1 : 0;
    PulseNoise own;
    if (further > 0) pulseNoise(key, current_->column(), first_row, static_cast<NoiseChannel>(kFurtherReturns + further), own);
    const PulseNoise& noise = further > 0 ? own : noise_;
    target.range_noise = noise.range[lane];
    target.lateral = noise.lateral[lane];
    target.elevation = noise.elevation[lane];
    target.detection = noise.detection[lane];
  }
}

// Sixteen at a time, the returns of a pulse together.
void ColumnTracer::receiveAll(PointBlock& block) {
  for (std::size_t first = 0; first < targets_.size();) {
    std::size_t end = std::min(targets_.size(), first + kSignalLanes);
    while (end < targets_.size() && targets_[end].row == targets_[end - 1].row && targets_[first].row != targets_[end].row) --end;
    receiveSome(first, static_cast<int>(end - first), block);
    first = end;
  }
  targets_.clear();
}

void ColumnTracer::receiveSome(std::size_t first, int count, PointBlock& block) {
  for (int k = 0; k < count; ++k) {
    const Target& target = targets_[first + static_cast<std::size_t>(k)];
    const Optics& optics = *target.end.optics;
    signal_.range_m[k] = static_cast<float>(target.end.path_m);
    signal_.cosine[k] = target.end.cosine;
    signal_.diffuse[k] = optics.diffuse;
    signal_.oren_a[k] = optics.oren_a;
    signal_.oren_b[k] = optics.oren_b;
    signal_.glint[k] = optics.glint;
    signal_.steepness[k] = optics.steepness;
    signal_.gain[k] = target.end.gain;
    signal_.known_x[k] = target.known_x;
    signal_.fluctuation[k] = target.detection;
  }
  if (plan_.varies) varySurfaces(first, count);
  if (plan_.daylight) light(first, count);
  receive(signal_, plan_.receiver);
  int found[kSignalLanes];
  int returns = 0;
  for (int k = 0; k < count; ++k) {
    Target& target = targets_[first + static_cast<std::size_t>(k)];
    if (!detected(target, k) || faulted(target, signal_.x[k], plan_.drops)) continue;
    if (faulted(target, signal_.x[k], plan_.flags)) target.flags |= point_flag::kFiltered;
    found[returns++] = k;
  }
  const std::size_t first_point = block.size();
  grow(block, first_point + static_cast<std::size_t>(returns));
  for (int i = 0; i < returns; ++i) {
    Target& target = targets_[first + static_cast<std::size_t>(found[i])];
    const auto sameRow = [&](int other) { return targets_[first + static_cast<std::size_t>(found[other])].row == target.row; };
    int from = i, to = i + 1;
    while (from > 0 && sameRow(from - 1)) --from;
    while (to < returns && sameRow(to)) ++to;
    target.return_number = static_cast<std::uint8_t>(i - from + 1);
    target.return_count = static_cast<std::uint8_t>(to - from);
    write(target, found[i], first_point + static_cast<std::size_t>(i), block);
  }
}

void ColumnTracer::varySurfaces(std::size_t first, int count) {
  float x[kTextureLanes] = {}, y[kTextureLanes] = {}, z[kTextureLanes] = {}, coefficient[kTextureLanes] = {}, scale[kTextureLanes] = {};
  for (int k = 0; k < count; ++k) {
    const PathEnd& end = targets_[first + static_cast<std::size_t>(k)].end;
    x[k] = end.place.x(), y[k] = end.place.y(), z[k] = end.place.z();
    coefficient[k] = end.optics->variation;
    scale[k] = end.optics->texture_scale_m;
  }
  variation(x, y, z, coefficient, scale, signal_.variation);
}

// Daylight on what the returns come from, and in the beam's direction; shadows by rays towards the sun.
void ColumnTracer::light(std::size_t first, int count) {
  RayPacket rays{};
  NearestHit shade[kPacket];
  const Eigen::Vector3f sun = plan_.daylight->towards().cast<float>();
  constexpr float kOff_m = 0.002F;
  for (int k = 0; k < count; ++k) {
    const PathEnd& end = targets_[first + static_cast<std::size_t>(k)].end;
    const Eigen::Vector3f from = end.place + kOff_m * end.normal;
    rays.origin_x[k] = from.x(), rays.origin_y[k] = from.y(), rays.origin_z[k] = from.z();
    rays.direction_x[k] = sun.x(), rays.direction_y[k] = sun.y(), rays.direction_z[k] = sun.z();
  }
  plan_.scene.intersect(rays, count, std::numeric_limits<float>::infinity(), shade);
  for (int k = 0; k < count; ++k) {
    const Target& target = targets_[first + static_cast<std::size_t>(k)];
    Eigen::Vector3d direction = plan_.cosine[target.row] * ahead_;
    direction.z() = plan_.sine[target.row];
    signal_.background[k] = plan_.daylight->ofDirection(start_.rotation * direction);
    const bool lit = shade[k].facet == kNoFacet || plan_.passes(*facets_.of(shade[k].facet).optics);
    if (lit) signal_.background[k] += plan_.daylight->ofSurface(target.end.optics->diffuse, target.end.normal);
  }
}

// P_d = ½ erfc((x_min - x) / √2 σ), drawn (§2.7). In daylight the threshold keeps its distance to the noise.
bool ColumnTracer::detected(const Target& target, int lane) const {
  const double chance = plan_.softness > 0 ? plan_.softness * static_cast<double>(target.detection) : 0;
  const double noise = plan_.daylight ? std::sqrt(1 + static_cast<double>(signal_.background[lane])) : 1;
  return static_cast<double>(signal_.x[lane]) + noise * chance >= noise * plan_.threshold;
}

bool ColumnTracer::faulted(const Target& target, float x, const PointFilters& filters) const {
  if (filters.deviation_m > 0 && static_cast<double>(target.deviation_m) > filters.deviation_m) return true;
  if (filters.weak_factor > 0 && static_cast<double>(x) < filters.weak_factor * plan_.threshold) return true;
  return filters.overload && x > plan_.saturation;
}

// Where the instrument believes the target to be, in its own frame at the start of the scan.
Eigen::Vector3d ColumnTracer::place(const Target& target, float x, float sigma_m) const {
  const double cosine = plan_.cosine[target.row], sine = plan_.sine[target.row];
  Eigen::Vector3d direction = cosine * ahead_;
  direction.z() = sine;
  double lateral = plan_.jitter_rad * static_cast<double>(target.lateral) + plan_.errors.faceLateral_rad(face_, sine) + azimuth_error_ * cosine;
  double lift = plan_.jitter_rad * static_cast<double>(target.elevation) + plan_.errors.elevationError_rad(face_, sine, cosine);
  double noise = plan_.white_share * static_cast<double>(target.range_noise), extra = 0;
  if (plan_.column_noise) {
    const CorrelatedNoise& figures = plan_.instrument.correlated;
    const ColumnNoise::Column& column = plan_.column_noise->column(current_->column());
    const auto wobble = static_cast<double>(wobble_[target.row % kPacket]);
    noise += static_cast<double>(plan_.column_noise->along() * along_[target.row] + plan_.column_noise->common() * column.common);
    extra = figures.column_extra_m * static_cast<double>(column.extra) + figures.wobble_m * wobble;
    lateral += static_cast<double>(column.azimuth_rad) * cosine;
    lift += figures.elevation_wobble_rad * wobble;
  }
  // To first order, which at 60 arcsec and 100 m is right to 4 µm.
  direction += lateral * lateral_ - (lift * sine) * ahead_;
  direction.z() += lift * cosine;
  double range = plan_.errors.range_m(target.range_m, sine) + plan_.noise_scale * static_cast<double>(sigma_m) * noise + extra;
  if (x > plan_.saturation) range += plan_.instrument.saturation.walk_m_per_decade * static_cast<double>(portable::log2(x / plan_.saturation)) * std::numbers::ln2 / std::numbers::ln10;
  const Eigen::Vector3d point = plan_.folded(range) * direction;
  if (!plan_.moves()) return point;
  return relative(start_, at(plan_.trajectory, plan_.clock.time_s(current_->column(), plan_.elevation_rad(target.row)))) * point;
}

void ColumnTracer::grow(PointBlock& block, std::size_t size) const {
  for (auto* column : {&block.x_m, &block.y_m, &block.z_m, &block.intensity}) column->resize(size);
  for (auto* column : {&block.row, &block.column, &block.product, &block.material}) column->resize(size);
  if (plan_.settings.imaging)
    for (auto* column : {&block.red, &block.green, &block.blue}) column->resize(size);
  const ScanChannels& channels = plan_.options.channels;
  if (channels.time) block.time_s.resize(size);
  if (channels.returns)
    for (auto* column : {&block.return_number, &block.return_count}) column->resize(size);
  if (!channels.truth) return;
  PointTruth& truth = block.truth;
  for (auto* column : {&truth.x_m, &truth.y_m, &truth.z_m, &truth.range_m, &truth.incidence_rad, &truth.received_db}) column->resize(size);
  truth.flags.resize(size);
}

void ColumnTracer::write(const Target& target, int lane, std::size_t i, PointBlock& block) const {
  const Eigen::Vector3d point = place(target, signal_.x[lane], signal_.sigma_m[lane]);
  block.x_m[i] = static_cast<float>(point.x());
  block.y_m[i] = static_cast<float>(point.y());
  block.z_m[i] = static_cast<float>(point.z());
  block.intensity[i] = signal_.intensity[lane];
  block.row[i] = target.row;
  block.column[i] = current_->column();
  block.product[i] = target.end.product;
  block.material[i] = target.end.material;
  if (plan_.settings.imaging) {
    const auto& colour = target.end.surface == kNoSurface ? kWhite : plan_.colours[target.end.surface];
    block.red[i] = colour[0], block.green[i] = colour[1], block.blue[i] = colour[2];
  }
  const ScanChannels& channels = plan_.options.channels;
  if (channels.time) block.time_s[i] = plan_.clock.time_s(current_->column(), plan_.elevation_rad(target.row));
  if (channels.returns) block.return_number[i] = target.return_number, block.return_count[i] = target.return_count;
  if (channels.truth) writeTruth(target, lane, i, block.truth);
}

void ColumnTracer::writeTruth(const Target& target, int lane, std::size_t i, PointTruth& truth) const {
  const Eigen::Vector3d place = start_.rotation.conjugate() * (target.end.place.cast<double>() - start_.translation);
  truth.x_m[i] = static_cast<float>(place.x());
  truth.y_m[i] = static_cast<float>(place.y());
  truth.z_m[i] = static_cast<float>(place.z());
  truth.range_m[i] = static_cast<float>(target.end.path_m);
  const double cosine = std::min(1.0, static_cast<double>(target.end.cosine));
  truth.incidence_rad[i] = static_cast<float>(2 * std::numbers::pi * portable::turnOf(std::sqrt(1 - cosine * cosine), cosine));
  truth.received_db[i] = 3.0102999566398120F * portable::log2(signal_.x[lane]);
  truth.flags[i] = static_cast<std::uint8_t>(target.flags | (signal_.x[lane] > plan_.saturation ? point_flag::kSaturated : 0));
}

}  // namespace standpoint
