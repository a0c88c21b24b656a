// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/quality/survey_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/progress_part.h"
#include "core/units.h"
#include "pointclouds/formats.h"
#include "pointclouds/statistics/cloud_sample.h"
#include "pointclouds/statistics/coverage.h"
#include "survey/instruments.h"
#include "survey/quality/scan_marks.h"
#include "survey/quality/surveyed_samples.h"
#include "survey/scene/model_surface.h"
#include "survey/stations/levelling.h"
#include "survey/targets/target_sight.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

constexpr std::size_t kMostDrawn = 200000;  // points of a scan that are held against the model
constexpr std::size_t kMostPatches = 1500;  // of a scan, for the noise on planes
constexpr std::size_t kFewestPatches = 20;  // that a median is taken of
constexpr double kPatch_m = 0.1;            // radius
constexpr double kSamePlace_m = 0.005;      // a file's pose against the station's: beyond that it was moved
constexpr double kSameHeading_rad = 0.1 * kRadPerDeg;

// The job's scan files, each with the stations that have a scan in it.
struct ScanFile {
  fs::path file;
  std::vector<std::size_t> stations;
};

std::vector<ScanFile> scanFilesOf(const Job& job) {
  std::vector<ScanFile> files;
  for (std::size_t s = 0; s < job.stations.size(); ++s)
    for (const auto& scan : job.stations[s].scans) {
      auto file = std::find_if(files.begin(), files.end(), [&](const ScanFile& f) { return f.file == scan.file; });
      if (file == files.end()) file = files.insert(files.end(), {scan.file, {}});
      if (file->stations.empty() || file->stations.back() != s) file->stations.push_back(s);
    }
  return files;
}

const Scan* scanIn(const Station& station, const fs::path& file) {
  const Scan* last = nullptr;
  for (const auto& scan : station.scans)
    if (scan.file == file) last = &scan;
  return last;
}

bool sameStand(const Pose& a, const Pose& b) {
  const double turned = std::remainder(yawOf(a.rotation) - yawOf(b.rotation), 2 * M_PI);
  return (a.translation - b.translation).norm() < kSamePlace_m && std::abs(turned) < kSameHeading_rad;
}

// What instruments with their settings are expected to make of the scene; made when first asked for.
class Expectations {
 public:
  Expectations(std::shared_ptr<const RayScene> scene, std::shared_ptr<const MaterialAssignment> assignment)
      : scene_(std::move(scene)), assignment_(std::move(assignment)) {}
  // Null where the scan's instrument is not known here.
  const Expectation* of(const Scan& scan) {
    std::string key = scan.instrument;
    for (const auto& [name, value] : scan.settings) key += " " + name + "=" + value;
    auto& kept = made_[key];
    if (kept) return kept.get();
    const auto instrument = instrumentNamed(scan.instrument);
    if (!instrument) return nullptr;
    const auto settings = resolveSettings(*instrument, scan.settings);
    if (!settings) return nullptr;
    kept = std::make_unique<Expectation>(scene_, assignment_, ReturnLaw(*instrument, *settings));
    return kept.get();
  }
  const RayScene& scene() const { return *scene_; }

 private:
  std::shared_ptr<const RayScene> scene_;
  std::shared_ptr<const MaterialAssignment> assignment_;
  std::map<std::string, std::unique_ptr<Expectation>> made_;
};

struct Assessing {
  const Job& job;
  const QualityRequest& request;
  const SurfaceSamples& samples;
  const SampleCells& cells;
  const ModelSurface& surface;
  Expectations& expectations;
};

