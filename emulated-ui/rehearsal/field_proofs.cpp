// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/field_proofs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include <Eigen/Dense>

#include "core/units.h"
#include "emulated-ui/device/numbers.h"
#include "emulated-ui/rehearsal/all_setups.h"
#include "emulated-ui/sighting.h"
#include "scanners/forecast/expectation.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr double kWrong_m = 0.5, kWrong_deg = 5;  // instrument facts 3.3, M18

// The device takes the link: where it asks first, the answer was not no.
bool accepted(const Device& device, const StoredSetup& setup) {
  if (!setup.link || !setup.link->joined) return false;
  const auto registration = device.value("registration." + setup.file);
  return registration != "rejected" && registration != "failed" && registration != "check";
}

std::optional<Fact> wrongLinks(const Device& device) {
  std::optional<double> n;
  for (const auto* s : allSetups(device))
    if (accepted(device, *s))
      n = n.value_or(0) + (s->link->true_error_m > kWrong_m || s->link->true_error_deg > kWrong_deg ? 1 : 0);
  return factOf(n);
}

// Where the chain of links puts the newest setup, against where it stands: each link's error moves all that come after.
std::optional<Fact> closure(const Device& device, const Document& document) {
  Pose moved;
  std::map<std::string, Pose> moved_of;  // by file: not every setup joins the one before
  const StoredSetup* last = nullptr;
  for (const auto* s : allSetups(device)) {
    if (!accepted(device, *s)) continue;
    const auto joined = moved_of.find(s->link->to);
    if (joined != moved_of.end()) moved = joined->second;
    moved = s->link->error * moved;
    moved_of[s->file] = moved;
    last = s;
  }
  if (last == nullptr) return std::nullopt;
  for (const auto& station : document.job->stations)
    if (station.name == last->station)
      return numberFact((moved * station.true_pose.translation - station.true_pose.translation).norm() * 1000);
  return std::nullopt;
}

const Target* targetOf(const Document& document, const std::string& name) {
  if (!document.job) return nullptr;
  for (const auto& t : document.job->targets)
    if (t.name == name) return &t;
  return nullptr;
}

template <class Take>
void eachDistance(const StoredSetup& setup, Take take) {
  const auto& t = setup.targets;
  for (std::size_t a = 0; a < t.size(); ++a)
    for (std::size_t b = a + 1; b < t.size(); ++b)
      if (t[a].found && t[b].found) take(t[a], t[b], (t[a].centre_m - t[b].centre_m).norm());
}

std::optional<Fact> worstDistance(const Device& device, const Document& document) {
  std::optional<double> worst;
  for (const auto* s : allSetups(device))
    eachDistance(*s, [&](const FittedTarget& a, const FittedTarget& b, double measured) {
      const auto *first = targetOf(document, a.name), *second = targetOf(document, b.name);
      if (first != nullptr && second != nullptr)
        worst = std::max(worst.value_or(0), std::abs(measured - (first->centre - second->centre).norm()) * 1000);
    });
  return factOf(worst);
}

// Of the distance between two targets over all setups that measured both: largest less smallest.
std::optional<Fact> repeatSpread(const Device& device) {
  std::map<std::pair<std::string, std::string>, std::pair<double, double>> seen;
  std::optional<double> worst;
  for (const auto* s : allSetups(device))
    eachDistance(*s, [&](const FittedTarget& a, const FittedTarget& b, double d) {
      const auto [row, first] = seen.try_emplace(std::minmax(a.name, b.name), d, d);
      if (!first) row->second = {std::min(row->second.first, d), std::max(row->second.second, d)};
      if (!first) worst = std::max(worst.value_or(0), (row->second.second - row->second.first) * 1000);
    });
  return factOf(worst);
}

double fewestRepeats(const Device& device) {
  std::map<std::string, double> at;
  for (const auto* s : allSetups(device)) at[s->station] += 1;
  double least = at.empty() ? 0 : 1e9;
  for (const auto& [station, n] : at) least = std::min(least, n);
  return least;
}
double places(const Device& device) {
  std::map<std::string, int> at;
  for (const auto* s : allSetups(device)) at[s->station] += 1;
  return static_cast<double>(at.size());
}

