// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/reflector_halo.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/portable_math.h"
#include "scanners/engine/scan_plan.h"

namespace standpoint {

namespace {

constexpr int kRings = 4, kOnRing = kWingRays / kRings;
constexpr double kWings = 8;  // radius, in w
constexpr int kOnEdge = 8;    // places that stand for an edge
using std::numbers::pi;

std::array<SubRay, kWingRays> wingPattern() {
  std::array<SubRay, kWingRays> rays{};
  for (int ring = 0; ring < kRings; ++ring)
    for (int k = 0; k < kOnRing; ++k) {
      SubRay& ray = rays[static_cast<std::size_t>(ring * kOnRing + k)];
      float sine, cosine;
      portable::sinCosTurn((static_cast<float>(k) + 0.5F * static_cast<float>(ring % 2)) / kOnRing, sine, cosine);
      const double middle = kWings / kRings * (ring + 0.5);
      // The area of a ring grows with its radius: 1 + 3 + 5 + 7 parts.
      ray = {middle * static_cast<double>(cosine), middle * static_cast<double>(sine),
             static_cast<float>(2 * ring + 1) / (kRings * kRings * kOnRing)};
    }
  return rays;
}

}  // namespace

const std::array<SubRay, kWingRays>& wingRays() {
  static const auto kRays = wingPattern();
  return kRays;
}

ReflectorHalo::ReflectorHalo(const ScanPlan& plan) {
  const auto& materials = plan.assignment.materials;
  if (plan.moves() || plan.instrument.saturation.pedestal <= 0) return;
  if (std::none_of(materials.begin(), materials.end(), [](const PhysicalMaterial& m) { return m.retro_gain > 0; }))
    return;
  const Environment& environment = plan.scene.environment();
  const Pose& pose = plan.start;
  columns_.resize(plan.settings.columns);
  for (std::uint32_t i = 0; i < environment.instances.size(); ++i) {
    const Instance& instance = environment.instances[i];
    if (!environment.products[instance.product].inScene()) continue;
    const Mesh& mesh = *environment.meshes[instance.mesh];
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const std::int32_t material = plan.triangles.materialOf(i, t);
      if (material < 0 || !(materials[static_cast<std::size_t>(material)].retro_gain > 0)) continue;
      std::array<Eigen::Vector3d, 3> corners;
      for (std::size_t k = 0; k < 3; ++k)
        corners[k] =
            pose.rotation.conjugate() *
            (instance.world_from_mesh * mesh.positions[mesh.triangles[t][k]].cast<double>() - pose.translation);
      add(plan, corners);
    }
  }
  mergeRows();
}

// The window of azimuth and elevation about a triangle and as far as the wings reach, to whole pulses; a triangle above
// or below the instrument is in all columns.
void ReflectorHalo::add(const ScanPlan& plan, const std::array<Eigen::Vector3d, 3>& corners) {
  const ScanSettings& s = plan.settings;
  double nearest = corners[0].norm(), low = pi, high = -pi, min_turn = 0, max_turn = 0, steepest = 1;
  const double first = std::atan2(-corners[0].y(), corners[0].x());  // clockwise seen from above
  for (int step = 0; step < 3 * kOnEdge; ++step) {  // an edge rises above its ends as a great circle does
    const auto from = static_cast<std::size_t>(step / kOnEdge);
    const double fraction = static_cast<double>(step % kOnEdge) / kOnEdge;
    const Eigen::Vector3d place = (1 - fraction) * corners[from] + fraction * corners[(from + 1) % 3];
    nearest = std::min(nearest, place.norm());
    const double elevation = std::atan2(place.z(), std::hypot(place.x(), place.y()));
    low = std::min(low, elevation), high = std::max(high, elevation);
    const double turn = std::remainder(std::atan2(-place.y(), place.x()) - first, 2 * pi);
    min_turn = std::min(min_turn, turn), max_turn = std::max(max_turn, turn);
    steepest = std::min(steepest, std::cos(elevation));
  }
  nearest = std::max(nearest, 0.1);
  const double margin = 1.2 * kWings * beamRadius(plan.instrument, nearest) / nearest;
  const auto row = [&](double elevation) {
    return std::clamp((elevation - s.elevation_from_rad) / plan.rowStep_rad(), 0.0, static_cast<double>(s.rows));
  };
  const Rows rows{static_cast<std::uint32_t>(std::floor(row(low - margin))),
                  static_cast<std::uint32_t>(std::ceil(row(high + margin)))};
  if (rows.from >= rows.to) return;
  const double aside = margin / std::max(steepest, 1e-3);
  const bool all = max_turn - min_turn + 2 * aside > pi;
  const auto column = [&](double azimuth) {
    return std::clamp(all ? 0 : (azimuth - s.azimuth_from_rad) / plan.columnStep_rad(), 0.0,
                      static_cast<double>(s.columns));
  };
  for (int turn = -2; turn <= 2; ++turn) {  // the grid begins and ends anywhere within two turns
    const double from = first + 2 * pi * turn + min_turn - aside, to = first + 2 * pi * turn + max_turn + aside;
    const auto end = all ? s.columns : static_cast<std::uint32_t>(std::ceil(column(to)));
    for (auto c = static_cast<std::uint32_t>(std::floor(column(from))); c < end; ++c) columns_[c].push_back(rows);
    if (all) break;
  }
}

// Triangles of one reflector overlap: they are one window.
void ReflectorHalo::mergeRows() {
  for (auto& rows : columns_) {
    std::sort(rows.begin(), rows.end(),
              [](const Rows& a, const Rows& b) { return a.from != b.from ? a.from < b.from : a.to < b.to; });
    std::size_t kept = 0;
    for (std::size_t i = 1; i < rows.size(); ++i) {
      if (rows[i].from <= rows[kept].to)
        rows[kept].to = std::max(rows[kept].to, rows[i].to);
      else
        rows[++kept] = rows[i];
    }
    rows.resize(std::min(rows.size(), kept + 1));
  }
}

}  // namespace standpoint
