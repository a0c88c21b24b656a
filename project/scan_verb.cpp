// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <chrono>
#include <cstdio>

#include <fmt/format.h>

#include "core/random.h"
#include "pointclouds/formats.h"
#include "project/answers.h"
#include "project/geodesy.h"
#include "project/instruments.h"
#include "project/model_verbs.h"
#include "project/survey_verbs.h"
#include "scanners/panorama.h"

namespace standpoint {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

// The simulation's clock is not the wall clock, so that the same job gives the same bytes: the first station starts on
// 2026-01-01 09:00:00 UTC, in seconds since 1980-01-06 without leap seconds.
constexpr double kFirstStart_gps_s = 1451293200.0;

struct ScanRequest {
  Instrument instrument;
  ScanSettings settings;
  ScanOptions options;
  std::vector<std::size_t> stations;   // indices into the job
  const CloudFormat* format = nullptr;
  fs::path output;
  bool one_file = false;               // all stations in `output`; else a file each
  bool panorama = false;
};

Result<std::vector<std::size_t>> stationsFrom(const Job& job, const std::string& wanted) {
  std::vector<std::size_t> result;
  if (job.stations.empty())
    return failure(ErrorKind::usage, "there is no station yet: add one with `standpoint station PROJECT --add S1 --on X,Y`",
                   "--stations");
  if (wanted == "all") {
    for (std::size_t i = 0; i < job.stations.size(); ++i) result.push_back(i);
    return result;
  }
  for (std::size_t from = 0; from <= wanted.size();) {
    const auto comma = std::min(wanted.find(',', from), wanted.size());
    const auto name = wanted.substr(from, comma - from);
    const auto at = std::find_if(job.stations.begin(), job.stations.end(), [&](const Station& s) { return s.name == name; });
    if (at == job.stations.end()) return failure(ErrorKind::usage, fmt::format("there is no station '{}'", name), "--stations");
    result.push_back(static_cast<std::size_t>(at - job.stations.begin()));
    from = comma + 1;
  }
  return result;
}

// --shard i/n keeps the stations i, i+n, i+2n, …; every random number belongs to its station, so shards together give the
// same bytes as the whole.
Result<void> shard(std::vector<std::size_t>& stations, const std::string& text) {
  unsigned i = 0;
  unsigned n = 0;
  if (std::sscanf(text.c_str(), "%u/%u", &i, &n) != 2 || n == 0 || i == 0 || i > n)
    return failure(ErrorKind::usage, fmt::format("'{}' is not i/n with 1 <= i <= n", text), "--shard");
  std::vector<std::size_t> kept;
  for (std::size_t k = i - 1; k < stations.size(); k += n) kept.push_back(stations[k]);
  stations = std::move(kept);
  return {};
}

Result<void> chooseOutput(ScanRequest& request, const fs::path& output) {
  request.output = output;
  if (output.has_extension() && !fs::is_directory(output)) {
    request.format = cloudFormatFor(output);
    if (request.format == nullptr || request.format->writer == nullptr) {
      std::vector<std::string> names;
      for (const auto& f : cloudFormats())
        if (f.writer != nullptr) names.emplace_back(f.extension);
      return failure(ErrorKind::usage, fmt::format("'{}' cannot be written; there is {}, or name a folder",
                                                   output.extension().string(), fmt::join(names, ", ")), "--output");
    }
    request.one_file = request.format->many_scans || request.stations.size() == 1;
    return {};
  }
  request.format = cloudFormatFor("x.e57");
  std::error_code error;
  fs::create_directories(output, error);
  if (error) return failure(ErrorKind::file_system, "cannot create the folder: " + error.message(), output.string());
  return {};
}

fs::path fileOf(const ScanRequest& request, const Station& station) {
  if (request.one_file) return request.output;
  if (request.output.has_extension() && !fs::is_directory(request.output))
    return request.output.parent_path() / (request.output.stem().string() + "-" + station.name + request.format->extension);
  return request.output / (station.name + request.format->extension);
}

std::uint64_t mix(std::uint64_t hash, const std::string& text) { return stableHash(text.c_str(), hash); }

Result<Effects> effectsFrom(const json& options) {
  if (options.value("ideal", false)) {
    if (options.contains("without"))
      return failure(ErrorKind::usage, "an ideal scan is without all effects already", "--without");
    return Effects::none();
  }
  return options.contains("without") ? effectsWithout(options["without"].get<std::string>()) : Result<Effects>(Effects());
}

// ", ideal", ", without striping, footprint", or nothing.
std::string withoutText(Effects effects) {
  if (effects == Effects::none()) return ", ideal";
  std::string text;
  for (const auto& [effect, name, description] : effectNames())
    if (!effects.has(effect)) text += (text.empty() ? ", without " : ", ") + std::string(name);
  return text;
}

// 128 bits of what the scan is, written as a version-8 UUID: the same scan has the same guid, another has another.
std::string guidOf(const ScanWorld& world, const Station& station, const ScanRequest& request) {
  std::uint64_t a = stableHash("standpoint scan");
  a = mix(a, request.instrument.id);
  for (const auto& [key, value] : request.settings.values) a = mix(mix(a, key), value);
  a = mix(a, fmt::format("{} {} {}", request.options.seed, request.options.effects.bits(), station.name));
  std::uint64_t b = mix(a, fmt::format("{} {} {}", station.true_pose.translation.x(), station.true_pose.translation.y(),
                                       station.true_pose.translation.z()));
  for (const auto& i : world.environment->instances) {
    const auto& m = *world.environment->meshes[i.mesh];
    b = mix(b, fmt::format("{} {} {}", m.positions.size(), m.triangles.size(), i.world_from_mesh(0, 3)));
  }
  return fmt::format("{{{:08x}-{:04x}-8{:03x}-{:04x}-{:012x}}}", a >> 32U, (a >> 16U) & 0xFFFFU, a & 0xFFFU,
                     0x8000U | ((b >> 48U) & 0x3FFFU), b & 0xFFFFFFFFFFFFU);
}

ScanHeader headerOf(const Document& document, const ScanWorld& world, const Station& station, const ScanRequest& request,
                    double start_gps_s) {
  const auto& g = *document.georeference;
  ScanHeader h;
  h.name = station.name;
  h.guid = guidOf(world, station, request);
  h.sensor_vendor = request.instrument.maker;
  h.sensor_model = request.instrument.model;
  h.sensor_serial = "simulated";
  std::vector<std::string> words;
  for (const auto& [key, value] : request.settings.values) words.push_back(key + "=" + value);
  h.description = fmt::format("Simulated by Standpoint: {} {}, {}, seed {}{}", request.instrument.maker,
                              request.instrument.model, fmt::join(words, " "), request.options.seed,
                              withoutText(request.options.effects));
  h.file_from_scanner = station.true_pose;
  h.file_from_scanner.translation += g.shift_m;
  h.rows = request.settings.rows;
  h.columns = request.settings.columns;
  h.has_colour = request.settings.imaging;
  h.has_labels = true;
  h.has_time = request.options.channels.time;
  h.has_returns = request.options.channels.returns;
  h.has_truth = request.options.channels.truth;
  h.acquisition_start_gps_s = start_gps_s;
  h.acquisition_seconds = request.settings.scan_seconds + request.settings.imaging_seconds;
  if (!g.crs.empty() && !g.map_from_file)
    if (const auto crs = findCrs(g.crs)) h.coordinate_metadata = crs->wkt;
  for (const auto& p : world.environment->products) h.products.push_back({p.id, p.global_id, p.ifc_class, p.name});
  h.products.push_back({"", "", "Nothing", "no surface"});   // the label of a drop, or of the receiver's own noise
  for (const auto& m : world.assignment.materials) h.materials.push_back(m.id);
  h.materials.emplace_back("unassigned");  // the label of a point whose surface has no material
  return h;
}

Result<ScanRequest> requestFrom(const Document& document, const json& options) {
  ScanRequest request;
  auto instrument = instrumentById(options.at("instrument").get<std::string>());
  if (!instrument) return failure(instrument.error());
  request.instrument = *std::move(instrument);
  SettingValues values;
  for (const auto& pair : options.value("set", json::array())) {
    const auto text = pair.get<std::string>();
    values.emplace_back(text.substr(0, text.find('=')), text.substr(text.find('=') + 1));
  }
  auto settings = resolveSettings(request.instrument, values);
  if (!settings) return failure(settings.error());
  request.settings = *std::move(settings);
  request.options.seed = options.at("seed").get<std::uint64_t>();
  if (auto effects = effectsFrom(options); effects) request.options.effects = *effects;
  else return failure(effects.error());
  if (options.contains("weather")) {
    auto weather = weatherFrom(options["weather"].get<std::string>());
    if (!weather) return failure(weather.error());
    request.options.weather = *weather;
  }
  request.panorama = options.value("panorama", false);
  if (request.panorama && !request.settings.imaging)
    return failure(ErrorKind::usage, "these settings take no images: a panorama needs them", "--panorama");
  const bool truth = options.value("truth", false);
  request.options.channels = {.time = truth, .returns = truth || request.instrument.waveform.most_returns > 1, .truth = truth};
  request.options.threads = options.at("threads").get<int>();
  auto stations = stationsFrom(*document.job, options.at("stations").get<std::string>());
  if (!stations) return failure(stations.error());
  request.stations = *std::move(stations);
  if (options.contains("shard"))
    if (auto ok = shard(request.stations, options["shard"].get<std::string>()); !ok) return failure(ok.error());
  if (auto ok = chooseOutput(request, options.at("output").get<std::string>()); !ok) return failure(ok.error());
  return request;
}

json scanRow(const Station& station, const ScanCount& count, double seconds, const ScanRequest& request, const fs::path& file) {
  return {{"station", station.name},
          {"points", count.points},
          {"pulses", count.pulses},
          {"returns", count.returns},
          {"seconds", seconds},
          {"instrument_seconds", request.settings.scan_seconds + request.settings.imaging_seconds},
          {"file", file.string()}};
}

Scan record(const ScanCount& count, const ScanRequest& request, const fs::path& file) {
  Scan s;
  s.instrument = request.instrument.id;
  s.file = file.string();
  s.format = request.format->name;
  s.settings = request.settings.values;
  s.seed = request.options.seed;
  s.pulses = count.pulses;
  s.points = count.points;
  s.instrument_seconds = request.settings.scan_seconds + request.settings.imaging_seconds;
  return s;
}

// One station into an open sink.
Result<ScanCount> scanStation(const Document& document, const RayScene& scene, const ScanWorld& world,
                              const Station& station, const ScanRequest& request, double start_gps_s, PointSink& file,
                              Report& report, Progress& progress) {
  std::unique_ptr<PointSink> coloured;
  if (request.panorama) {
    auto panorama = takePanorama(scene, request.instrument, station.true_pose, request.options.threads, report, progress);
    if (!panorama) return failure(panorama.error());
    coloured = colouring(file, std::make_shared<const Panorama>(*std::move(panorama)));
  }
  PointSink& sink = coloured ? *coloured : file;
  if (auto ok = sink.begin(headerOf(document, world, station, request, start_gps_s)); !ok) return failure(ok.error());
  ScanOptions options = request.options;
  options.station_key = static_cast<std::uint32_t>(stableHash(station.name.c_str()));
  const Trajectory tripod{{0}, {station.true_pose}};
  auto count = scan(scene, world.assignment, request.instrument, request.settings, tripod, options, sink, progress);
  if (!count) return count;
  if (auto ok = sink.end(); !ok) return failure(ok.error());
  return count;
}

Result<MaterialAssignment> assignmentOf(const Document& document, Report& report, Progress& progress) {
  if (document.materials) return document.materials->result.assignment;
  report.note("materials", "no materials were assigned yet; the default rules were used for this scan");
  auto assigned = assignDocumentMaterials(document, {}, progress);
  if (!assigned) return failure(assigned.error());
  return assigned->document.materials->result.assignment;
}

}  // namespace