// Of the directions that targets cover, seen from the instrument: a full turn less the widest gap.
double covered_deg(std::vector<double> azimuth_deg) {
  if (azimuth_deg.size() < 2) return 0;
  std::sort(azimuth_deg.begin(), azimuth_deg.end());
  double gap = azimuth_deg.front() + 360 - azimuth_deg.back();
  for (std::size_t i = 1; i < azimuth_deg.size(); ++i) gap = std::max(gap, azimuth_deg[i] - azimuth_deg[i - 1]);
  return 360 - gap;
}

double azimuthOf(const Vector3d& p) { return std::atan2(p.y(), p.x()) / kRadPerDeg; }

struct Tied {
  double targets = 0, residual_mm = 0, spread_deg = 0, error_mm = 0;
};

// The newest setup is turned and shifted onto the known coordinates of its targets.
Tied tied(const Device& device, const Document& document) {
  Tied result;
  const auto* setup = device.newestSetup();
  if (setup == nullptr) return result;
  std::vector<Vector3d> from, to;
  std::vector<double> azimuth_deg;
  for (const auto& t : setup->targets) {
    const auto* known = targetOf(document, t.name);
    if (!t.found || known == nullptr) continue;
    from.push_back(t.centre_m);
    to.push_back(known->centre);
    azimuth_deg.push_back(azimuthOf(t.centre_m));
  }
  result.targets = static_cast<double>(from.size());
  result.spread_deg = covered_deg(std::move(azimuth_deg));
  if (from.size() < 3) return result;
  Eigen::Matrix3Xd a(3, from.size()), b(3, from.size());
  for (std::size_t i = 0; i < from.size(); ++i)
    a.col(static_cast<Eigen::Index>(i)) = from[i], b.col(static_cast<Eigen::Index>(i)) = to[i];
  const Eigen::Affine3d fit(Eigen::umeyama(a, b, false));
  for (std::size_t i = 0; i < from.size(); ++i)
    result.residual_mm = std::max(result.residual_mm, (fit * from[i] - to[i]).norm() * 1000);
  for (const auto& station : document.job->stations)
    if (station.name == setup->station)
      result.error_mm = (fit.translation() - station.true_pose.translation).norm() * 1000;
  return result;
}

// Sights under the name of a known target, whose distances to the other such sights are those of the known places: a
// name that was given to the wrong target spoils them.
std::optional<Fact> worstSight(const Device& device, const Document& document) {
  std::optional<double> worst;
  const auto& sighted = device.state().sighted;
  for (const auto& a : sighted)
    for (const auto& b : sighted) {
      const auto *first = targetOf(document, a.id), *second = targetOf(document, b.id);
      if (first == nullptr || second == nullptr || first == second) continue;
      worst = std::max(worst.value_or(0),
                       std::abs((a.place_m - b.place_m).norm() - (first->centre - second->centre).norm()) * 1000);
    }
  return factOf(worst);
}

double namedSights(const Device& device, const Document& document) {
  const auto& sighted = device.state().sighted;
  return static_cast<double>(std::count_if(
      sighted.begin(), sighted.end(), [&](const SightedTarget& s) { return targetOf(document, s.id) != nullptr; }));
}

double sightSpread(const Device& device) {
  std::vector<double> azimuths;
  for (const auto& s : device.state().sighted)
    if (s.used) azimuths.push_back(azimuthOf(s.place_m));
  return covered_deg(std::move(azimuths));
}

std::optional<Fact> worstSightResidual(const Device& device) {
  if (device.state().sighted.empty()) return std::nullopt;
  double worst = 0;
  for (const auto& s : device.state().sighted) worst = std::max(worst, s.residual_m * 1000);
  return numberFact(worst);
}

// Of the station set-up that was solved and not yet accepted, else of the one that was accepted last, as it was then.
std::optional<PlaceError> orientationError(const Device& device, const Document& document) {
  const auto &solved = device.state().orientation, &accepted = device.state().accepted;
  const auto& judged = solved && !solved->accepted ? solved : accepted;
  if (!judged || judged->local) return std::nullopt;
  if (judged->error) return judged->error;
  const auto* station = stationOf(document, judged->station);
  return station == nullptr ? std::nullopt : std::optional(errorOf(judged->pose, station->true_pose));
}

