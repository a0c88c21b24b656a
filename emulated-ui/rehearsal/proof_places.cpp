// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/proof_places.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <string_view>

#include "emulated-ui/rehearsal/all_setups.h"
#include "emulated-ui/rehearsal/measured_scan.h"
#include "emulated-ui/rehearsal/part_surface.h"
#include "emulated-ui/sighting.h"
#include "scanners/forecast/surface_samples.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr std::size_t kSurfaceSamples = 200000;
constexpr double kTargetShown_m = 0.25;

struct KindOfFact {
  std::string_view fact;  // one that ends in a dot stands for all that begin so
  ProofKind kind;
  bool one_scan = false;
  std::uint8_t flags = 0;
};
constexpr std::array kKinds = {
    KindOfFact{"data.points", ProofKind::spacing, true},
    KindOfFact{"expected.spacing", ProofKind::spacing, true},
    KindOfFact{"data.noise", ProofKind::scatter, true},
    KindOfFact{"expected.sigma.", ProofKind::scatter, true},
    KindOfFact{"data.tilt", ProofKind::offset, true},
    KindOfFact{"data.error", ProofKind::offset, true},
    KindOfFact{"newest.plan", ProofKind::offset, true},
    KindOfFact{"newest.height", ProofKind::offset, true},
    KindOfFact{"newest.azimuth", ProofKind::offset, true},
    KindOfFact{"orientation.", ProofKind::offset, true},
    KindOfFact{"setups.plan", ProofKind::offset},
    KindOfFact{"setups.height", ProofKind::offset},
    KindOfFact{"setups.azimuth", ProofKind::offset},
    KindOfFact{"links.error", ProofKind::offset},
    KindOfFact{"links.closure", ProofKind::offset},
    KindOfFact{"links.wrong", ProofKind::offset},
    KindOfFact{"links.overlap", ProofKind::offset},
    KindOfFact{"data.moving", ProofKind::stray, true, point_flag::kMoving},
    KindOfFact{"data.mirrored", ProofKind::stray, true, point_flag::kMirrored},
    KindOfFact{"data.weather", ProofKind::stray, true, point_flag::kWeather},
    KindOfFact{"data.mixed", ProofKind::stray, true, point_flag::kMixed},
    KindOfFact{"plan.coverage", ProofKind::hole},
    KindOfFact{"stations.disc", ProofKind::hole},
    KindOfFact{"survey.reached", ProofKind::hole},
    KindOfFact{"survey.coverage", ProofKind::hole},
    KindOfFact{"survey.walls", ProofKind::hole},
    KindOfFact{"targets.points", ProofKind::target},
    KindOfFact{"targets.residual", ProofKind::target},
    KindOfFact{"targets.error", ProofKind::target},
    KindOfFact{"targets.distances", ProofKind::target},
    KindOfFact{"newest.targets", ProofKind::target, true},
    KindOfFact{"newest.sampled", ProofKind::target, true},
    KindOfFact{"newest.residual", ProofKind::target, true},
    KindOfFact{"control.residual", ProofKind::target, true},
    KindOfFact{"repeats.spread", ProofKind::target},
    KindOfFact{"sights.spread", ProofKind::around},
    KindOfFact{"sights.", ProofKind::target},
    KindOfFact{"sight.", ProofKind::target},
    KindOfFact{"targets.", ProofKind::around},
    KindOfFact{"control.", ProofKind::around},
    KindOfFact{"place.", ProofKind::around},
};

const KindOfFact* kindOf(std::string_view fact) {
  const auto found = std::find_if(kKinds.begin(), kKinds.end(), [&](const KindOfFact& row) {
    return row.fact.ends_with('.') ? fact.starts_with(row.fact) : fact == row.fact;
  });
  return found == kKinds.end() ? nullptr : &*found;
}

bool isYes(const std::map<std::string, Fact>& facts, const char* name) {
  const auto found = facts.find(name);
  return found != facts.end() && found->second.text == "yes";
}