void choosePatches(const Assessing& with, const Vector3d& origin, ScanMarks& marks) {
  const SightLimits sight{100, 0.5, -M_PI / 2, M_PI / 2};
  const std::size_t count = with.samples.samples.size();
  // Steps of the golden ratio reach all of the scene evenly, however many there are to be.
  const auto step = static_cast<std::size_t>(0.618 * static_cast<double>(count)) | 1U;
  for (std::size_t n = 0, k = 0; n < count && marks.patches.size() < kMostPatches; ++n, k = (k + step) % count) {
    const auto& sample = with.samples.samples[k];
    if (!sample.exposed || !inSight(with.expectations.scene(), origin, sample.place, sight)) continue;
    Neighbourhood patch;
    patch.index = ~std::uint64_t{0};  // no point of the scan is its centre
    patch.centre = sample.place.position;
    patch.beam = (patch.centre - origin).normalized();
    marks.patches.push_back(patch);
    marks.patch_samples.push_back(k);
  }
}

void measureNoise(const Assessing& with, const Scan* scan, const ScanMarks& marks, ScanFigures& figures) {
  const auto* expectation = scan == nullptr ? nullptr : with.expectations.of(*scan);
  std::vector<double> sigmas, ratios;
  std::vector<std::pair<double, WorstCell>> places;  // by ratio
  for (std::size_t i = 0; i < marks.patches.size(); ++i) {
    const auto sigma = planeNoise(marks.patches[i]);
    if (!sigma) continue;
    sigmas.push_back(*sigma);
    if (expectation == nullptr) continue;
    auto place = with.samples.samples[marks.patch_samples[i]].place;
    if (place.normal.dot(figures.origin - place.position) < 0) place.normal *= -1;
    const auto expected = expectation->from(figures.origin, place);
    if (expected.fate != ReturnFate::returned || !(expected.sigma_m > 0)) continue;
    ratios.push_back(*sigma / expected.sigma_m);
    places.push_back({ratios.back(), {marks.patches[i].centre, *sigma}});
  }
  if (!places.empty()) {  // a few are laid over an edge
    const auto at = places.begin() + std::lround(0.95 * static_cast<double>(places.size() - 1));
    std::nth_element(places.begin(), at, places.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    figures.noise_at = at->second;
  }
  if (sigmas.size() >= kFewestPatches) figures.noise_m = fractile(sigmas, 0.5);
  if (ratios.size() >= kFewestPatches) figures.noise_ratio = fractile(ratios, 0.5);
}

void measureDeviation(const Assessing& with, const ScanMarks& marks, ScanFigures& figures) {
  const auto& points = marks.drawn.points();
  std::vector<SurfaceTouch> touches(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {  // each into its own slot
    if (points[i].allFinite()) touches[i] = with.surface.nearest(points[i], with.request.radius_m);
  });
  std::vector<Vector3d> strays, met;
  std::vector<double> deviations;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (touches[i].normal.isZero()) {
      strays.push_back(points[i]);
      continue;
    }
    met.push_back(points[i]);
    deviations.push_back(std::abs(touches[i].normal.dot(points[i] - touches[i].position)));
  }
  if (points.empty()) return;
  figures.stray_fraction = static_cast<double>(strays.size()) / static_cast<double>(points.size());
  if (const auto most = worstPlace(strays, std::vector<double>(strays.size(), 1), WorstBy::number))
    figures.stray_at = most->at;
  if (met.empty()) return;
  figures.deviation_at = worstPlace(met, deviations, WorstBy::mean);
  figures.deviation_median_m = fractile(deviations, 0.5);
  figures.deviation_95_m = fractile(deviations, 0.95);
}

// Gives each scan of a file to its station's marks, and takes the figures of each when it has ended.
class FileSink final : public PointSink {
 public:
  FileSink(const Assessing& with, const ScanFile& file, std::vector<ScanFigures>& finished)
      : with_(with), file_(file), finished_(finished) {}

