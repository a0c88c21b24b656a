// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/column_tracer.h"

#include <algorithm>
#include <cmath>

#include "scanners/pane_passage.h"

namespace standpoint {

namespace {

constexpr std::size_t kCacheBits = 11;

std::size_t slot(std::uint64_t facet) { return (facet * 0x9E3779B97F4A7C15ULL) >> (64U - kCacheBits); }

Pose relative(const Pose& from, const Pose& to) {
  const Eigen::Quaterniond back = from.rotation.conjugate();
  return {back * to.rotation, back * (to.translation - from.translation)};
}

}  // namespace

ColumnTracer::ColumnTracer(const ScanPlan& plan) : plan_(plan), cache_(std::size_t{1} << kCacheBits), pose_(at(plan.trajectory, 0)) {
  std::fill_n(packet_.signal.range_m, kSignalLanes, 1.0F);
  std::fill_n(packet_.signal.equivalent, kSignalLanes, 1.0F);
  std::fill_n(packet_.signal.gain, kSignalLanes, 1.0F);
}

std::int32_t ColumnTracer::materialAt(const Facet& facet) const {
  if (plan_.assignment.faces.empty()) return materialOf(plan_.assignment, facet.product, facet.surface);
  return plan_.triangles.materialOf(facet.instance, facet.triangle);
}

const ColumnTracer::Met& ColumnTracer::met(std::uint64_t number) {
  Met& entry = cache_[slot(number)];
  if (entry.number == number) return entry;
  entry.number = number;
  entry.facet = plan_.scene.facet(number);
  const std::int32_t material = materialAt(entry.facet);
  const bool assigned = material >= 0;
  entry.material = assigned ? static_cast<std::uint32_t>(material) : plan_.unassignedLabel();
  entry.optics = &plan_.optics[assigned ? entry.material : entry.material + entry.facet.surface];
  return entry;
}

void ColumnTracer::trace(std::uint32_t column, PointBlock& block) {
  startColumn(column);
  for (std::uint32_t row = 0; row < plan_.settings.rows; row += kPacket) {
    packet_.pulses = static_cast<int>(std::min<std::uint32_t>(kPacket, plan_.settings.rows - row));
    aim(row);
    plan_.scene.intersect(packet_.rays, packet_.pulses, static_cast<float>(plan_.settings.max_range_m), packet_.hits);
    gather();
    if (packet_.targets == 0) continue;
    receiveAll(row);
    emit(row, block);
  }
}

void ColumnTracer::startColumn(std::uint32_t column) {
  column_ = column;
  face_ = plan_.clock.behind(column) ? -1 : 1;
  const double azimuth = plan_.azimuth_rad(column);
  ahead_ = {std::cos(azimuth), -std::sin(azimuth), 0};     // clockwise seen from above
  lateral_ = {-std::sin(azimuth), -std::cos(azimuth), 0};
}

void ColumnTracer::aim(std::uint32_t first_row) {
  Eigen::Vector3d ahead = pose_.rotation * ahead_;
  Eigen::Vector3d up = pose_.rotation * Eigen::Vector3d::UnitZ();
  Eigen::Vector3d origin = pose_.translation;
  for (int k = 0; k < packet_.pulses; ++k) {
    const std::uint32_t row = first_row + static_cast<std::uint32_t>(k);
    if (plan_.moves()) {
      const Pose pose = at(plan_.trajectory, plan_.clock.time_s(column_, plan_.elevation_rad(row)));
      ahead = pose.rotation * ahead_;
      up = pose.rotation * Eigen::Vector3d::UnitZ();
      origin = pose.translation;
    }
    const Eigen::Vector3d direction = plan_.cosine[row] * ahead + plan_.sine[row] * up;
    packet_.beam[k] = {origin, direction};
    packet_.rays.origin_x[k] = static_cast<float>(origin.x());
    packet_.rays.origin_y[k] = static_cast<float>(origin.y());
    packet_.rays.origin_z[k] = static_cast<float>(origin.z());
    packet_.rays.direction_x[k] = static_cast<float>(direction.x());
    packet_.rays.direction_y[k] = static_cast<float>(direction.y());
    packet_.rays.direction_z[k] = static_cast<float>(direction.z());
  }
}

ColumnTracer::Target ColumnTracer::meet(const Beam& beam, double range_m, const Met& met) const {
  Target target;
  target.range_m = range_m;
  target.cosine = static_cast<float>(std::min(1.0, std::abs(met.facet.normal.dot(beam.direction))));
  target.equivalent = lambertEquivalent(*met.optics, target.cosine);
  target.product = met.facet.product;
  target.surface = met.facet.surface;
  target.material = met.material;
  return target;
}

void ColumnTracer::gather() {
  packet_.targets = 0;
  for (int k = 0; k < packet_.pulses; ++k) {
    const NearestHit& hit = packet_.hits[k];
    if (hit.facet == kNoFacet) continue;
    const Beam& beam = packet_.beam[k];
    const Met& surface = met(hit.facet);
    Target& target = packet_.target[packet_.targets];
    target = surface.optics->transparent ? lookThrough(beam, hit)
                                         : meet(beam, rangeOnPlane(surface.facet, beam.origin, beam.direction, hit.range_m), surface);
    target.lane = k;
    if (target.range_m >= plan_.instrument.min_range_m && target.range_m <= plan_.settings.max_range_m) ++packet_.targets;
  }
}

float ColumnTracer::receivedPower(const Target& target) const {
  const auto range = static_cast<float>(target.range_m);
  return target.equivalent * target.gain * nearRangeFactor(plan_.instrument, range) / (range * range);
}

// The stronger of the pane's own return (dirt and glint) and of what lies behind.
ColumnTracer::Target ColumnTracer::lookThrough(const Beam& beam, const NearestHit& first) {
  Target best;
  best.range_m = -1;
  PanePassage passage;
  NearestHit hit = first;
  for (int face = 0; face < kMostPanes && hit.facet != kNoFacet; ++face) {
    const Met& surface = met(hit.facet);
    const double range = rangeOnPlane(surface.facet, beam.origin, beam.direction, hit.range_m);
    const bool front = surface.facet.normal.dot(beam.direction) < 0;
    if (!surface.optics->transparent || !passage.isOtherFace(surface.facet, front, range)) {
      Target target = meet(beam, range, surface);
      target.gain = static_cast<float>(passage.gain());
      target.excess_m = passage.excess_m();
      if (range >= plan_.instrument.min_range_m && (best.range_m < 0 || receivedPower(target) > receivedPower(best))) best = target;
      if (!surface.optics->transparent) break;
      passage.enter(*surface.optics, target.cosine, surface.facet, front, range);
    } else {
      passage.leave();
    }
    hit = plan_.scene.nearest(beam.origin, beam.direction, hit.range_m + kBehindFace_m, plan_.settings.max_range_m);
  }
  return best;
}

void ColumnTracer::receiveAll(std::uint32_t first_row) {
  for (int k = 0; k < packet_.targets; ++k) {
    packet_.signal.range_m[k] = static_cast<float>(packet_.target[k].range_m);
    packet_.signal.equivalent[k] = packet_.target[k].equivalent;
    packet_.signal.gain[k] = packet_.target[k].gain;
  }
  receive(packet_.signal, plan_.instrument, plan_.noise_law);
  // By row, not by target: a pulse's numbers are its own.
  if (!plan_.options.ideal)
    pulseNoise({plan_.options.seed, plan_.options.station_key}, column_, first_row, NoiseChannel::pulse, packet_.noise);
}

// P_d = ½ erfc((x_min - x) / √2 σ), drawn (§2.7).
bool ColumnTracer::detected(int k) const {
  const double chance = plan_.softness > 0 ? plan_.softness * static_cast<double>(packet_.noise.detection[packet_.target[k].lane]) : 0;
  return static_cast<double>(packet_.signal.x[k]) + chance >= plan_.threshold;
}

// Where the instrument believes the target to be, in its own frame at the start of the scan.
Eigen::Vector3d ColumnTracer::place(int k, std::uint32_t row) const {
  const Target& target = packet_.target[k];
  double range = target.range_m + target.excess_m;
  Eigen::Vector3d direction = plan_.cosine[row] * ahead_;
  direction.z() = plan_.sine[row];
  if (!plan_.options.ideal) {
    const double lateral = plan_.jitter_rad * static_cast<double>(packet_.noise.lateral[target.lane]) + face_ * plan_.bias.collimation_rad;
    const double lift = plan_.jitter_rad * static_cast<double>(packet_.noise.elevation[target.lane]) + face_ * plan_.bias.index_rad;
    // To first order, which at 60 arcsec and 100 m is right to 4 µm.
    direction += lateral * lateral_ - (lift * plan_.sine[row]) * ahead_;
    direction.z() += lift * plan_.cosine[row];
    range = range * plan_.bias.scale + plan_.bias.range_m +
            plan_.noise_scale * static_cast<double>(packet_.signal.sigma_m[k] * packet_.noise.range[target.lane]);
  }
  const Eigen::Vector3d point = range * direction;
  if (!plan_.moves()) return point;
  return relative(pose_, at(plan_.trajectory, plan_.clock.time_s(column_, plan_.elevation_rad(row)))) * point;
}

void ColumnTracer::emit(std::uint32_t first_row, PointBlock& block) {
  float x[kPacket], y[kPacket], z[kPacket], intensity[kPacket];
  std::uint32_t rows[kPacket], product[kPacket], material[kPacket];
  std::uint8_t red[kPacket], green[kPacket], blue[kPacket];
  int count = 0;
  for (int k = 0; k < packet_.targets; ++k) {
    if (!detected(k)) continue;
    const Target& target = packet_.target[k];
    rows[count] = first_row + static_cast<std::uint32_t>(target.lane);
    const Eigen::Vector3d point = place(k, rows[count]);
    x[count] = static_cast<float>(point.x());
    y[count] = static_cast<float>(point.y());
    z[count] = static_cast<float>(point.z());
    intensity[count] = packet_.signal.intensity[k];
    product[count] = target.product;
    material[count] = target.material;
    const auto& colour = plan_.colours[target.surface];
    red[count] = colour[0], green[count] = colour[1], blue[count] = colour[2];
    ++count;
  }
  const auto append = [count](auto& column, const auto* values) { column.insert(column.end(), values, values + count); };
  append(block.x_m, x);
  append(block.y_m, y);
  append(block.z_m, z);
  append(block.intensity, intensity);
  append(block.row, rows);
  block.column.insert(block.column.end(), static_cast<std::size_t>(count), column_);
  append(block.product, product);
  append(block.material, material);
  if (!plan_.settings.imaging) return;
  append(block.red, red);
  append(block.green, green);
  append(block.blue, blue);
}

}  // namespace standpoint