// A place of the model on a surface.
struct Spot {
  const SurfaceSample* sample = nullptr;
  const MeasuredScan* scan = nullptr;
  Vector3d normal;  // towards the scan's instrument
  double score = 0, radius_m = 0, offset_m = 0;
};

}  // namespace

class ProofPlaces::Finder {
 public:
  explicit Finder(const Rehearsal& rehearsal)
      : rehearsal_(rehearsal), exercise_(rehearsal.exercise()), document_(rehearsal.document()) {}

  std::optional<ProofPlace> of(const ExerciseRule& rule, const Rehearsal::RuleState& state) {
    if (!document_.imported || !document_.job || rule.shown_at == kNowhere) return std::nullopt;
    for (const auto& [fact, kind] : candidates(rule, state))
      if (auto place = at(rule, state, fact, kind)) return place;
    return std::nullopt;
  }

 private:
  using Candidate = std::pair<std::string, KindOfFact>;

  // What may show it, the likeliest first: what happened to the scan, the proof that its author names, what the
  // condition asks.
  static std::vector<Candidate> candidates(const ExerciseRule& rule, const Rehearsal::RuleState& state) {
    std::vector<Candidate> found;
    if (isYes(state.facts, "newest.partial")) found.push_back({"newest.partial", {"", ProofKind::hole, true}});
    if (isYes(state.facts, "newest.tripod_moved"))
      found.push_back({"newest.tripod_moved", {"", ProofKind::offset, true}});
    if (const auto moved = state.facts.find("setups.tripod_moved");
        moved != state.facts.end() && moved->second.number.value_or(0) > 0)
      found.push_back({"setups.tripod_moved", {"", ProofKind::offset}});
    const auto take = [&](const std::string& fact) {
      if (const auto* kind = kindOf(fact)) found.emplace_back(fact, *kind);
      if (fact.starts_with("part.")) found.push_back({fact, {"", partKind(fact)}});
    };
    if (!rule.proof.empty()) take(rule.proof);
    for (const auto& fact : rule.holds.facts()) take(fact);
    // Of targets, how many points they have says more than what follows from that.
    std::stable_partition(found.begin(), found.end(), [](const Candidate& c) { return isByPoints(c.first); });
    if (found.empty() && !rule.shown_at.empty()) found.push_back({"", {"", ProofKind::around}});
    return found;
  }
  static bool isByPoints(std::string_view fact) {
    return fact == "targets.points" || fact == "newest.sampled" || fact == "sight.points";
  }
  static ProofKind partKind(std::string_view fact) {
    return fact.ends_with(".spacing") || fact.ends_with(".points") ? ProofKind::spacing : ProofKind::hole;
  }

  std::optional<ProofPlace> at(const ExerciseRule& rule, const Rehearsal::RuleState& state, const std::string& fact,
                               const KindOfFact& kind) {
    const auto setups = setupsOf(state, kind.one_scan);
    ProofPlace place{.kind = kind.kind, .flags = kind.flags, .one_scan = kind.one_scan};
    for (const auto* setup : setups) place.scans.push_back(setup->file);
    if (fact == "stations.disc") return blindDisc(place);
    if (fact.starts_with("survey.")) return unplanned(fact == "survey.walls");
    if (place.scans.empty() && (kind.one_scan || allSetups(rehearsal_.device()).empty()))
      return rule.shown_at.empty() && kind.kind != ProofKind::target && kind.kind != ProofKind::around
                 ? std::nullopt
                 : withoutPoints(place, rule, fact);
    if (kind.kind == ProofKind::target) return worstTarget(place, setups, fact);
    if (kind.kind == ProofKind::around) return around(place, rule, fact);
    readModel();
    for (const auto* setup : setups) read(*setup);
    const auto part = partOf(rule, fact);
    if (part.empty() && !rule.shown_at.empty()) return around(place, rule, fact);
    if (kind.kind == ProofKind::stray) return strays(place, setups);
    if (kind.kind == ProofKind::hole) return hole(place, setups, part);
    return onSurface(place, setups, part);
  }