std::optional<Fact> orientationProof(const std::string& name, const Device& device, const Document& document) {
  const auto error = orientationError(device, document);
  if (!error) return std::nullopt;
  if (name == "orientation.plan") return numberFact(error->plan_m * 1000);
  if (name == "orientation.height") return numberFact(error->height_m * 1000);
  if (name == "orientation.azimuth") return numberFact(error->turn_rad / kRadPerDeg);
  return numberFact(std::hypot(error->plan_m, error->height_m) * 1000);
}

// The part of the floor below the instrument that its lowest beams do not reach.
double disc_m(const Station& station, const ScanSettings& settings) {
  const double below = -settings.elevation_from_rad;
  return below <= 0 ? 1e4
                    : std::min(1e4, station.instrument_height_m / std::tan(std::min(below, std::numbers::pi / 2)));
}

// Over the stations in place, with the settings as they are: the largest blind disc, and how far their heights differ.
std::optional<Fact> standingProof(const std::string& name, const Device& device, const Document& document) {
  if (!document.job || document.job->stations.empty()) return std::nullopt;
  double disc = 0, low = 1e9, high = -1e9;
  for (const auto& station : document.job->stations) {
    disc = std::max(disc, disc_m(station, device.expected()));
    low = std::min(low, station.instrument_height_m);
    high = std::max(high, station.instrument_height_m);
  }
  return numberFact(name == "stations.disc" ? disc : high - low);
}

// The worst of the stored setups that have their place by a station set-up.
std::optional<Fact> worstPlaced(const Device& device, double PlaceError::*what, double factor) {
  std::optional<double> worst;
  for (const auto* s : allSetups(device))
    if (s->placed) worst = std::max(worst.value_or(0), (*s->placed).*what * factor);
  return factOf(worst);
}

// Of a walk with a handheld scanner, as it was planned: what it would do to the cloud.
struct WalkFigures {
  double length_m = 0, closure_m = 0, stretch_m = 0, speed_m_s = 0, door_speed_m_s = 0;
};
constexpr double kSamePlace_m = 1, kAwayBetween_m = 10, kAtDoor_m = 1.5;
constexpr double kDrift_mm_per_m = 0.3;  // [P] of the way since the last place that was seen before

WalkFigures walked(const WalkedWay& walk, const Exercise& exercise) {
  WalkFigures w;
  if (walk.size() < 2) return w;
  std::vector<double> way = {0};
  double closed_at = 0;  // on the way: up to there the walk is tied to itself
  for (std::size_t i = 1; i < walk.size(); ++i) {
    const double step = std::hypot(walk[i][0] - walk[i - 1][0], walk[i][1] - walk[i - 1][1]);
    const double seconds = std::max(walk[i][2] - walk[i - 1][2], 1e-3);
    w.speed_m_s = std::max(w.speed_m_s, step / seconds);
    way.push_back(way.back() + step);
    for (const auto& [name, place] : exercise.places) {
      if (!name.starts_with("door")) continue;
      const bool at = std::min(std::hypot(walk[i][0] - place[0], walk[i][1] - place[1]),
                               std::hypot(walk[i - 1][0] - place[0], walk[i - 1][1] - place[1])) <= kAtDoor_m;
      if (at) w.door_speed_m_s = std::max(w.door_speed_m_s, step / seconds);
    }
    for (std::size_t k = 0; k < i; ++k)
      if (way[i] - way[k] >= kAwayBetween_m &&
          std::hypot(walk[i][0] - walk[k][0], walk[i][1] - walk[k][1]) <= kSamePlace_m) {
        w.stretch_m = std::max(w.stretch_m, way[i] - closed_at);
        closed_at = way[i];
        break;
      }
  }
  w.length_m = way.back();
  w.stretch_m = std::max(w.stretch_m, way.back() - closed_at);
  w.closure_m = std::hypot(walk.back()[0] - walk.front()[0], walk.back()[1] - walk.front()[1]);
  return w;
}

// How far off the mean place of some samples is: what shakes within a moment is no drift.
double meanError_mm(const WalkResult& result, std::size_t from, std::size_t to) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = from; i < to; ++i)
    sum += Eigen::Vector3d(result.errors[i][2], result.errors[i][3], result.errors[i][4]);
  return 1000 * sum.norm() / static_cast<double>(to - from);
}

