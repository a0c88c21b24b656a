// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/scanning/scan_age.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/random.h"

namespace standpoint {

namespace {

// Nobody moves anything by less; rounding does.
constexpr double kUnmoved_m = 1e-6, kUnturned_rad = 1e-6;

bool standsAsThen(const Pose& a, const Pose& b) {
  return (a.translation - b.translation).norm() < kUnmoved_m && a.rotation.angularDistance(b.rotation) < kUnturned_rad;
}

// Whatever it is called now.
bool sameTarget(const Target& a, const Target& b) {
  return a.kind == b.kind && (a.centre - b.centre).norm() < kUnmoved_m &&
         (a.normal - b.normal).norm() < kUnturned_rad && std::abs(a.size_m - b.size_m) < kUnmoved_m;
}

bool standsIn(const Target& target, const std::vector<Target>& targets) {
  return std::any_of(targets.begin(), targets.end(), [&](const Target& t) { return sameTarget(t, target); });
}

}  // namespace

std::vector<std::string> newerThan(const Scan& scan, const Station& station, const std::vector<Target>& targets) {
  std::vector<std::string> names;
  if (!scan.as_scanned) return names;
  const auto& then = *scan.as_scanned;
  if (!standsAsThen(then.station, station.true_pose)) names.push_back(station.name);
  const auto add = [&](const std::vector<Target>& these, const std::vector<Target>& others) {
    for (const auto& target : these)
      if (!standsIn(target, others) && std::find(names.begin(), names.end(), target.name) == names.end())
        names.push_back(target.name);
  };
  add(targets, then.targets);  // moved or new
  add(then.targets, targets);  // removed
  return names;
}

std::string ageText(const Scan& scan, const Station& station, const std::vector<Target>& targets) {
  const auto names = newerThan(scan, station, targets);
  if (names.empty()) return {};
  if (names.size() == 1) return "older than " + names.front();
  return fmt::format("older than {} and {} more", names.front(), names.size() - 1);
}

std::string ageText(const Station& station, const std::vector<Target>& targets) {
  return station.scans.empty() ? std::string() : ageText(station.scans.back(), station, targets);
}

std::uint64_t wayFingerprint(const CarriedTrajectory& trajectory) {
  std::string text = fmt::format("{} {} {} {} {} {}", trajectory.carrier, trajectory.height_m, trajectory.speed_mps,
                                 trajectory.seed, trajectory.file, trajectory.format);
  for (const Waypoint& w : trajectory.waypoints) {
    text += fmt::format(";{} {} {} {}", w.floor_m.x(), w.floor_m.y(), w.floor_m.z(), w.stop_s);
    if (w.look_rad) text += fmt::format(" {}", *w.look_rad);
  }
  return stableHash(text.c_str());
}

std::string ageText(const Scan& scan, const CarriedTrajectory& trajectory) {
  return scan.along && *scan.along != wayFingerprint(trajectory) ? "older than " + trajectory.name : std::string();
}

}  // namespace standpoint