Result<Outcome> runScan(const Document& document, const json& options, Progress& progress) {
  auto request = requestFrom(document, options);
  if (!request) return failure(request.error());
  Outcome outcome{document, json::object(), {}, {}};
  auto assignment = assignmentOf(document, outcome.report, progress);
  if (!assignment) return failure(assignment.error());
  const ScanWorld world = scanWorld(document, *assignment);
  auto scene = RayScene::build(world.environment, progress);
  if (!scene) return failure(scene.error());

  Job job = *document.job;
  json rows = json::array();
  std::unique_ptr<CloudWriter> sink;
  const double each = 1.0 / static_cast<double>(std::max<std::size_t>(1, request->stations.size()));
  for (std::size_t k = 0; k < request->stations.size(); ++k) {
    const auto started = std::chrono::steady_clock::now();
    Station& station = job.stations[request->stations[k]];
    const auto file = fileOf(*request, station);
    if (!sink) {
      auto opened = request->format->writer(file);
      if (!opened) return failure(opened.error());
      sink = *std::move(opened);
    }
    progress.stage("Scan " + station.name, static_cast<double>(k) * each, static_cast<double>(k + 1) * each);
    const double start = kFirstStart_gps_s + static_cast<double>(request->stations[k]) *
                                                 (request->settings.scan_seconds + request->settings.imaging_seconds);
    auto count = scanStation(document, **scene, world, station, *request, start, *sink, outcome.report, progress);
    if (!count) return failure(count.error());
    if (!request->one_file || k + 1 == request->stations.size()) {
      if (auto ok = sink->close(); !ok) return failure(ok.error());
      outcome.report.append(sink->report());
      sink.reset();
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    rows.push_back(scanRow(station, *count, seconds, *request, file));
    station.scans.push_back(record(*count, *request, file));
  }
  outcome.description = fmt::format("Scanned {} station{} with {} {}", rows.size(), rows.size() == 1 ? "" : "s",
                                    request->instrument.maker, request->instrument.model);
  outcome.answer["stations"] = std::move(rows);
  outcome.document.job = std::make_shared<const Job>(std::move(job));
  return outcome;
}

}  // namespace standpoint
