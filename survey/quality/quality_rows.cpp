// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

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
    const auto meant = [&](std::size_t k) { return sample(k).product == product && isUnseen(k); };
    figure.worst.what = fmt::format("Not seen from any station: {:.1f} m²", area_m2(meant));
    figure.worst.at = worstOf(meant);
    return figure;
  }

  Figure coverageTwice() const {
    if (quality_.stations.size() < 2) return unknown("needs two stations");
    const auto& all = quality_.seen.all;
    Figure figure{all.exposed == 0 ? 0 : 100 * static_cast<double>(all.twice) / static_cast<double>(all.exposed), {}};
    figure.worst.at = worstOf([&](std::size_t k) { return timesSeen(k) == 1; });
    figure.worst.what = "Seen from one station only";
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
            {(a.true_pose.translation + b.true_pose.translation) / 2,
             std::nullopt,
             {a.name, b.name},
             fmt::format("Overlap {:.0f} % between {} and {}", 100 * weakest->overlap(), a.name, b.name)}};
  }

  // Of each sample that is seen, by the scan that does best. `what`: of the value where it is worst.
  template <class Value, class What>
  Figure bestOfEachSample(Value value, What what) const {
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
    WorstPlace worst;
    if (const auto cell = worstPlace(places, values, WorstBy::mean)) {
      worst.at = cell->at;
      worst.what = what(cell->value);
    }
    return {fractile(all, 0.95), {}, std::move(worst)};
  }

  // √ of the area for which one point stands, by how many lie within the radius of a sample.
  Figure spacing() const {
    return bestOfEachSample([&](const ScanFigures& scan,
                                std::size_t k) { return 1000 * quality_.radius_m * std::sqrt(M_PI / scan.counts[k]); },
                            [](double mm) { return fmt::format("Point spacing {:.0f} mm", mm); });
  }

  Figure incidence() const {
    return bestOfEachSample(
        [&](const ScanFigures& scan, std::size_t k) {
          const auto& place = quality_.samples.samples[k].place;
          const double cosine = std::abs(place.normal.dot((place.position - scan.origin).normalized()));
          return std::acos(std::min(1.0, cosine)) / kRadPerDeg;
        },
        [](double deg) { return fmt::format("Incidence {:.0f}°", deg); });
  }

  // Of the scan in which it is largest; null where none has it. The place is that of its scanner.
  template <class Value>
  std::pair<Figure, const ScanFigures*> worstScan(const char* if_none, double factor, Value value) const {
    const ScanFigures* worst = nullptr;
    for (const auto& scan : quality_.scans)
      if (value(scan) && (worst == nullptr || *value(scan) > *value(*worst))) worst = &scan;
    if (worst == nullptr) return {unknown(if_none), nullptr};
    return {{factor * *value(*worst), {}, {worst->origin, {}, {nameOf(*worst)}}}, worst};
  }

  Figure deviation(std::optional<double> ScanFigures::*member) const {
    auto [figure, scan] =
        worstScan("no point lies on the model", 1000, [&](const ScanFigures& s) { return s.*member; });
    if (scan == nullptr || !scan->deviation_at) return figure;
    figure.worst.at = scan->deviation_at->at;
    figure.worst.what =
        fmt::format("Deviation {:.1f} mm in the scan of {}", 1000 * scan->deviation_at->value, nameOf(*scan));
    return figure;
  }

  Figure stray() const {
    auto [figure, scan] = worstScan("no points", 100, [](const ScanFigures& s) {
      return s.points > 0 ? std::optional(s.stray_fraction) : std::nullopt;
    });
    if (scan == nullptr) return figure;
    figure.worst.at = scan->stray_at;
    figure.worst.what = fmt::format("Stray points, {:.1f} % of the scan of {}", *figure.value, nameOf(*scan));
    return figure;
  }

  Figure noise() const {
    auto [figure, scan] = worstScan("no even patch with enough points, or an unknown instrument", 1,
                                    [](const ScanFigures& s) { return s.noise_ratio; });
    if (scan == nullptr) return figure;
    if (scan->noise_m) figure.note = fmt::format("{:.2f} mm along the beam", *scan->noise_m * 1000);
    if (!scan->noise_at) return figure;
    figure.worst.at = scan->noise_at->at;
    figure.worst.what = fmt::format("Noise {:.1f} mm in the scan of {}", 1000 * scan->noise_at->value, nameOf(*scan));
    return figure;
  }

  // `what`: of the figure and the station's name.
  template <class T, class What>
  Figure worstStation(const char* if_none, double factor, std::optional<T> StationQuality::*member, What what,
                      bool least = false) const {
    const StationQuality* worst = nullptr;
    for (const auto& station : quality_.stations) {
      if (!(station.*member)) continue;
      if (worst == nullptr || (least ? *(station.*member) < *(worst->*member) : *(station.*member) > *(worst->*member)))
        worst = &station;
    }
    if (worst == nullptr) return unknown(if_none);
    const auto& station = job_.stations[worst->station];
    const double value = factor * static_cast<double>(*(worst->*member));
    return {value, {}, {station.true_pose.translation, std::nullopt, {station.name}, what(value, station.name)}};
  }

  template <class T, class What>
  Figure poseError(double factor, std::optional<T> StationQuality::*member, What what) const {
    auto figure = worstStation("no station stands where it was scanned", factor, member, what);
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
    if (id == "deviation_median") return deviation(&ScanFigures::deviation_median_m);
    if (id == "deviation_95") return deviation(&ScanFigures::deviation_95_m);
    if (id == "stray") return stray();
    if (id == "noise") return noise();
    if (id == "pose_position")
      return poseError(1000, &StationQuality::pose_error_m, [](double mm, const std::string& name) {
        return fmt::format("Position of {} wrong by {:.1f} mm", name, mm);
      });
    if (id == "pose_rotation")
      return poseError(1 / kRadPerDeg, &StationQuality::pose_error_rad, [](double deg, const std::string& name) {
        return fmt::format("Rotation of {} wrong by {:.3f}°", name, deg);
      });
    return worstStation(
        "the job has no targets", 1, &StationQuality::targets,
        [](double count, const std::string& name) {
          return fmt::format("Targets in sight of {}: {:.0f}", name, count);
        },
        true);
  }

  QualityRow troubleRow(const ScanTrouble& trouble) const {
    const auto& station = job_.stations[trouble.station];
    QualityRow row{"scan", "Scan of " + station.name, "", {}, {}, trouble.verdict, trouble.what, {}};
    row.worst = {station.true_pose.translation, std::nullopt, {station.name}, row.label};
    return row;
  }

 private:
  const std::string& nameOf(const ScanFigures& scan) const { return job_.stations[scan.station].name; }
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

  template <class Meant>
  double area_m2(Meant meant) const {
    std::size_t count = 0;
    for (std::size_t k = 0; k < quality_.samples.samples.size(); ++k) count += meant(k) ? 1 : 0;
    return quality_.samples.each_m2() * static_cast<double>(count);
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
    const auto most = worstPlace(places, std::vector<double>(places.size(), 1), WorstBy::number);
    return most ? std::optional(most->at) : std::nullopt;
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