constexpr std::size_t kMoment = 4;  // samples: a second

// The largest drift of the solved way where it passes the exercise's check points, each pass by itself; without any, of
// each second.
double measuredDrift_mm(const WalkResult& result, const Exercise& exercise) {
  const auto count = result.errors.size();
  double worst = 0;
  bool checked = false;
  for (const auto& check : exercise.places) {
    if (!check.first.starts_with("check")) continue;
    checked = true;
    const auto& place = check.second;
    const auto is_there = [&](std::size_t i) {
      return i < count && std::hypot(result.errors[i][0] - place[0], result.errors[i][1] - place[1]) <= kSamePlace_m;
    };
    for (std::size_t i = 0; i < count; ++i) {
      if (!is_there(i)) continue;
      std::size_t end = i;
      while (is_there(end)) ++end;
      worst = std::max(worst, meanError_mm(result, i, end));
      i = end;
    }
  }
  if (!checked)
    for (std::size_t i = 0; i + kMoment <= count; ++i) worst = std::max(worst, meanError_mm(result, i, i + kMoment));
  return worst;
}

double endError_mm(const WalkResult& result) {
  const auto count = result.errors.size();
  return count < kMoment ? 0 : meanError_mm(result, count - kMoment, count);
}

constexpr std::string_view kNear = "walk.near.";

// From a place of the exercise to the nearest spot of the way.
std::optional<double> nearest_m(const WalkedWay& walk, const Exercise& exercise, std::string_view place) {
  for (const auto& [name, at] : exercise.places) {
    if (name != place) continue;
    const Eigen::Vector2d p(at[0], at[1]);
    double least = std::numeric_limits<double>::max();
    for (std::size_t i = 1; i < walk.size(); ++i) {
      const Eigen::Vector2d a(walk[i - 1][0], walk[i - 1][1]), leg = Eigen::Vector2d(walk[i][0], walk[i][1]) - a;
      const double length2 = leg.squaredNorm();
      const double fraction = length2 > 0 ? std::clamp((p - a).dot(leg) / length2, 0.0, 1.0) : 0;
      least = std::min(least, (a + fraction * leg - p).norm());
    }
    return least;
  }
  return std::nullopt;
}

struct SigmaAt {
  double range_m = 0, percent = 0;
};
std::optional<SigmaAt> sigmaAt(const std::string& name) {
  constexpr std::string_view kPrefix = "expected.sigma.";
  if (!name.starts_with(kPrefix)) return std::nullopt;
  const auto dot = name.find('.', kPrefix.size());
  if (dot == std::string::npos) return std::nullopt;
  const auto range = numberIn(std::string_view(name).substr(kPrefix.size(), dot - kPrefix.size()));
  const auto percent = numberIn(std::string_view(name).substr(dot + 1));
  if (!range || !percent || *range <= 0 || *range > 10000 || *percent <= 0 || *percent > 100) return std::nullopt;
  return SigmaAt{*range, *percent};
}

// "expected.reach.10": 10 percent.
std::optional<double> reachOf(const std::string& name) {
  constexpr std::string_view kPrefix = "expected.reach.";
  if (!name.starts_with(kPrefix)) return std::nullopt;
  const auto percent = numberIn(std::string_view(name).substr(kPrefix.size()));
  return percent && *percent > 0 && *percent <= 100 ? percent : std::nullopt;
}

// The range at which every other pulse still comes back.
double reach_m(const Device& device, double percent) {
  Optics surface;
  surface.diffuse = static_cast<float>(percent / 100);
  const ReturnLaw law(device.type().instrument, device.expected());
  double near = 0, far = device.expected().max_range_m;
  if (law.of(surface, far, 1).probability >= 0.5) return far;
  for (int i = 0; i < 40; ++i) {
    const double middle = (near + far) / 2;
    (law.of(surface, middle, 1).probability >= 0.5 ? near : far) = middle;
  }
  return near;
}

const std::vector<double>* placeOf(const std::string& name, const Exercise& exercise) {
  if (!name.starts_with("place.")) return nullptr;
  const auto found = exercise.places.find(name.substr(6));
  return found == exercise.places.end() ? nullptr : &found->second;
}

}  // namespace