  Result<void> begin(const ScanHeader& header) override {
    const auto station = stationFor(header);
    marking_.reset();
    if (!station || !wanted(*station)) return {};
    figures_ = placed(*station, header);
    marks_.emplace(with_.samples.samples.size(), kMostDrawn);
    choosePatches(with_, figures_.origin, *marks_);
    marking_ = std::make_unique<MarkingSink>(with_.cells, figures_.placed, figures_.origin, kPatch_m, *marks_);
    return marking_->begin(header);
  }
  Result<void> write(const PointBlock& block) override { return marking_ ? marking_->write(block) : Result<void>(); }
  Result<void> end() override {
    if (!marking_) return {};
    figures_.points = marks_->points;
    measureNoise(with_, scanIn(with_.job.stations[figures_.station], file_.file), *marks_, figures_);
    measureDeviation(with_, *marks_, figures_);
    figures_.counts = std::move(marks_->counts);
    finished_.push_back(std::move(figures_));
    marking_.reset();
    return {};
  }
  Result<void> close() override { return {}; }

 private:
  // By its name, else by its place among those of the file.
  std::optional<std::size_t> stationFor(const ScanHeader& header) {
    const std::size_t number = scans_++;
    for (const auto s : file_.stations)
      if (with_.job.stations[s].name == header.name) return s;
    if (number < file_.stations.size()) return file_.stations[number];
    return std::nullopt;
  }
  bool wanted(std::size_t station) const {
    const auto& all = with_.request.stations;
    return std::find(all.begin(), all.end(), station) != all.end();
  }
  // Where the surveyor believes the scan to be: by registration where that was made of this stand, else by the file.
  ScanFigures placed(std::size_t index, const ScanHeader& header) const {
    const Station& station = with_.job.stations[index];
    ScanFigures f;
    f.station = index;
    f.file = file_.file.string();
    f.placed = header.file_from_scanner;
    f.placed.translation -= with_.request.shift_m;
    f.has_pose = stationOf(header).has_value();
    f.origin = f.has_pose ? f.placed.translation : station.true_pose.translation;
    if (!f.has_pose) return f;
    const bool as_solved = station.solved_pose && sameStand(f.placed, *station.solved_pose);
    f.moved = !as_solved && !sameStand(f.placed, station.true_pose);
    if (station.solved_pose && !f.moved) {
      f.placed = *station.solved_pose;
      f.origin = f.placed.translation;
    }
    return f;
  }

  const Assessing& with_;
  const ScanFile& file_;
  std::vector<ScanFigures>& finished_;
  ScanFigures figures_;
  std::optional<ScanMarks> marks_;
  std::unique_ptr<MarkingSink> marking_;
  std::size_t scans_ = 0;
};

// A reader has stages of its own from 0 to 1: here they are a part of one.
Result<Report> readScans(const fs::path& file, PointSink& sink, Progress& progress) {
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return failure(ErrorKind::file_system, "file not found", file.string());
  const CloudFormat* const format = readableCloudFormat(file);
  if (format == nullptr || format->read == nullptr)
    return failure(ErrorKind::usage, "unsupported point-cloud format", file.string());
  ProgressPart reading(progress, 0, 1);
  return format->read(file, sink, reading);
}

class Assessment {
 public:
  Assessment(const Assessing& with, SurveyQuality& quality) : with_(with), quality_(quality) {}

  Result<void> read(const std::vector<ScanFile>& files, Progress& progress) {
    for (std::size_t i = 0; i < files.size(); ++i) {
      const auto part = [&](std::size_t k) {
        return 0.1 + 0.85 * static_cast<double>(k) / static_cast<double>(files.size());
      };
      progress.stage("Reading " + files[i].file.filename().string(), part(i), part(i + 1));
      FileSink sink(with_, files[i], quality_.scans);
      const auto before = quality_.scans.size();
      const auto read = readScans(files[i].file, sink, progress);
      TRY(progress.check());
      if (read) quality_.report.append(*read);
      for (const auto s : files[i].stations)
        if (isWanted(s)) tellMissing(s, files[i].file, before, read ? nullptr : &read.error());
    }
    return {};
  }