  std::vector<const StoredSetup*> setupsOf(const Rehearsal::RuleState& state, bool one_scan) const {
    const auto all = allSetups(rehearsal_.device());
    if (!one_scan) return all;
    for (const auto* setup : all)
      if (setup->file == state.scan) return {setup};
    return {};
  }

  // The part of the exercise that is meant: by the author, else by the fact "part.NAME.seen".
  std::string partOf(const ExerciseRule& rule, const std::string& fact) const {
    if (!rule.shown_at.empty()) return exercise_.parts.contains(rule.shown_at) ? rule.shown_at : std::string();
    if (!fact.starts_with("part.")) return {};
    return fact.substr(5, fact.rfind('.') - 5);
  }

  void readModel() {
    if (scene_) return;
    Progress quiet;
    const auto scene = RayScene::build(document_.environment(), quiet);
    if (!scene) return;
    scene_ = *scene;
    if (auto samples = sampleSurfaces(*scene_, kSurfaceSamples, 1, quiet)) samples_ = *std::move(samples);
    for (std::uint32_t i = 0; i < samples_.samples.size(); ++i)
      near_[MeasuredScan::cellOf(samples_.samples[i].place.position)].push_back(i);
  }

  const MeasuredScan* read(const StoredSetup& setup) {
    const auto known = scans_.find(setup.file);
    if (known != scans_.end()) return known->second.get();
    auto scan = readMeasured(setup, rehearsal_);
    return scans_.emplace(setup.file, scan ? std::make_unique<MeasuredScan>(*std::move(scan)) : nullptr)
        .first->second.get();
  }

  std::vector<const SurfaceSample*> samplesIn(const std::string& part) const {
    std::vector<const SurfaceSample*> found;
    const auto surface =
        part.empty() ? std::optional<PartSurface>()
                     : PartSurface(exercise_.parts.at(part), *document_.environment(), document_.georeference->shift_m);
    for (const auto& sample : samples_.samples)
      if (surface ? surface->has(sample) : sample.exposed) found.push_back(&sample);
    return found;
  }

  // The flattest place where the points show it best.
  std::optional<ProofPlace> onSurface(ProofPlace place, const std::vector<const StoredSetup*>& setups,
                                      const std::string& part) {
    std::vector<Spot> spots;
    const auto samples = samplesIn(part);
    for (const auto* setup : setups)
      if (const auto* scan = read(*setup))
        for (const auto* sample : samples)
          if (auto spot = rated(place.kind, *sample, *scan)) spots.push_back(*spot);
    std::stable_sort(spots.begin(), spots.end(), [](const Spot& a, const Spot& b) { return a.score > b.score; });
    constexpr std::size_t kMostTried = 20000;
    for (std::size_t i = 0; i < spots.size() && i < kMostTried; ++i) {
      if (!isFlat(spots[i])) continue;
      place.centre_m = spots[i].sample->place.position;
      place.normal = spots[i].normal;
      place.radius_m = spots[i].radius_m;
      place.offset_m = spots[i].offset_m;
      return looked(place, *spots[i].scan, spots[i].sample->product);
    }
    return std::nullopt;
  }