const std::vector<ProofRow>& fieldProofRows() {
  static const std::vector<ProofRow> rows = {
      {"links.closure", "mm", numbers(0, 1e7), "position error of the newest setup along the chain of links"},
      {"links.wrong", "", numbers(0, 1e4), "accepted links with a true error over 0.5 m or 5°"},
      {"targets.distances", "mm", numbers(0, 1e6), "largest error of the distance between two fitted centres"},
      {"control.targets", "", numbers(0, 1e4), "targets with known coordinates in the newest setup"},
      {"control.spread", "°", numbers(0, 360), "angle covered by the targets, seen from the newest setup"},
      {"control.residual", "mm", numbers(0, 1e6), "largest residual after fitting the newest setup to them"},
      {"control.error", "mm", numbers(0, 1e6), "resulting position error of the newest setup"},
      {"sights.named", "", numbers(0, 1e4), "targets measured from this station under a known name"},
      {"sights.distances", "mm", numbers(0, 1e7), "largest error of the distance between them"},
      {"sights.residual", "mm", numbers(0, 1e6), "largest residual of their fits"},
      {"sights.spread", "°", numbers(0, 360), "angle covered by the targets in use"},
      {"orientation.error", "mm", numbers(0, 1e7), "position error of the station set-up, as accepted last"},
      {"orientation.plan", "mm", numbers(0, 1e9), "its horizontal position error"},
      {"orientation.height", "mm", numbers(0, 1e9), "its height error"},
      {"orientation.azimuth", "°", numbers(0, 180), "error of its direction"},
      {"stations.disc", "m", numbers(0, 1e4),
       "largest radius of floor below a station that the lowest beams do not reach"},
      {"stations.heights", "m", numbers(0, 100), "difference between the highest and the lowest instrument"},
      {"setups.plan", "mm", numbers(0, 1e9), "largest horizontal error of a stored setup's place in its file"},
      {"setups.height", "mm", numbers(0, 1e9), "largest height error of a stored setup's place in its file"},
      {"setups.azimuth", "°", numbers(0, 180), "largest error of a stored setup's direction in its file"},
      {"repeats.least", "", numbers(0, 1e4), "lowest number of setups at any station"},
      {"repeats.places", "", numbers(0, 1e4), "stations with scans"},
      {"repeats.spread", "mm", numbers(0, 1e6), "largest spread of a target distance over the repeats"},
  };
  return rows;
}

const std::vector<ProofRow>& walkProofRows() {
  static const std::vector<ProofRow> rows = {
      {"walk.length", "m", numbers(0, 1e6), "length of the path: as it was walked, else as it was planned"},
      {"walk.closure", "m", numbers(0, 1e6), "gap between start and end"},
      {"walk.stretch", "m", numbers(0, 1e6), "longest stretch without returning within 1 m of the earlier path"},
      {"walk.speed", "m/s", numbers(0, 1e6), "highest speed between two waypoints"},
      {"walk.door_speed", "m/s", numbers(0, 1e6),
       "highest speed on legs that begin or end within 1.5 m of a place whose name begins with door"},
      {"walk.drift", "mm", numbers(0, 1e6),
       "largest mean error of the solved path, at places whose name begins with check if there are any, else of any "
       "second; of a planned path "
       "0.3 mm per metre of the longest stretch, half if it closes"},
      {"walk.end", "mm", numbers(0, 1e6), "error of the solved path at its end"},
      {"walk.closures", "", numbers(0, 1e6), "places that were recognised when the walk was processed"},
      {"walk.held", "", numbers(0, 1e6), "known points and static scans that hold the processed walk"},
  };
  return rows;
}