  void tellStations() {
    for (auto& trouble : quality_.troubles)  // a file of its own that could be read stands in for it
      if (hasScan(trouble.station, false)) trouble.verdict = Verdict::warn;
    for (const auto s : with_.request.stations)
      if (with_.job.stations[s].scans.empty()) tell(s, Verdict::warn, "not scanned yet: scan it, or leave it out");
    for (const auto& scan : quality_.scans) {
      if (scan.moved && !hasScan(scan.station, false))
        tell(scan.station, Verdict::warn,
             fmt::format("moved after {} was scanned: scan it again, or undo the move", nameOfFile(scan.file)));
      if (!scan.has_pose)
        tell(scan.station, Verdict::warn,
             fmt::format("{} does not state where its scanner stood: scan to E57 or PTX", nameOfFile(scan.file)));
    }
  }

 private:
  static std::string nameOfFile(const fs::path& file) { return file.filename().string(); }
  bool isWanted(std::size_t station) const {
    const auto& all = with_.request.stations;
    return std::find(all.begin(), all.end(), station) != all.end();
  }
  bool hasScan(std::size_t station, bool moved) const {
    return std::any_of(quality_.scans.begin(), quality_.scans.end(),
                       [&](const ScanFigures& s) { return s.station == station && s.moved == moved; });
  }
  void tell(std::size_t station, Verdict verdict, std::string what) {
    quality_.troubles.push_back({station, verdict, std::move(what)});
  }
  void tellMissing(std::size_t station, const fs::path& file, std::size_t before, const Error* error) {
    for (std::size_t k = before; k < quality_.scans.size(); ++k)
      if (quality_.scans[k].station == station) return;
    const auto& name = with_.job.stations[station].name;
    std::error_code ignored;
    if (!fs::exists(file, ignored))
      tell(station, Verdict::bad,
           fmt::format("{} is missing: put it back, or scan {} again", fs::absolute(file, ignored).string(), name));
    else if (error != nullptr)
      tell(station, Verdict::bad,
           fmt::format("{} cannot be read ({}): scan {} again", nameOfFile(file), error->message, name));
    else
      tell(station, Verdict::bad,
           fmt::format("{} has no scan of its own for it: scan {} again, to E57 or PTX", nameOfFile(file), name));
  }

  const Assessing& with_;
  SurveyQuality& quality_;
};

void seeByStation(SurveyQuality& quality, const QualityRequest& request) {
  for (const auto s : request.stations) {
    StationQuality station{s, std::vector<std::uint8_t>(quality.samples.samples.size()), {}, {}, {}};
    bool any = false;
    for (const auto& scan : quality.scans) {
      if (scan.station != s) continue;
      any = true;
      for (std::size_t k = 0; k < station.seen.size(); ++k)
        station.seen[k] |= static_cast<std::uint8_t>(scan.counts[k] > 0);
    }
    if (any) quality.stations.push_back(std::move(station));
  }
}

void findHoles(SurveyQuality& quality) {
  if (quality.stations.empty()) return;
  std::vector<double> spacing_m(quality.samples.samples.size(), 0);
  for (std::size_t k = 0; k < spacing_m.size(); ++k) {
    std::uint32_t most = 0;  // of the densest scan
    for (const auto& scan : quality.scans) most = std::max(most, scan.counts[k]);
    if (most > 0) spacing_m[k] = quality.radius_m * std::sqrt(M_PI / most);
  }
  quality.patches = surfaceHoles(quality.samples, spacing_m, kMostPatches);
}

void comparePoses(SurveyQuality& quality, const Job& job) {
  for (auto& station : quality.stations)
    for (const auto& scan : quality.scans) {
      if (scan.station != station.station || scan.moved || !scan.has_pose) continue;
      const auto& truth = job.stations[scan.station].true_pose;
      station.pose_error_m =
          std::max(station.pose_error_m.value_or(0), (scan.placed.translation - truth.translation).norm());
      station.pose_error_rad =
          std::max(station.pose_error_rad.value_or(0), scan.placed.rotation.angularDistance(truth.rotation));
    }
}