  std::optional<Spot> rated(ProofKind kind, const SurfaceSample& sample, const MeasuredScan& scan) const {
    constexpr double kLeastCosine = 0.5;
    constexpr double kLeastOffset_m = 0.0005;  // less displaces nothing that could be seen
    constexpr double kFewest = 60;             // points in a cell
    const Vector3d& p = sample.place.position;
    const auto* cell = scan.cellAt(p);
    if (cell == nullptr || cell->points < kFewest) return std::nullopt;
    const Vector3d to_eye = scan.truth.translation - p;
    const double range = to_eye.norm();
    Spot spot{&sample, &scan, sample.place.normal};
    if (spot.normal.dot(to_eye) < 0) spot.normal = -spot.normal;
    const double cosine = spot.normal.dot(to_eye) / std::max(range, 1e-6);
    if (cosine < kLeastCosine || !scan.seen.near(p)) return std::nullopt;
    const double spacing_m = MeasuredScan::kCell_m / std::sqrt(cell->points);
    switch (kind) {
      case ProofKind::scatter: {
        const double sigma_m = cell->sigma_m();
        spot.score = sigma_m;
        spot.radius_m = std::clamp(60 * sigma_m, std::max(0.05, 5 * spacing_m), 0.3);
        break;
      }
      case ProofKind::offset:
        spot.offset_m = cell->offset().dot(spot.normal);
        spot.score = std::abs(spot.offset_m);
        if (spot.score < kLeastOffset_m) return std::nullopt;
        spot.radius_m = std::clamp(1.5 * spot.score, std::max(0.1, 8 * spacing_m), 1.0);
        break;
      default: spot.score = range; spot.radius_m = std::clamp(25 * spacing_m, 0.08, 0.4);
    }
    return spot;
  }

  template <class Take>
  void eachNear(const Vector3d& p, double radius_m, Take take) const {
    const Vector3d reach = Vector3d::Constant(radius_m);
    const auto low = MeasuredScan::cellOf(p - reach), high = MeasuredScan::cellOf(p + reach);
    for (auto x = low[0]; x <= high[0]; ++x)
      for (auto y = low[1]; y <= high[1]; ++y)
        for (auto z = low[2]; z <= high[2]; ++z)
          if (const auto cell = near_.find({x, y, z}); cell != near_.end())
            for (const auto i : cell->second)
              if ((samples_.samples[i].place.position - p).norm() <= radius_m) take(samples_.samples[i]);
  }

  // One surface all around, nothing before it, and points on all of it.
  bool isFlat(const Spot& spot) const {
    constexpr double kFlat_m = 0.01, kFull = 0.75, kMostBefore = 0.03;
    const Vector3d& p = spot.sample->place.position;
    const double radius_m = std::max(spot.radius_m, 0.15);
    double flat = 0, seen = 0, before = 0;
    eachNear(p, radius_m, [&](const SurfaceSample& other) {
      const double height_m = spot.normal.dot(other.place.position - p);
      if (std::abs(height_m) < kFlat_m && std::abs(spot.normal.dot(other.place.normal)) > 0.99) {
        flat += 1;
        seen += spot.scan->seen.near(other.place.position) ? 1 : 0;
      } else if (height_m >= kFlat_m && other.exposed) {
        before += 1;
      }
    });
    const double expected = std::numbers::pi * radius_m * radius_m / samples_.each_m2();
    return flat >= kFull * expected && seen >= kFull * flat && before <= kMostBefore * flat;
  }

  // The largest patch that could be seen from there and has no points.
  std::optional<ProofPlace> hole(ProofPlace place, const std::vector<const StoredSetup*>& setups,
                                 const std::string& part) {
    std::vector<const MeasuredScan*> scans;
    for (const auto* setup : setups)
      if (const auto* scan = read(*setup)) scans.push_back(scan);
    if (scans.empty() || !scene_) return std::nullopt;
    SightLimits limits;
    limits.min_elevation_rad = rehearsal_.device().expected().elevation_from_rad;
    std::vector<Vector3d> unseen;
    std::map<std::array<double, 3>, std::pair<const SurfaceSample*, const MeasuredScan*>> of;
    for (const auto* sample : samplesIn(part)) {
      const auto& p = sample->place.position;
      if (std::any_of(scans.begin(), scans.end(), [&](const auto* scan) { return scan->seen.near(p); })) continue;
      for (const auto* scan : scans) {
        auto looked_at = sample->place;
        if (looked_at.normal.dot(scan->truth.translation - p) < 0) looked_at.normal = -looked_at.normal;
        if (part.empty() && !inSight(*scene_, scan->truth.translation, looked_at, limits)) continue;
        unseen.push_back(p);
        of[{p.x(), p.y(), p.z()}] = {sample, scan};
        break;
      }
    }
    const auto patch = largestPatch(unseen);
    if (patch.empty()) return std::nullopt;
    const auto nearest = middleOf(patch);
    const auto& [sample, scan] = of.at({nearest.x(), nearest.y(), nearest.z()});
    place.centre_m = nearest;
    place.normal = sample->place.normal;
    if (place.normal->dot(scan->truth.translation - nearest) < 0) place.normal = -*place.normal;
    place.radius_m = radiusOf(patch);
    return looked(place, *scan, sample->product);
  }

