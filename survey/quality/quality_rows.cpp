// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "core/units.h"
#include "survey/quality/survey_quality.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

// What a figure comes to, before it is held against its limit.
struct Figure {
  std::optional<double> value;
  std::string note;
  WorstPlace worst = {};
};

Figure unknown(std::string why) { return {std::nullopt, std::move(why)}; }

class Rows {
 public:
  Rows(const SurveyQuality& quality, const Job& job) : quality_(quality), job_(job) {}

  // The worst place is one in rooms, where these are surveyed; the figure is of the whole model.
  Figure coverage() const {
    Figure figure{100 * quality_.seen.all.coverage(), "of all surfaces in the scene; excluded products do not count"};
    if (quality_.seen.holes.empty()) return figure;
    const auto product = mostUnseen();
    figure.worst.product = product;
    figure.worst.at = worstOf([&](std::size_t k) { return sample(k).product == product && isUnseen(k); });
    return figure;
  }

  Figure coverageTwice() const {
    if (quality_.stations.size() < 2) return unknown("needs two stations");
    const auto& all = quality_.seen.all;
    Figure figure{all.exposed == 0 ? 0 : 100 * static_cast<double>(all.twice) / static_cast<double>(all.exposed), {}};
    figure.worst.at = worstOf([&](std::size_t k) { return timesSeen(k) == 1; });
    return figure;
  }

  // Of the links that hold all stations together with the most overlap (the maximum spanning tree, Prim), the weakest.
  Figure overlap() const {
    const std::size_t count = quality_.stations.size();
    if (count < 2) return unknown("needs two stations");
    std::vector<bool> joined(count, false);
    joined[0] = true;
    const StationPair* weakest = nullptr;
    for (std::size_t n = 1; n < count; ++n) {
      const StationPair* strongest = nullptr;
      for (const auto& pair : quality_.seen.pairs)
        if (joined[pair.a] != joined[pair.b] && (strongest == nullptr || pair.overlap() > strongest->overlap()))
          strongest = &pair;
      joined[strongest->a] = joined[strongest->b] = true;
      if (weakest == nullptr || strongest->overlap() < weakest->overlap()) weakest = strongest;
    }
    const auto &a = job_.stations[quality_.stations[weakest->a].station],
               &b = job_.stations[quality_.stations[weakest->b].station];
    return {100 * weakest->overlap(),
            {},
            {(a.true_pose.translation + b.true_pose.translation) / 2, std::nullopt, {a.name, b.name}}};
  }

  // Of each sample that is seen, by the scan that does best.
  template <class Value>
  Figure bestOfEachSample(Value value) const {
    std::vector<Vector3d> places;
    std::vector<double> values, all;
    for (std::size_t k = 0; k < quality_.samples.samples.size(); ++k) {
      std::optional<double> best;
      for (const auto& scan : quality_.scans)
        if (scan.counts[k] > 0 && quality_.samples.samples[k].exposed) {
          const double found = value(scan, k);
          best = std::min(best.value_or(found), found);
        }
      if (!best) continue;
      all.push_back(*best);
      if (quality_.surveyed[k] == 0) continue;
      places.push_back(sample(k).place.position);
      values.push_back(*best);
    }
    if (all.empty()) return unknown("no surface is seen");
    WorstPlace worst{worstPlace(places, values, WorstBy::mean), {}, {}};
    return {fractile(all, 0.95), {}, std::move(worst)};
  }

  // √ of the area for which one point stands, by how many lie within the radius of a sample.
  Figure spacing() const {
    return bestOfEachSample([&](const ScanFigures& scan, std::size_t k) {
      return 1000 * quality_.radius_m * std::sqrt(M_PI / scan.counts[k]);
    });
  }

  Figure incidence() const {
    return bestOfEachSample([&](const ScanFigures& scan, std::size_t k) {
      const auto& place = quality_.samples.samples[k].place;
      const double cosine = std::abs(place.normal.dot((place.position - scan.origin).normalized()));
      return std::acos(std::min(1.0, cosine)) / kRadPerDeg;
    });
  }

  // Of the scan in which it is largest.
  template <class Value>
  Figure worstScan(const char* if_none, double factor, Value value,
                   std::optional<Vector3d> ScanFigures::*at = nullptr) const {
    const ScanFigures* worst = nullptr;
    for (const auto& scan : quality_.scans)
      if (value(scan) && (worst == nullptr || *value(scan) > *value(*worst))) worst = &scan;
    if (worst == nullptr) return unknown(if_none);
    return {factor * *value(*worst),
            {},
            {at != nullptr ? worst->*at : std::optional(worst->origin), {}, {job_.stations[worst->station].name}}};
  }

  Figure noise() const {
    auto figure = worstScan("no even patch with enough points, or an unknown instrument", 1,
                            [](const ScanFigures& s) { return s.noise_ratio; });
    for (const auto& scan : quality_.scans)
      if (figure.value && scan.noise_ratio == figure.value && scan.noise_m)
        figure.note = fmt::format("{:.2f} mm along the beam", *scan.noise_m * 1000);
    return figure;
  }