void countTargets(SurveyQuality& quality, const Job& job, const RayScene& model, const TargetRules& rules) {
  for (auto& station : quality.stations) {
    if (job.targets.empty()) return;
    Job alone;
    alone.stations.push_back(job.stations[station.station]);
    std::size_t count = 0;
    for (const auto& target : job.targets) {
      const auto sights = sightsOf(alone, model, target, rules, {});
      if (!sights) return quality.report.append(Report{{{Severity::warning, target.name, sights.error().message}}});
      count += static_cast<std::size_t>(sights->front().why_not.empty());
    }
    station.targets = count;
  }
}

}  // namespace

std::optional<WorstCell> worstPlace(const std::vector<Vector3d>& places, const std::vector<double>& values,
                                    WorstBy by) {
  constexpr double kCell_m = 1;
  constexpr std::size_t kFewest = 5;  // places in a cell whose mean says something
  struct Sum {
    Vector3d place = Vector3d::Zero();
    double value = 0;
    std::size_t count = 0;
  };
  using Index = std::array<std::int64_t, 3>;
  const auto cellOf = [](const Vector3d& place) {
    const Cell cell = cellAt(place, kCell_m);
    return Index{cell.x(), cell.y(), cell.z()};
  };
  std::map<Index, Sum> cells;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i].allFinite()) continue;
    auto& sum = cells[cellOf(places[i])];
    sum.place += places[i];
    sum.value += values[i];
    ++sum.count;
  }
  const auto worth = [by](const Sum& sum) {
    if (by == WorstBy::number) return sum.value;
    const double mean = sum.value / static_cast<double>(sum.count);
    return sum.count < kFewest ? mean * 1e-6 : mean;  // of few only where there is nothing else
  };
  const std::pair<const Index, Sum>* worst = nullptr;
  for (const auto& cell : cells)
    if (worst == nullptr || worth(cell.second) > worth(worst->second)) worst = &cell;
  if (worst == nullptr) return std::nullopt;
  const auto count = static_cast<double>(worst->second.count);
  // Between two faces of a slab nothing could be shown.
  const Vector3d middle = worst->second.place / count;
  const Vector3d* nearest = nullptr;
  for (const auto& place : places)
    if (place.allFinite() && cellOf(place) == worst->first &&
        (nearest == nullptr || (place - middle).squaredNorm() < (*nearest - middle).squaredNorm()))
      nearest = &place;
  return WorstCell{*nearest, by == WorstBy::mean ? worst->second.value / count : worst->second.value};
}

double fractile(std::vector<double>& values, double fraction) {
  if (values.empty()) return 0;
  const auto at = values.begin() + std::lround(fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

Result<SurveyQuality> assessSurvey(const Job& job, const std::shared_ptr<const RayScene>& scene, const RayScene& model,
                                   const std::shared_ptr<const MaterialAssignment>& assignment,
                                   const QualityRequest& request, Progress& progress) {
  SurveyQuality quality;
  quality.radius_m = request.radius_m;
  progress.stage("Sample surfaces", 0, 0.1);
  TRY_ASSIGN(quality.samples, sampleSurfaces(*scene, request.samples, request.seed, progress));
  const SampleCells cells(*scene, quality.samples, request.radius_m);
  const ModelSurface surface(scene->environment());
  Expectations expectations(scene, assignment);
  const Assessing with{job, request, quality.samples, cells, surface, expectations};
  Assessment assessment(with, quality);
  TRY(assessment.read(scanFilesOf(job), progress));
  assessment.tellStations();
  progress.stage("Judge", 0.95, 1);
  std::vector<Vector3d> stands;
  for (const auto s : request.stations) stands.push_back(job.stations[s].true_pose.translation);
  quality.surveyed = surveyedSamples(quality.samples, model, stands);
  seeByStation(quality, request);
  comparePoses(quality, job);
  countTargets(quality, job, model, request.target_rules);
  std::vector<const std::vector<std::uint8_t>*> seen;
  for (const auto& station : quality.stations) seen.push_back(&station.seen);
  quality.seen = countSeen(quality.samples, scene->environment(), seen);
  findHoles(quality);
  quality.rows = qualityRows(quality, job, request.limits);
  return quality;
}

}  // namespace standpoint