  // The largest patch of the exercise's area that no station will see, though it can be seen from where one could
  // stand.
  std::optional<ProofPlace> unplanned(bool walls) {
    constexpr double kEvery_m = 0.8, kEyes_m = 1.6, kSteep = 0.5;  // instrument facts 4.2: less than 60° of incidence
    const auto& area = exercise_.area;
    readModel();
    if (area.size() != 6 || !scene_) return std::nullopt;
    const Vector3d shift = document_.georeference->shift_m;
    SightLimits limits;
    limits.min_elevation_rad = rehearsal_.device().expected().elevation_from_rad;
    if (walls) limits.min_cosine = kSteep;
    std::vector<Vector3d> eyes;
    for (double x = area[0] + kEvery_m / 2; x < area[3]; x += kEvery_m)
      for (double y = area[1] + kEvery_m / 2; y < area[4]; y += kEvery_m)
        eyes.emplace_back(Vector3d(x, y, area[2] + kEyes_m) - shift);
    const auto sees = [&](const Vector3d& eye, const SurfaceSample& sample) {
      auto looked_at = sample.place;
      if (looked_at.normal.dot(eye - looked_at.position) < 0) looked_at.normal = -looked_at.normal;
      return inSight(*scene_, eye, looked_at, limits);
    };
    const ExercisePart whole{{}, area, {}};
    const PartSurface in_area(whole, *document_.environment(), shift);
    std::vector<Vector3d> unseen;
    std::map<std::array<double, 3>, std::pair<const SurfaceSample*, Vector3d>> of;
    for (const auto& sample : samples_.samples) {
      const auto& p = sample.place.position;
      if (!in_area.has(sample) ||
          (walls && !document_.environment()->products[sample.product].ifc_class.starts_with("IfcWall")))
        continue;
      const auto& stations = document_.job->stations;
      if (std::any_of(stations.begin(), stations.end(),
                      [&](const Station& s) { return sees(s.true_pose.translation, sample); }))
        continue;
      const auto eye = std::find_if(eyes.begin(), eyes.end(), [&](const Vector3d& e) { return sees(e, sample); });
      if (eye == eyes.end()) continue;
      unseen.push_back(p);
      of[{p.x(), p.y(), p.z()}] = {&sample, *eye};
    }
    const auto patch = largestPatch(unseen);
    if (patch.empty()) return std::nullopt;
    const auto nearest = middleOf(patch);
    const auto& [sample, eye] = of.at({nearest.x(), nearest.y(), nearest.z()});
    ProofPlace place{.kind = ProofKind::hole, .centre_m = nearest, .normal = sample->place.normal};
    if (place.normal->dot(eye - nearest) < 0) place.normal = -*place.normal;
    place.radius_m = radiusOf(patch);
    place.seen_from_m = eye;
    place.what = document_.environment()->products[sample->product].name;
    return place;
  }

  // The one of them that is nearest to the middle of all.
  static Vector3d middleOf(const std::vector<Vector3d>& patch) {
    Vector3d middle = Vector3d::Zero();
    for (const auto& p : patch) middle += p / static_cast<double>(patch.size());
    return *std::min_element(patch.begin(), patch.end(), [&](const Vector3d& a, const Vector3d& b) {
      return (a - middle).squaredNorm() < (b - middle).squaredNorm();
    });
  }
  double radiusOf(const std::vector<Vector3d>& patch) const {
    const double area_m2 = static_cast<double>(patch.size()) * samples_.each_m2();
    return std::clamp(std::sqrt(area_m2 / std::numbers::pi), 0.15, 1.2);
  }

