// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "core/random.h"
#include "pointclouds/formats.h"
#include "project/answers.h"
#include "project/survey/moving_scan.h"
#include "project/survey/scan_header.h"
#include "project/survey/scan_preparation.h"
#include "project/survey/scan_request.h"
#include "project/survey/survey_verbs.h"
#include "project/survey/watched_sink.h"
#include "scanners/camera/panorama.h"
#include "survey/scanning/empty_scan.h"
#include "survey/scanning/scan_identity.h"
#include "survey/scanning/scan_parts.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;

ScanAnswerRow scanRow(const Station& station, const ScanCount& count, double seconds, const ScanRequest& request,
                      const fs::path& file) {
  return {station.name,  count.points, count.pulses,
          count.returns, seconds,      request.settings.scan_seconds + request.settings.imaging_seconds,
          file,          std::nullopt};
}

Scan record(const ScanCount& count, const ScanRequest& request, const fs::path& file, const Pose& pose,
            const std::vector<Target>& targets) {
  Scan s;
  s.instrument = request.instrument.id;
  s.file = fs::absolute(file).lexically_normal().string();
  s.format = request.format->name;
  s.settings = request.settings.values;
  s.seed = request.options.seed;
  s.pulses = count.pulses;
  s.points = count.points;
  s.instrument_seconds = request.settings.scan_seconds + request.settings.imaging_seconds;
  s.as_scanned = AsScanned{pose, targets};
  return s;
}

// What one station is of the whole, and how that is called.
struct ProgressSpan {
  std::string name;
  double from = 0, to = 1;
};

// Images come after the laser's turn, or, where they take no time of their own, during it.
PictureTimes pictureTimesOf(const ScanRequest& request) {
  const auto& settings = request.settings;
  const double begins_s = request.options.bodies_ahead_s;
  if (settings.imaging_seconds <= 0) return {begins_s, settings.scan_seconds};
  return {begins_s + settings.scan_seconds, settings.imaging_seconds};
}

// One station into an open sink. Its pictures are taken to be half of it: how long they take depends on both sizes.
Result<ScanCount> scanStation(const RayScene& scene, const ScanWorld& world, const Station& station,
                              const ScanHeader& header, const ScanRequest& request, PointSink& file, Report& report,
                              const ProgressSpan& span, Progress& progress) {
  std::unique_ptr<PointSink> coloured;
  const double pictures_to = !request.panorama        ? span.from
                             : request.settings.laser ? (span.from + span.to) / 2
                                                      : span.to;
  if (request.panorama) {
    progress.stage("Images at " + span.name, span.from, pictures_to);
    TRY_ASSIGN(auto panorama,
               takePanorama(scene, request.instrument, station.true_pose, request.options.threads, report, progress,
                            meteringOf(request.instrument, request.settings.values), pictureTimesOf(request)));
    coloured = colouring(file, std::make_shared<const Panorama>(std::move(panorama)));
  }
  progress.stage("Scan " + span.name, pictures_to, span.to);
  PointSink& sink = coloured ? *coloured : file;
  TRY(sink.begin(header));
  if (!request.settings.laser) {  // pictures only
    TRY(sink.end());
    return ScanCount{};
  }
  ScanOptions options = request.options;
  options.station_key = static_cast<std::uint32_t>(stableHash(station.name.c_str()));
  auto count = scanWithFieldFault(scene, world.assignment, request.instrument, request.settings, station.true_pose,
                                  options, request.field_fault, sink, progress);
  if (!count) return count;
  TRY(sink.end());
  return count;
}

// Many stations, one after the other: into one file or a file each, with what is finished kept for a run to come.
class ScanRun {
 public:
  ScanRun(const Document& document, const ScanRequest& request, const ScanSurroundings& company,
          std::vector<Pose> believed)
      : document_(document),
        request_(request),
        world_(company.preparation->world),
        scene_(*company.preparation->scene),
        watcher_(company.watcher.get()),
        believed_(std::move(believed)),
        company_believes_(company.believed.has_value()),
        fingerprint_(company.preparation->fingerprint),
        parts_(request.output),
        job_(*document.job) {}

  Result<void> run(Progress& progress) {
    if (auto ok = checkEarlier(); !ok) return ok;
    for (std::size_t k = 0; k < request_.stations.size(); ++k)
      if (auto ok = station(k, progress); !ok) return withHint(ok.error());
    if (request_.stations.size() > 1)
      for (const auto index : request_.stations) parts_.remove(job_.stations[index].name);
    return {};
  }

  std::vector<ScanAnswerRow> rows;
  Report report;
  Job& job() { return job_; }

 private:
  bool isBatch() const { return request_.stations.size() > 1; }
  bool isJoined() const { return isBatch() && request_.one_file; }

