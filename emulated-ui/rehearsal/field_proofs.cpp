// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/field_proofs.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include <Eigen/Dense>

#include "core/units.h"
#include "scanners/expectation.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr double kWrong_m = 0.5, kWrong_deg = 5;   // instrument facts 3.3, M18

FactDomain numbers(double minimum, double maximum) { return {{}, true, minimum, maximum}; }

std::vector<const StoredSetup*> allSetups(const Device& device) {
  std::vector<const StoredSetup*> all;
  for (const auto& p : device.state().projects)
    for (const auto& s : p.setups) all.push_back(&s);
  return all;
}

// The device takes the link: where it asks first, the answer was not no.
bool accepted(const Device& device, const StoredSetup& setup) {
  if (!setup.link || !setup.link->joined) return false;
  const auto registration = device.value("registration." + setup.file);
  return registration != "rejected" && registration != "failed" && registration != "check";
}

double wrongLinks(const Device& device) {
  double n = 0;
  for (const auto* s : allSetups(device))
    n += accepted(device, *s) && (s->link->true_error_m > kWrong_m || s->link->true_error_deg > kWrong_deg) ? 1 : 0;
  return n;
}

// Where the chain of links puts the newest setup, against where it stands: each link's error moves all that come after.
double closure(const Device& device, const Document& document) {
  Pose moved;
  const StoredSetup* last = nullptr;
  for (const auto* s : allSetups(device)) {
    if (!accepted(device, *s)) continue;
    const Pose& e = s->link->error;
    moved = {e.rotation * moved.rotation, e * moved.translation};
    last = s;
  }
  if (last == nullptr) return 0;
  for (const auto& station : document.job->stations)
    if (station.name == last->station) return (moved * station.true_pose.translation - station.true_pose.translation).norm() * 1000;
  return 0;
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

double worstDistance(const Device& device, const Document& document) {
  double worst = 0;
  for (const auto* s : allSetups(device))
    eachDistance(*s, [&](const FittedTarget& a, const FittedTarget& b, double measured) {
      const auto *first = targetOf(document, a.name), *second = targetOf(document, b.name);
      if (first != nullptr && second != nullptr) worst = std::max(worst, std::abs(measured - (first->centre - second->centre).norm()) * 1000);
    });
  return worst;
}

// Of the distance between two targets over all setups that measured both: largest less smallest.
double repeatSpread(const Device& device) {
  std::map<std::pair<std::string, std::string>, std::pair<double, double>> seen;
  for (const auto* s : allSetups(device))
    eachDistance(*s, [&](const FittedTarget& a, const FittedTarget& b, double d) {
      const auto [row, first] = seen.try_emplace(std::minmax(a.name, b.name), d, d);
      if (!first) row->second = {std::min(row->second.first, d), std::max(row->second.second, d)};
    });
  double worst = 0;
  for (const auto& [pair, range] : seen) worst = std::max(worst, (range.second - range.first) * 1000);
  return worst;
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
    azimuth_deg.push_back(std::atan2(t.centre_m.y(), t.centre_m.x()) / kRadPerDeg);
  }
  result.targets = static_cast<double>(from.size());
  if (from.size() > 1) {
    std::sort(azimuth_deg.begin(), azimuth_deg.end());
    double gap = azimuth_deg.front() + 360 - azimuth_deg.back();
    for (std::size_t i = 1; i < azimuth_deg.size(); ++i) gap = std::max(gap, azimuth_deg[i] - azimuth_deg[i - 1]);
    result.spread_deg = 360 - gap;
  }
  if (from.size() < 3) return result;
  Eigen::Matrix3Xd a(3, from.size()), b(3, from.size());
  for (std::size_t i = 0; i < from.size(); ++i) a.col(static_cast<Eigen::Index>(i)) = from[i], b.col(static_cast<Eigen::Index>(i)) = to[i];
  const Eigen::Affine3d fit(Eigen::umeyama(a, b, false));
  for (std::size_t i = 0; i < from.size(); ++i) result.residual_mm = std::max(result.residual_mm, (fit * from[i] - to[i]).norm() * 1000);
  for (const auto& station : document.job->stations)
    if (station.name == setup->station) result.error_mm = (fit.translation() - station.true_pose.translation).norm() * 1000;
  return result;
}

std::optional<double> numberIn(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
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

const std::vector<double>* placeOf(const std::string& name, const Exercise& exercise) {
  if (!name.starts_with("place.")) return nullptr;
  const auto found = exercise.places.find(name.substr(6));
  return found == exercise.places.end() ? nullptr : &found->second;
}

}  // namespace

const std::vector<ProofRow>& fieldProofRows() {
  static const std::vector<ProofRow> rows = {
      {"links.closure", "mm", numbers(0, 1e7), "how far the chain of the links puts the newest setup from where it stands"},
      {"links.wrong", "", numbers(0, 1e4), "accepted links that are more than 0.5 m or 5° from the truth"},
      {"targets.distances", "mm", numbers(0, 1e6), "worst difference of a distance between two fitted centres to the known one"},
      {"control.targets", "", numbers(0, 1e4), "targets with known coordinates in the newest setup"},
      {"control.spread", "°", numbers(0, 360), "directions that they cover, seen from the newest setup"},
      {"control.residual", "mm", numbers(0, 1e6), "worst residual of the newest setup laid onto them"},
      {"control.error", "mm", numbers(0, 1e6), "how far the newest setup then is from where it stands"},
      {"repeats.least", "", numbers(0, 1e4), "setups at the place with the fewest"},
      {"repeats.places", "", numbers(0, 1e4), "places that were scanned from"},
      {"repeats.spread", "mm", numbers(0, 1e6), "worst spread of a distance between two targets over the repeats"},
  };
  return rows;
}

std::optional<Fact> fieldProof(const std::string& name, const Device& device, const Document& document) {
  if (name == "links.closure") return numberFact(closure(device, document));
  if (name == "links.wrong") return numberFact(wrongLinks(device));
  if (name == "targets.distances") return numberFact(worstDistance(device, document));
  if (name == "control.targets") return numberFact(tied(device, document).targets);
  if (name == "control.spread") return numberFact(tied(device, document).spread_deg);
  if (name == "control.residual" || name == "control.error") {
    const auto t = tied(device, document);
    if (t.targets < 3) return std::nullopt;   // three are needed to lay it
    return numberFact(name == "control.residual" ? t.residual_mm : t.error_mm);
  }
  if (name == "repeats.least") return numberFact(fewestRepeats(device));
  if (name == "repeats.places") return numberFact(places(device));
  if (name == "repeats.spread") return numberFact(repeatSpread(device));
  return std::nullopt;
}

std::optional<Fact> namedProof(const std::string& name, const Exercise& exercise, const Device& device, const Document& document) {
  if (const auto at = sigmaAt(name)) {
    Optics surface;
    surface.diffuse = static_cast<float>(at->percent / 100);
    return numberFact(ReturnLaw(device.type().instrument, device.expected()).of(surface, at->range_m, 1).sigma_m * 1000);
  }
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
  if (sigmaAt(name)) return numbers(0, 1e6);
  if (placeOf(name, exercise) != nullptr) return numbers(0, 1e6);
  return std::nullopt;
}

}  // namespace standpoint