  // Where most of them are.
  std::optional<ProofPlace> strays(ProofPlace place, const std::vector<const StoredSetup*>& setups) {
    const MeasuredScan* of = nullptr;
    const MeasuredScan::Strays* most = nullptr;
    const auto kind = static_cast<std::size_t>(std::countr_zero(place.flags));
    for (const auto* setup : setups) {
      const auto* scan = read(*setup);
      if (scan == nullptr) continue;
      for (const auto& [cell, stray] : scan->strays)
        if (stray.points[kind] > (most == nullptr ? 0 : most->points[kind])) most = &stray, of = scan;
    }
    constexpr double kFewest = 10;
    if (most == nullptr || most->points[kind] < kFewest) return std::nullopt;
    // With its neighbours: a person is larger than a cell.
    constexpr double kTogether_m = 1.2;
    Bounds bounds;
    for (const auto& [cell, stray] : of->strays)
      if (stray.points[kind] >= std::max(kFewest, 0.05 * most->points[kind]) &&
          (stray.middle(kind) - most->middle(kind)).norm() < kTogether_m)
        bounds.extend(stray.middle(kind));
    place.centre_m = (bounds.min + bounds.max) / 2;
    place.radius_m = std::clamp(0.55 * (bounds.max - bounds.min).norm() + 0.15, 0.3, 1.2);
    return looked(place, *of, kNoProductOfPlace);
  }

  // The target that says it most.
  std::optional<ProofPlace> worstTarget(const ProofPlace& place, const std::vector<const StoredSetup*>& setups,
                                        std::string_view fact) {
    const bool by_points = isByPoints(fact);
    const bool by_residual = fact.ends_with("residual");
    const FittedTarget* worst = nullptr;
    const StoredSetup* in = nullptr;
    const auto badness = [&](const FittedTarget& t) {
      if (!t.found) return 1e9;
      return by_points ? -static_cast<double>(t.points) : by_residual ? t.residual_m : t.error_m;
    };
    for (const auto* setup : setups)
      for (const auto& t : setup->targets)
        if (worst == nullptr || badness(t) > badness(*worst)) worst = &t, in = setup;
    if (worst == nullptr) return sightedTarget(place);
    return onTarget(place, worst->name, in->station);
  }

  // Of targets that were picked one by one: the one whose fit is worst, or that lies where no target of its name is.
  std::optional<ProofPlace> sightedTarget(ProofPlace place) const {
    const auto& station_name = rehearsal_.device().state().around.station;
    const auto* station = stationOf(document_, station_name);
    if (station == nullptr) return std::nullopt;
    std::string name;
    double worst = -1;
    for (const auto& sight : rehearsal_.device().state().sighted)
      for (const auto& target : document_.job->targets) {
        const double off_m = (station->true_pose * sight.place_m - target.centre).norm();
        const bool named_so = target.name == sight.id;
        if (named_so && std::max(off_m, sight.residual_m) > worst)
          worst = std::max(off_m, sight.residual_m), name = target.name;
      }
    if (name.empty()) return std::nullopt;
    place.scans.clear();
    return onTarget(place, name, station_name);
  }

  std::optional<ProofPlace> onTarget(ProofPlace place, const std::string& name, const std::string& station_name) const {
    for (const auto& target : document_.job->targets) {
      if (target.name != name) continue;
      place.centre_m = target.centre;
      place.radius_m = std::max(kTargetShown_m, target.size_m);
      if (target.kind == TargetKind::checkerboard) place.normal = target.normal.normalized();
      place.what = target.name;
      place.target_radius_m = target.size_m / 2;
      return lookedFrom(place, station_name);
    }
    return std::nullopt;
  }

