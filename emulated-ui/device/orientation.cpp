// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/orientation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/match_places.h"
#include "core/rigid_fit.h"
#include "core/units.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr double kSameDistance_m = 0.02;  // of the resection without names
constexpr double kOnePlace_m = 0.05;      // targets nearer to one another give no direction

struct Pairs {
  std::vector<std::string> ids;
  std::vector<Vector3d> measured, known;
};

const ControlPlace* placeOf(const std::vector<ControlPlace>& places, const std::string& name) {
  const auto found = std::find_if(places.begin(), places.end(), [&](const ControlPlace& p) { return p.name == name; });
  return found == places.end() ? nullptr : &*found;
}

Pairs pairsByName(const OrientationTask& task) {
  Pairs pairs;
  for (const auto& s : task.sighted) {
    const auto* place = s.used ? placeOf(task.known, s.id) : nullptr;
    if (place == nullptr) continue;
    pairs.ids.push_back(s.id);
    pairs.measured.push_back(s.place_m);
    pairs.known.push_back(place->place_m + Vector3d(0, 0, s.height_m));
  }
  return pairs;
}

Pose turned(double heading_rad, const Vector3d& at) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(heading_rad, Vector3d::UnitZ())), at};
}

double headingOf(const Vector3d& v) { return std::atan2(v.y(), v.x()); }

Vector3d mean(const std::vector<Vector3d>& places) {
  Vector3d sum = Vector3d::Zero();
  for (const auto& p : places) sum += p;
  return sum / static_cast<double>(places.size());
}

// Position and the turn about the plumb line.
Result<Pose> fourParameters(const Pairs& pairs) {
  const Vector3d from = mean(pairs.measured), to = mean(pairs.known);
  double along = 0, across = 0, spread = 0;
  for (std::size_t i = 0; i < pairs.ids.size(); ++i) {
    const Vector3d p = pairs.measured[i] - from, q = pairs.known[i] - to;
    along += p.x() * q.x() + p.y() * q.y();
    across += p.x() * q.y() - p.y() * q.x();
    spread = std::max(spread, p.head<2>().norm());
  }
  if (spread < kOnePlace_m) return failure(ErrorKind::usage, "targets_in_one_place");
  Pose pose = turned(std::atan2(across, along), Vector3d::Zero());
  pose.translation = to - pose.rotation * from;
  return pose;
}

Result<Pose> sixParameters(const Pairs& pairs) {
  const auto fit = fitRigid(pairs.measured, pairs.known);
  if (!fit) return failure(ErrorKind::usage, "targets_on_a_line");
  return fit->to_from;
}

// Over a known mark: the first target in use gives the direction.
Result<Pose> overMark(const OrientationTask& task, const Pairs& pairs) {
  if (!task.axis_m) return failure(ErrorKind::usage, "no_known_mark");
  const double azimuth = std::numbers::pi / 2 - task.azimuth_deg * kRadPerDeg;  // counter-clockwise from east
  if (task.method == "quick") return turned(azimuth, *task.axis_m);
  const auto first =
      std::find_if(task.sighted.begin(), task.sighted.end(), [](const SightedTarget& s) { return s.used; });
  if (task.method == "azimuth") return turned(azimuth - headingOf(first->place_m), *task.axis_m);
  return turned(headingOf(pairs.known.front() - *task.axis_m) - headingOf(pairs.measured.front()), *task.axis_m);
}

Result<Pairs> pairsByGeometry(const OrientationTask& task) {
  std::vector<Vector3d> from, to;
  std::vector<const SightedTarget*> used;
  for (const auto& s : task.sighted)
    if (s.used && from.size() < kMostPlacesToMatch)
      from.push_back(s.place_m - Vector3d(0, 0, s.height_m)), used.push_back(&s);
  for (const auto& k : task.known)
    if (to.size() < kMostPlacesToMatch) to.push_back(k.place_m);
  const auto match = matchPlaces(from, to, kSameDistance_m);
  if (!match) return failure(ErrorKind::usage, "targets_not_matched");
  Pairs pairs;
  for (const auto& [f, t] : match->pairs) {
    pairs.ids.push_back(task.known[t].name);
    pairs.measured.push_back(used[f]->place_m);
    pairs.known.push_back(to[t] + Vector3d(0, 0, used[f]->height_m));
  }
  return pairs;
}

Result<Pose> solved(const OrientationTask& task, const Pairs& pairs) {
  if (task.method == "quick" || task.method == "azimuth" || task.method == "backsight") return overMark(task, pairs);
  if (task.method == "resection_4" || task.method == "traverse") return fourParameters(pairs);
  return sixParameters(pairs);
}

}  // namespace

PlaceError errorOf(const Pose& believed, const Pose& truth) {
  const Vector3d off = believed.translation - truth.translation;
  const Eigen::Quaterniond turn = believed.rotation * truth.rotation.conjugate();
  const double about_plumb = 2 * std::atan2(turn.z(), turn.w());
  return {off.head<2>().norm(), std::abs(off.z()), std::abs(std::remainder(about_plumb, 2 * std::numbers::pi))};
}

int targetsNeeded(const std::string& method, bool compensator) {
  if (method == "standard" || method == "quick") return 0;
  if (method == "azimuth" || method == "backsight") return 1;
  if (method == "resection_4" || method == "traverse") return 2;
  return compensator ? 3 : 4;
}

int targetsUsable(const OrientationTask& task) {
  const bool needs_name = task.method != "auto" && task.method != "azimuth";
  return static_cast<int>(std::count_if(task.sighted.begin(), task.sighted.end(), [&](const SightedTarget& s) {
    return s.used && (!needs_name || placeOf(task.known, s.id) != nullptr);
  }));
}

Result<StationOrientation> solveOrientation(const OrientationTask& task) {
  StationOrientation result{task.method, task.station, {}, {}, 0, task.compensator, false, false, false, {}};
  if (task.method == "standard") {
    result.local = true;
    return result;
  }
  if (targetsUsable(task) < targetsNeeded(task.method, task.compensator))
    return failure(ErrorKind::usage, "too_few_targets");
  Result<Pairs> pairs = task.method == "auto" ? pairsByGeometry(task) : pairsByName(task);
  if (!pairs) return failure(pairs.error());
  TRY_ASSIGN(const auto pose, solved(task, *pairs));
  result.pose = pose;
  double sum = 0;
  for (std::size_t i = 0; i < pairs->ids.size(); ++i) {
    const double residual = (pose * pairs->measured[i] - pairs->known[i]).norm();
    result.targets.push_back({pairs->ids[i], residual});
    sum += residual * residual;
  }
  if (!pairs->ids.empty()) result.rms_m = std::sqrt(sum / static_cast<double>(pairs->ids.size()));
  return result;
}

}  // namespace standpoint
