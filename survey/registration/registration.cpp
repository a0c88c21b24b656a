// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/registration/registration.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include <fmt/format.h>

#include "core/match_places.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr double kSighting_m = 0.001;       // of every measured centre: what the instrument adds to the fit's own σ
constexpr double kSameDistance_m = 0.01;    // by geometry
constexpr double kOfficeWarning_m = 0.005;  // instrument-facts.md §4.2: where office software turns yellow
constexpr std::size_t kLargestControlFile = 1U << 20U;

// What is known of one station before the network: its sightings by numbers of the measurements.
struct Seen {
  std::size_t station;
  std::vector<std::size_t> found;
  std::vector<Vector3d> places;
};

std::vector<Seen> seenBy(const TargetMeasurements& measured) {
  std::vector<Seen> all;
  for (const auto& scan : measured.scans) {
    Seen seen{scan.station, {}, {}};
    for (std::size_t i = 0; i < measured.found.size(); ++i)
      if (measured.found[i].station == scan.station)
        seen.found.push_back(i), seen.places.push_back(measured.found[i].fit.centre);
    all.push_back(std::move(seen));
  }
  return all;
}

std::string whyMissed(const Job& job, const TargetMeasurements& measured, std::size_t station) {
  std::string text;
  for (const auto& m : measured.missed)
    if (m.station == station && text.size() < 600) text += fmt::format("; {}: {}", job.targets[m.target].name, m.why);
  return text;
}

double sigmaOf(const TargetFit& fit) { return std::sqrt(kSighting_m * kSighting_m + fit.covariance_m2.trace() / 3); }

class Numbering {
 public:
  Numbering(const Job& job, const TargetMeasurements& measured, TargetRegistration& r)
      : job_(job), measured_(measured), r_(r) {}

  void byNames(const std::vector<Seen>& all, const RegistrationRequest& request, Report& report) {
    for (const auto& t : job_.targets) r_.target_names.push_back(t.name);
    for (std::size_t s = 0; s < all.size(); ++s)
      for (const auto f : all[s].found) add(s, measured_.found[f].target, f);
    for (const auto& c : request.control) {
      const auto at = std::find(r_.target_names.begin(), r_.target_names.end(), c.name);
      if (at == r_.target_names.end())
        report.note(c.name, "control point is not a target of the project");
      else
        r_.network.known.push_back({static_cast<std::size_t>(at - r_.target_names.begin()), c.position, c.sigma_m});
    }
  }

  // From the held station, or the control points, to whichever station fits best to what is placed already.
  Result<void> byGeometry(const std::vector<Seen>& all, const RegistrationRequest& request) {
    std::vector<bool> done(all.size());
    for (const auto& c : request.control) {
      r_.network.known.push_back({common_.size(), c.position, c.sigma_m});
      enter(c.position, c.name, {});
    }
    if (request.control.empty()) {
      const std::size_t held = r_.network.held->first;
      for (std::size_t i = 0; i < all[held].found.size(); ++i) {
        const auto& m = measured_.found[all[held].found[i]];
        add(held, common_.size(), all[held].found[i]);
        enter(r_.network.held->second * all[held].places[i], job_.targets[m.target].name, m.target);
      }
      done[held] = true;
    }
    while (std::find(done.begin(), done.end(), false) != done.end())
      if (auto ok = next(all, done); !ok) return ok;
    return {};
  }

 private:
  void add(std::size_t station, std::size_t target, std::size_t found) {
    r_.network.sightings.push_back(
        {station, target, measured_.found[found].fit.centre, sigmaOf(measured_.found[found].fit)});
    r_.found.push_back(found);
  }
  void enter(const Vector3d& place, const std::string& name, std::optional<std::size_t> truth) {
    common_.push_back(place), r_.target_names.push_back(name), truth_.push_back(truth);
  }

  Result<void> next(const std::vector<Seen>& all, std::vector<bool>& done) {
    std::optional<std::pair<std::size_t, PlaceMatch>> best;
    std::string why;
    for (std::size_t s = 0; s < all.size(); ++s) {
      if (done[s]) continue;
      auto match = matchPlaces(all[s].places, common_, kSameDistance_m);
      if (!match)
        why +=
            fmt::format("{}{}: {}", why.empty() ? "" : "; ", job_.stations[all[s].station].name, match.error().message);
      else if (!best || match->pairs.size() > best->second.pairs.size())
        best = {s, *std::move(match)};
    }
    if (!best) return failure(ErrorKind::unusable, "target distances are ambiguous: " + why);
    const auto& [s, match] = *best;
    done[s] = true;
    std::vector<std::optional<std::size_t>> number(all[s].found.size());
    for (const auto& [from, to] : match.pairs) number[from] = to;
    for (std::size_t i = 0; i < number.size(); ++i) {
      const std::size_t truth = measured_.found[all[s].found[i]].target;
      if (!number[i]) {
        number[i] = common_.size();
        enter(match.to_from * all[s].places[i], job_.targets[truth].name, truth);
      }
      const std::string& name = job_.targets[truth].name;
      if (truth_[*number[i]] ? *truth_[*number[i]] != truth : r_.target_names[*number[i]] != name) ++r_.wrong_matches;
      add(s, *number[i], all[s].found[i]);
    }
    return {};
  }