  template <class T>
  Figure worstStation(const char* if_none, double factor, std::optional<T> StationQuality::*member,
                      bool least = false) const {
    const StationQuality* worst = nullptr;
    for (const auto& station : quality_.stations) {
      if (!(station.*member)) continue;
      if (worst == nullptr || (least ? *(station.*member) < *(worst->*member) : *(station.*member) > *(worst->*member)))
        worst = &station;
    }
    if (worst == nullptr) return unknown(if_none);
    const auto& station = job_.stations[worst->station];
    return {factor * static_cast<double>(*(worst->*member)),
            {},
            {station.true_pose.translation, std::nullopt, {station.name}}};
  }

  template <class T>
  Figure poseError(double factor, std::optional<T> StationQuality::*member) const {
    auto figure = worstStation("no station stands where it was scanned", factor, member);
    if (figure.value) figure.note = "known only to a simulator";
    return figure;
  }

  Figure of(const std::string& id) const {
    if (quality_.scans.empty()) return unknown("no scan could be read");
    if (id == "coverage") return coverage();
    if (id == "coverage_twice") return coverageTwice();
    if (id == "overlap") return overlap();
    if (id == "spacing") return spacing();
    if (id == "incidence") return incidence();
    if (id == "deviation_median")
      return worstScan(
          "no point lies on the model", 1000, [](const auto& s) { return s.deviation_median_m; },
          &ScanFigures::deviation_at);
    if (id == "deviation_95")
      return worstScan(
          "no point lies on the model", 1000, [](const auto& s) { return s.deviation_95_m; },
          &ScanFigures::deviation_at);
    if (id == "stray")
      return worstScan(
          "no points", 100, [](const auto& s) { return s.points > 0 ? std::optional(s.stray_fraction) : std::nullopt; },
          &ScanFigures::stray_at);
    if (id == "noise") return noise();
    if (id == "pose_position") return poseError(1000, &StationQuality::pose_error_m);
    if (id == "pose_rotation") return poseError(1 / kRadPerDeg, &StationQuality::pose_error_rad);
    return worstStation("the job has no targets", 1, &StationQuality::targets, true);
  }

  QualityRow troubleRow(const ScanTrouble& trouble) const {
    const auto& station = job_.stations[trouble.station];
    QualityRow row{"scan", "Scan of " + station.name, "", {}, {}, trouble.verdict, trouble.what, {}};
    row.worst = {station.true_pose.translation, std::nullopt, {station.name}};
    return row;
  }

 private:
  const SurfaceSample& sample(std::size_t k) const { return quality_.samples.samples[k]; }
  int timesSeen(std::size_t k) const {
    int times = 0;
    for (const auto& station : quality_.stations) times += station.seen[k];
    return times;
  }
  bool isUnseen(std::size_t k) const { return sample(k).exposed && timesSeen(k) == 0; }

  // The product with most unseen surface of what is surveyed; where all of that is seen, of the scene.
  std::uint32_t mostUnseen() const {
    std::map<std::uint32_t, std::size_t> unseen;
    for (std::size_t k = 0; k < quality_.samples.samples.size(); ++k)
      if (quality_.surveyed[k] != 0 && isUnseen(k)) ++unseen[sample(k).product];
    const auto most = std::max_element(unseen.begin(), unseen.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == unseen.end() ? quality_.seen.holes.front().product : most->first;
  }

  // Where most of the samples are that are meant: of those surveyed, else of all.
  template <class Meant>
  std::optional<Vector3d> worstOf(Meant meant) const {
    std::vector<Vector3d> surveyed, all;
    for (std::size_t k = 0; k < quality_.samples.samples.size(); ++k) {
      if (!meant(k)) continue;
      all.push_back(sample(k).place.position);
      if (quality_.surveyed[k] != 0) surveyed.push_back(all.back());
    }
    const auto& places = surveyed.empty() ? all : surveyed;
    return worstPlace(places, std::vector<double>(places.size(), 1), WorstBy::number);
  }

  const SurveyQuality& quality_;
  const Job& job_;
};

}  // namespace

std::vector<QualityRow> qualityRows(const SurveyQuality& quality, const Job& job, const QualityLimits& limits) {
  const Rows rows(quality, job);
  std::vector<QualityRow> result;
  for (const auto& limit : limits) {
    auto figure = rows.of(limit.id);
    QualityRow row{limit.id,
                   limit.label,
                   limit.unit,
                   figure.value,
                   limit,
                   Verdict::unknown,
                   std::move(figure.note),
                   std::move(figure.worst)};
    if (row.value) row.verdict = verdictOf(limit, *row.value);
    result.push_back(std::move(row));
  }
  for (const auto& trouble : quality.troubles) result.push_back(rows.troubleRow(trouble));
  return result;
}

}  // namespace standpoint