std::optional<Fact> walkProof(const std::string& name, const Exercise& exercise, const WalkedWay& planned,
                              const Device& device) {
  if (!name.starts_with("walk.")) return std::nullopt;
  const auto* newest = device.newestSetup();
  const auto* result = newest != nullptr && newest->walk ? &*newest->walk : nullptr;
  const auto& recorded = device.state().walk.way;
  const WalkedWay& walk = result != nullptr ? result->way : recorded.size() > 1 ? recorded : planned;
  if (walk.size() < 2) return std::nullopt;
  if (name.starts_with(kNear)) {
    const auto near = nearest_m(walk, exercise, std::string_view(name).substr(kNear.size()));
    return near ? std::optional(numberFact(*near)) : std::nullopt;
  }
  const auto w = walked(walk, exercise);
  if (name == "walk.length") return numberFact(w.length_m);
  if (name == "walk.closure") return numberFact(w.closure_m);
  if (name == "walk.stretch") return numberFact(w.stretch_m);
  if (name == "walk.speed") return numberFact(w.speed_m_s);
  if (name == "walk.door_speed") return numberFact(w.door_speed_m_s);
  if (name == "walk.drift")
    return numberFact(result != nullptr ? measuredDrift_mm(*result, exercise)
                                        : kDrift_mm_per_m * w.stretch_m * (w.closure_m <= kSamePlace_m ? 0.5 : 1));
  if (result == nullptr) return std::nullopt;
  if (name == "walk.end") return numberFact(endError_mm(*result));
  if (name == "walk.closures") return numberFact(static_cast<double>(result->closures));
  if (name == "walk.held") return numberFact(static_cast<double>(result->held));
  return std::nullopt;
}

std::optional<Fact> fieldProof(const std::string& name, const Device& device, const Document& document) {
  if (name == "links.closure") return closure(device, document);
  if (name == "links.wrong") return wrongLinks(device);
  if (name == "targets.distances") return worstDistance(device, document);
  if (name == "control.targets") return numberFact(tied(device, document).targets);
  if (name == "control.spread") return numberFact(tied(device, document).spread_deg);
  if (name == "control.residual" || name == "control.error") {
    const auto t = tied(device, document);
    if (t.targets < 3) return std::nullopt;  // three are needed to lay it
    return numberFact(name == "control.residual" ? t.residual_mm : t.error_mm);
  }
  if (name == "sights.named") return numberFact(namedSights(device, document));
  if (name == "sights.distances") return worstSight(device, document);
  if (name == "sights.residual") return worstSightResidual(device);
  if (name == "sights.spread") return numberFact(sightSpread(device));
  for (const char* of : {"orientation.error", "orientation.plan", "orientation.height", "orientation.azimuth"})
    if (name == of) return orientationProof(name, device, document);
  if (name == "stations.disc" || name == "stations.heights") return standingProof(name, device, document);
  if (name == "setups.plan") return worstPlaced(device, &PlaceError::plan_m, 1000);
  if (name == "setups.height") return worstPlaced(device, &PlaceError::height_m, 1000);
  if (name == "setups.azimuth") return worstPlaced(device, &PlaceError::turn_rad, 1 / kRadPerDeg);
  if (name == "repeats.least") return numberFact(fewestRepeats(device));
  if (name == "repeats.places") return numberFact(places(device));
  if (name == "repeats.spread") return repeatSpread(device);
  return std::nullopt;
}

std::optional<Fact> namedProof(const std::string& name, const Exercise& exercise, const Device& device,
                               const Document& document) {
  if (const auto at = sigmaAt(name)) {
    Optics surface;
    surface.diffuse = static_cast<float>(at->percent / 100);
    return numberFact(ReturnLaw(device.type().instrument, device.expected()).of(surface, at->range_m, 1).sigma_m *
                      1000);
  }
  if (const auto percent = reachOf(name)) return numberFact(reach_m(device, *percent));
  const auto* place = placeOf(name, exercise);
  if (place == nullptr || !document.job) return std::nullopt;
  std::optional<double> nearest;
  for (const auto* s : allSetups(device))
    for (const auto& station : document.job->stations) {
      if (station.name != s->station) continue;
      const Vector3d p = station.true_pose.translation + document.georeference->shift_m;
      const double away = std::hypot(p.x() - (*place)[0], p.y() - (*place)[1]);
      nearest = std::min(nearest.value_or(away), away);
    }
  return nearest ? std::optional(numberFact(*nearest)) : std::nullopt;
}

std::optional<FactDomain> namedProofDomain(const std::string& name, const Exercise& exercise) {
  if (sigmaAt(name) || reachOf(name)) return numbers(0, 1e6);
  if (placeOf(name, exercise) != nullptr) return numbers(0, 1e6);
  if (name.starts_with(kNear) && exercise.places.contains(name.substr(kNear.size()))) return numbers(0, 1e6);
  return std::nullopt;
}

}  // namespace standpoint