  const Job& job_;
  const TargetMeasurements& measured_;
  TargetRegistration& r_;
  std::vector<Vector3d> common_;
  std::vector<std::optional<std::size_t>> truth_;
};

void judge(const Job& job, const TargetRegistration& r, Report& report) {
  for (const auto& link : r.links) {
    const auto name =
        fmt::format("{}-{}", job.stations[r.station_of[link.from]].name, job.stations[r.station_of[link.to]].name);
    if (link.rows.size() == 3) report.note(name, "only three targets: add a fourth to detect errors");
    if (link.mean_m <= kOfficeWarning_m) continue;
    const auto worst = std::max_element(link.rows.begin(), link.rows.end(), [](const LinkRow& a, const LinkRow& b) {
      return a.difference_m.norm() < b.difference_m.norm();
    });
    report.warn(
        name,
        fmt::format("mean target residual {:.1f} mm exceeds 5 mm, the usual warning limit; largest: {} with {:.1f} mm",
                    link.mean_m * 1000, r.target_names[worst->target], worst->difference_m.norm() * 1000));
  }
  if (r.wrong_matches > 0)
    report.warn("geometry",
                fmt::format("{} sightings were matched to the wrong target: match by names", r.wrong_matches));
}

}  // namespace

Result<TargetRegistration> registerByTargets(const Job& job, const TargetMeasurements& measured,
                                             const RegistrationRequest& request, Report& report) {
  TargetRegistration r;
  const std::vector<Seen> all = seenBy(measured);
  for (std::size_t s = 0; s < all.size(); ++s) {
    const auto& name = job.stations[all[s].station].name;
    if (all[s].found.size() < 3)
      return failure(ErrorKind::unusable,
                     fmt::format("{} targets were measured from station {}, at least three are required; add visible "
                                 "targets, scan finer, or register cloud to cloud{}",
                                 all[s].found.size(), name, whyMissed(job, measured, all[s].station)),
                     measured.scans[s].file);
    r.station_of.push_back(all[s].station);
    if (request.control.empty() && all[s].station == request.held)
      r.network.held = {s, job.stations[request.held].true_pose};
  }
  if (request.control.empty() && !r.network.held)
    return failure(ErrorKind::usage,
                   fmt::format("none of the files contains station {}", job.stations[request.held].name), "--fix");
  Numbering numbering(job, measured, r);
  if (request.matching == TargetMatching::by_names) {
    numbering.byNames(all, request, report);
  } else {
    TRY(numbering.byGeometry(all, request));
  }
  r.network.stations = all.size();
  r.network.targets = r.target_names.size();
  NetworkProblem problem;
  auto fit = fitNetwork(r.network, &problem);
  if (!fit && problem.station) {
    const std::size_t station = r.station_of[*problem.station];
    return failure(
        ErrorKind::unusable,
        problem.on_one_line
            ? fmt::format("station {} shares {} targets with the others, all on one line; add a target off the line{}",
                          job.stations[station].name, problem.shared, whyMissed(job, measured, station))
            : fmt::format("station {} shares {} targets with the others, at least three are required; add targets "
                          "visible from both{}",
                          job.stations[station].name, problem.shared, whyMissed(job, measured, station)),
        measured.scans[*problem.station].file);
  }
  if (!fit) return failure(fit.error());
  r.fit = *std::move(fit);
  r.links = linksOf(r.network, r.fit);
  judge(job, r, report);
  return r;
}

Result<std::vector<ControlPoint>> readControlPoints(const std::filesystem::path& file, const Vector3d& shift_m) {
  std::error_code code;
  const auto size = std::filesystem::file_size(file, code);
  if (code) return failure(ErrorKind::file_system, "cannot read: " + code.message(), file.string());
  if (size > kLargestControlFile)
    return failure(ErrorKind::unusable, "file is too large for a control-point list", file.string());
  std::ifstream in(file);
  std::vector<ControlPoint> points;
  std::set<std::string> names;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    std::istringstream words(line.substr(0, line.find('#')));
    ControlPoint p;
    if (!(words >> p.name)) continue;
    std::vector<double> numbers;
    for (double x = 0; words >> x;) numbers.push_back(x);
    const bool whole = words.eof() && (numbers.size() == 3 || numbers.size() == 4);
    const double sigma_mm = numbers.size() == 4 ? numbers[3] : 1;
    if (!whole || !(sigma_mm > 0 && sigma_mm < 1e4))
      return failure(ErrorKind::unusable, "must be: name X Y Z [sigma in mm]",
                     fmt::format("{} line {}", file.string(), number));
    p.position = {numbers[0], numbers[1], numbers[2]};
    if (!p.position.allFinite())
      return failure(ErrorKind::unusable, "is not finite", fmt::format("{} line {}", file.string(), number));
    if (!names.insert(p.name).second)
      return failure(ErrorKind::unusable, fmt::format("duplicate control point {}", p.name),
                     fmt::format("{} line {}", file.string(), number));
    p.position -= shift_m;
    p.sigma_m = sigma_mm / 1000;
    points.push_back(std::move(p));
  }
  if (points.size() < 3)
    return failure(ErrorKind::unusable,
                   fmt::format("contains {} control points, at least three are required", points.size()),
                   file.string());
  return points;
}

}  // namespace standpoint