  // What stands together: all targets, or what surrounds a place of the exercise.
  std::optional<ProofPlace> around(ProofPlace place, const ExerciseRule& rule, std::string_view fact) const {
    const auto name = !rule.shown_at.empty()       ? rule.shown_at
                      : fact.starts_with("place.") ? std::string(fact.substr(6))
                                                   : std::string();
    const auto station = document_.job->stations.empty() ? std::string() : document_.job->stations.front().name;
    if (const auto known = exercise_.places.find(name); known != exercise_.places.end()) {
      constexpr double kAbove_m = 1.2, kShown_m = 1.3;  // half of a door's height
      place.kind = ProofKind::hole;
      place.centre_m = Vector3d(known->second[0], known->second[1], kAbove_m) - document_.georeference->shift_m;
      place.radius_m = kShown_m;
      place.what = name;
      return lookedFrom(place, station);
    }
    if (std::any_of(document_.job->targets.begin(), document_.job->targets.end(),
                    [&](const Target& t) { return t.name == name; }))
      return onTarget(place, name, station);
    Bounds bounds;
    if (const auto part = exercise_.parts.find(name); part != exercise_.parts.end() && part->second.box.size() == 6) {
      const auto& b = part->second.box;
      bounds.extend(Vector3d(b[0], b[1], b[2]) - document_.georeference->shift_m);
      bounds.extend(Vector3d(b[3], b[4], b[5]) - document_.georeference->shift_m);
    } else {
      for (const auto& target : document_.job->targets) bounds.extend(target.centre);
    }
    if (bounds.empty()) return std::nullopt;
    place.centre_m = (bounds.min + bounds.max) / 2;
    place.radius_m = std::clamp(0.55 * (bounds.max - bounds.min).norm(), 0.4, 6.0);
    place.what = exercise_.parts.contains(name) ? name : std::string();
    return lookedFrom(place, station);
  }

  std::optional<ProofPlace> withoutPoints(ProofPlace place, const ExerciseRule& rule, const std::string& fact) const {
    place.scans.clear();
    return place.kind == ProofKind::target ? sightedTarget(place) : around(place, rule, fact);
  }

  // The floor below the instrument that stands highest above it.
  std::optional<ProofPlace> blindDisc(ProofPlace place) const {
    const Station* highest = nullptr;
    for (const auto& station : document_.job->stations)
      if (highest == nullptr || station.instrument_height_m > highest->instrument_height_m) highest = &station;
    if (highest == nullptr) return std::nullopt;
    place.centre_m = highest->true_pose.translation - highest->instrument_height_m * Vector3d::UnitZ();
    place.normal = Vector3d::UnitZ();
    const auto disc = rehearsal_.fact("stations.disc");
    place.radius_m = std::clamp(disc && disc->number ? *disc->number : 1.0, 0.3, 4.0);
    return lookedFrom(place, highest->name);
  }

  static constexpr std::uint32_t kNoProductOfPlace = 0xffffffffU;
  ProofPlace looked(ProofPlace place, const MeasuredScan& scan, std::uint32_t product) const {
    place.seen_from_m = scan.truth.translation;
    place.station = scan.station;
    const auto& products = document_.environment()->products;
    if (product < products.size()) place.what = products[product].name;
    return place;
  }
  std::optional<ProofPlace> lookedFrom(ProofPlace place, const std::string& station_name) const {
    place.station = station_name;
    if (const auto* station = stationOf(document_, station_name)) place.seen_from_m = station->true_pose.translation;
    return place;
  }

  const Rehearsal& rehearsal_;
  const Exercise& exercise_;
  const Document& document_;
  std::shared_ptr<const RayScene> scene_;
  SurfaceSamples samples_;
  std::map<MeasuredScan::Cell, std::vector<std::uint32_t>> near_;
  std::map<std::string, std::unique_ptr<MeasuredScan>> scans_;  // by file; null: it cannot be read
};

ProofPlaces::ProofPlaces(const Rehearsal& rehearsal) : finder_(std::make_unique<Finder>(rehearsal)) {}
ProofPlaces::~ProofPlaces() = default;

std::optional<ProofPlace> ProofPlaces::of(const ExerciseRule& rule, const Rehearsal::RuleState& state) {
  return finder_->of(rule, state);
}

}  // namespace standpoint