  // What an earlier run finished is never thrown away unasked.
  Result<void> checkEarlier() const {
    if (request_.resume || !isBatch()) return {};
    std::vector<std::string> names;
    for (const auto index : request_.stations)
      if (parts_.hasRecord(job_.stations[index].name)) names.push_back(job_.stations[index].name);
    if (names.empty()) return {};
    return failure(
        ErrorKind::usage,
        fmt::format("an earlier run finished {}: resume it, or remove that folder first", fmt::join(names, ", ")),
        parts_.folder().string());
  }

  tl::unexpected<Error> withHint(Error error) const {
    if (!finished_.empty())
      error.message += fmt::format("; finished and kept: {}; resume the scan to continue", fmt::join(finished_, ", "));
    return tl::unexpected<Error>(std::move(error));
  }

  Result<void> station(std::size_t k, Progress& progress) {
    const auto started = std::chrono::steady_clock::now();
    Station& station = job_.stations[request_.stations[k]];
    const auto file = fileOf(request_, station);
    const ScanRequest request = requestAt(request_, request_.stations[k]);
    const auto guid = guidOf(fingerprint_, station, believed_[k], request);
    const auto span = spanOf(k);
    progress.stage("Scan " + span.name, span.from, span.to);
    const auto earlier = request_.resume && isBatch() ? parts_.finished(station.name, guid) : std::nullopt;
    const bool is_there = earlier && isWhole(station.name, file, earlier->bytes);
    TRY_ASSIGN(auto count,
               is_there ? taken(k, file, guid, *earlier, progress) : scanned(k, file, guid, request, progress));
    finished_.push_back(station.name);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    rows.push_back(scanRow(station, count, seconds, request_, file));
    if (is_there) rows.back().resumed = true;
    if (count.points == 0 && request_.settings.laser)
      report.warn(station.name, whyNothing(scene_, station.true_pose, request_.instrument, request_.settings));
    station.scans.push_back(record(count, request_, file, station.true_pose, job_.targets));
    return {};
  }

  ProgressSpan spanOf(std::size_t k) const {
    const double each = 1.0 / static_cast<double>(request_.stations.size());
    const std::string place = isBatch() ? fmt::format(" ({} of {})", k + 1, request_.stations.size()) : "";
    return {job_.stations[request_.stations[k]].name + place, static_cast<double>(k) * each,
            static_cast<double>(k + 1) * each};
  }

  bool isWhole(const std::string& name, const fs::path& file, std::uint64_t bytes) const {
    std::error_code code;
    return fs::file_size(isJoined() ? parts_.pointsOf(name) : file, code) == bytes && !code;
  }

  ScanHeader header(std::size_t k, const std::string& guid) const {
    const std::size_t index = request_.stations[k];
    const auto& station = job_.stations[index];
    auto made = scanHeader(document_, world_, station.name, believed_[k], guid, requestAt(request_, index),
                           kFirstStart_gps_s + stationStart_s(request_, index));
    if (company_believes_ && made.has_truth) {
      made.true_file_from_scanner = station.true_pose;
      made.true_file_from_scanner->translation += document_.georeference->shift_m;
    }
    return made;
  }

  // Of a station that was finished before.
  Result<ScanCount> taken(std::size_t k, const fs::path& file, const std::string& guid,
                          const ScanParts::Finished& earlier, Progress& progress) {
    if (!isJoined()) return earlier.count;
    const auto& name = job_.stations[request_.stations[k]].name;
    TRY(open(file));
    const auto watched = watchedOr(*sink_);
    PointSink& sink = watched ? *watched : *sink_;
    TRY(sink.begin(header(k, guid)));
    TRY(playTape(parts_.pointsOf(name), sink, progress));
    TRY(sink.end());
    TRY(closeAfter(k));
    return earlier.count;
  }

  Result<ScanCount> scanned(std::size_t k, const fs::path& file, const std::string& guid, const ScanRequest& request,
                            Progress& progress) {
    const auto& station = job_.stations[request_.stations[k]];
    TRY(open(file));
    std::unique_ptr<PointTape> tape;
    if (isJoined()) {
      TRY_ASSIGN(auto made, PointTape::create(parts_.pointsOf(station.name), *sink_));
      tape = std::move(made);
    }
    PointSink& file_sink = tape ? static_cast<PointSink&>(*tape) : *sink_;
    const auto watched = watchedOr(file_sink);
    PointSink& sink = watched ? *watched : file_sink;
    auto count = scanStation(scene_, world_, station, header(k, guid), request, sink, report, spanOf(k), progress);
    if (!count) return count;
    if (tape) TRY(tape->close());
    TRY(closeAfter(k));
    if (!isBatch()) return count;
    std::error_code code;
    const std::uint64_t bytes = tape ? tape->size() : fs::file_size(file, code);
    TRY(parts_.record(station.name, guid, {*count, bytes}));
    return count;
  }

