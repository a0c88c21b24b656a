// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/targets/target_sight.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/units.h"
#include "survey/instruments.h"
#include "survey/scene/bodies.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr double kEnoughSeen = 0.6;  // of its face: less moves the centre of a checkerboard, and holds a sphere badly

Result<std::optional<ScanSettings>> settingsAt(const Station& station, const SightRequest& request) {
  if (request.instrument.empty() && station.scans.empty()) return std::nullopt;
  const bool asked = !request.instrument.empty();
  TRY_ASSIGN(const auto instrument, instrumentNamed(asked ? request.instrument : station.scans.back().instrument));
  TRY_ASSIGN(auto settings, resolveSettings(instrument, asked ? request.settings : station.scans.back().settings));
  return settings;
}

// Places on the face that looks at the station: rings over the visible cap, or over the plate.
std::vector<Vector3d> facePlaces(const Target& t, const Vector3d& from) {
  const bool sphere = t.kind == TargetKind::sphere;
  const Vector3d axis = sphere ? Vector3d((from - t.centre).normalized()) : t.normal;
  const Vector3d u = axis.unitOrthogonal(), v = axis.cross(u);
  std::vector<Vector3d> places;
  constexpr int kPlaces = 64;
  for (int i = 0; i < kPlaces; ++i) {
    const double azimuth = i * std::numbers::pi * (3 - std::sqrt(5.0));
    const double fraction = 0.9 * std::sqrt((i + 0.5) / kPlaces);
    Vector3d p = t.centre + t.size_m / 2 * fraction * (std::cos(azimuth) * u + std::sin(azimuth) * v);
    if (sphere) p += t.size_m / 2 * std::sqrt(1 - fraction * fraction) * axis;
    places.push_back(p);
  }
  return places;
}

void look(const RayScene& scene, const Target& t, const Vector3d& from, TargetSight& sight) {
  const auto places = facePlaces(t, from);
  for (const auto& place : places) {
    const Vector3d way = place - from;
    const auto hit = scene.intersect(from, way.normalized(), way.norm() - 1e-4);
    if (!hit)
      sight.seen_fraction += 1.0 / static_cast<double>(places.size());
    else if (sight.hidden_by.empty())
      sight.hidden_by = productText(scene.environment().products[hit->product]);
  }
}

std::string whyNot(const TargetSight& s, const Target& t, const TargetRules& rules) {
  if (s.seen_fraction < 1e-9) return "hidden by " + s.hidden_by;
  if (s.seen_fraction < kEnoughSeen)
    return fmt::format("only {:.0f} % visible past {}", s.seen_fraction * 100, s.hidden_by);
  if (t.kind == TargetKind::checkerboard && s.incidence_rad > rules.max_incidence_rad)
    return fmt::format("incidence {:.0f}° exceeds the limit of {:.0f}° for plates", s.incidence_rad / kRadPerDeg,
                       rules.max_incidence_rad / kRadPerDeg);
  if (s.distance_m > s.max_distance_m)
    return fmt::format("distance {:.1f} m exceeds the limit of {:.1f} m", s.distance_m, s.max_distance_m);
  if (s.points && *s.points < rules.min_points)
    return fmt::format("about {:.0f} points on the target, {} required", *s.points, rules.min_points);
  return {};
}

}  // namespace

TargetSight sightFrom(const Station& station, const RayScene& scene, const Target& target, const TargetRules& rules,
                      const std::optional<ScanSettings>& settings) {
  TargetSight s;
  s.station = station.name;
  const Vector3d& from = station.true_pose.translation;
  const Vector3d way = from - target.centre;
  s.distance_m = way.norm();
  if (s.distance_m < target.size_m) {  // a direction to it need not exist
    s.seen_fraction = 1;
    s.why_not = fmt::format("only {:.2f} m from the instrument", s.distance_m);
    return s;
  }
  if (target.kind == TargetKind::checkerboard)
    s.incidence_rad = std::acos(std::clamp(target.normal.dot(way) / s.distance_m, -1.0, 1.0));
  look(scene, target, from, s);
  s.max_distance_m = rules.max_distance_m;
  if (settings) {
    s.points = pointsOn(target, s.distance_m, s.incidence_rad, *settings);
    s.max_distance_m =
        std::min({s.max_distance_m, settings->max_range_m, distanceFor(target, rules.min_points, *settings)});
  }
  s.why_not = whyNot(s, target, rules);
  return s;
}

Result<std::vector<TargetSight>> sightsOf(const Job& job, const RayScene& scene, const Target& target,
                                          const TargetRules& rules, const SightRequest& request) {
  std::vector<TargetSight> sights;
  for (const auto& station : job.stations) {
    TRY_ASSIGN(const auto settings, settingsAt(station, request));
    sights.push_back(sightFrom(station, scene, target, rules, settings));
  }
  return sights;
}

void tell(const Target& target, const std::vector<TargetSight>& sights, Report& report) {
  if (sights.empty()) return;
  const bool hidden =
      std::all_of(sights.begin(), sights.end(), [](const TargetSight& s) { return s.seen_fraction < 1e-9; });
  const auto good = std::count_if(sights.begin(), sights.end(), [](const TargetSight& s) { return s.why_not.empty(); });
  if (hidden)
    report.warn(target.name, "hidden from every station");
  else if (good == 0)
    report.warn(target.name, "no station can measure it");
  for (const auto& s : sights)
    if (!s.why_not.empty() && !hidden)
      report.note(target.name, fmt::format("not measurable from {}: {}", s.station, s.why_not));
}

}  // namespace standpoint