  // Null where nobody watches.
  std::unique_ptr<PointSink> watchedOr(PointSink& file) const {
    return watcher_ == nullptr ? nullptr : std::make_unique<WatchedSink>(file, *watcher_);
  }

  Result<void> open(const fs::path& file) {
    if (sink_) return {};
    TRY_ASSIGN(auto opened, request_.writer(file));
    sink_ = std::move(opened);
    return {};
  }

  Result<void> closeAfter(std::size_t k) {
    if (request_.one_file && k + 1 < request_.stations.size()) return {};
    if (auto ok = sink_->close(); !ok) return ok;
    report.append(sink_->report());
    sink_.reset();
    return {};
  }

  const Document& document_;
  const ScanRequest& request_;
  const ScanWorld& world_;
  const RayScene& scene_;
  PointSink* watcher_;
  std::vector<Pose> believed_;
  bool company_believes_ = false;
  std::uint64_t fingerprint_ = 0;
  ScanParts parts_;
  Job job_;
  std::unique_ptr<CloudWriter> sink_;
  std::vector<std::string> finished_;
};

}  // namespace

const AnswerFields<ScanAnswerRow>& answerFields(const ScanAnswerRow*) {
  using A = ScanAnswerRow;
  static const AnswerFields<A> fields = {{"station", &A::station}, {"points", &A::points},
                                         {"pulses", &A::pulses},   {"returns", &A::returns},
                                         {"seconds", &A::seconds}, {"instrument_seconds", &A::instrument_seconds},
                                         {"file", &A::file},       {"resumed", &A::resumed, kLeftOut}};
  return fields;
}

const AnswerFields<ScanAnswer>& answerFields(const ScanAnswer*) {
  static const AnswerFields<ScanAnswer> fields = {{"stations", &ScanAnswer::stations}};
  return fields;
}

namespace {

// Of stations or trajectories, by their names.
template <class Scanned>
void carryScans(const std::vector<Scanned>& base, const std::vector<Scanned>& result, std::vector<Scanned>& newest) {
  const auto find = [](auto& all, const std::string& name) {
    const auto at = std::find_if(all.begin(), all.end(), [&](const auto& s) { return s.name == name; });
    return at == all.end() ? nullptr : &*at;
  };
  for (const auto& scanned : result) {
    const auto* before = find(base, scanned.name);
    auto* now = find(newest, scanned.name);
    if (before == nullptr || now == nullptr) continue;
    const auto first = static_cast<std::ptrdiff_t>(before->scans.size());
    now->scans.insert(now->scans.end(), scanned.scans.begin() + first, scanned.scans.end());
  }
}

}  // namespace

Document scansCarriedOver(const Document& base, const Document& result, const Document& newest) {
  Job job = *newest.job;
  carryScans(base.job->stations, result.job->stations, job.stations);
  carryScans(base.job->trajectories, result.job->trajectories, job.trajectories);
  Document carried = newest;
  carried.job = std::make_shared<const Job>(std::move(job));
  carried.scanning = result.scanning;
  return carried;
}

Result<Answered<ScanAnswer>> runScan(const Document& document, const ScanVerbOptions& options, Progress& progress) {
  return runScan(document, options, ScanSurroundings(), progress);
}

Result<Answered<ScanAnswer>> runScan(const Document& document, const ScanVerbOptions& options,
                                     const ScanSurroundings& company, Progress& progress) {
  if (!options.trajectory.empty()) return runMovingScan(document, options, company, progress);
  TRY_ASSIGN(auto request, scanRequestFrom(document, options));
  Answered<ScanAnswer> outcome{document};
  std::vector<Pose> believed;
  for (const auto index : request.stations) {
    TRY_ASSIGN(auto pose,
               believedPose(document.job->stations[index], request.instrument, request.levelling, outcome.report));
    believed.push_back(company.believed.value_or(pose));
  }
  noteDefaultRules(document, outcome.report);
  ScanSurroundings at_hand = company;
  const bool with_movers = options.movers == Switch::on;
  if (!at_hand.preparation || !at_hand.preparation->fits(document, with_movers)) {
    TRY_ASSIGN(auto made, prepareScan(document, nullptr, progress, with_movers));
    at_hand.preparation = std::move(made);
  }
  ScanRun scan_run(document, request, at_hand, std::move(believed));
  TRY(scan_run.run(progress));
  outcome.report.append(scan_run.report);
  outcome.description =
      fmt::format("Scanned {} station{} with {} {}", scan_run.rows.size(), scan_run.rows.size() == 1 ? "" : "s",
                  request.instrument.maker, request.instrument.model);
  outcome.answer.stations = std::move(scan_run.rows);
  outcome.document.scanning = std::make_shared<const ScanChoice>(choiceOf(request));
  outcome.document.job = std::make_shared<const Job>(std::move(scan_run.job()));
  return outcome;
}

}  // namespace standpoint
