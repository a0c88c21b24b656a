// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/scan_request.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "project/instruments.h"
#include "project/model_verbs.h"
#include "project/output_place.h"
#include "scanners/instruments/chosen_effect.h"

namespace standpoint {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

// --shard i/n keeps the stations i, i+n, i+2n, …; every random number belongs to its station, so shards together give
// the same bytes as the whole.
Result<void> shard(std::vector<std::size_t>& stations, const std::string& text) {
  unsigned i = 0;
  unsigned n = 0;
  if (std::sscanf(text.c_str(), "%u/%u", &i, &n) != 2 || n == 0 || i == 0 || i > n)
    return failure(ErrorKind::usage, fmt::format("'{}' must be i/n with 1 <= i <= n", text), "--shard");
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
      return failure(ErrorKind::usage,
                     fmt::format("unsupported format '{}'; use {}, or specify a folder", output.extension().string(),
                                 fmt::join(names, ", ")),
                     "--output");
    }
    request.one_file = request.format->many_scans || request.stations.size() == 1;
    return checkFolderOf(output, "--output");
  }
  request.format = cloudFormatFor("x.e57");
  std::error_code error;
  fs::create_directories(output, error);
  if (error) return failure(ErrorKind::file_system, "cannot create the folder: " + error.message(), output.string());
  return {};
}

Result<Effects> effectsFrom(const json& options) {
  if (options.value("ideal", false)) {
    if (options.contains("without"))
      return failure(ErrorKind::usage, "an ideal scan already excludes all effects", "--without");
    return Effects::none();
  }
  return options.contains("without") ? effectsWithout(options["without"].get<std::string>())
                                     : Result<Effects>(Effects());
}

}  // namespace

std::string leftOut(Effects effects) {
  std::string names;
  for (const auto& e : effectNames())
    if (!effects.has(e.effect)) names += (names.empty() ? "" : ",") + std::string(e.name);
  return names;
}

ScanChoice choiceOf(const ScanRequest& request) {
  return {.instrument = request.instrument.id,
          .settings = request.settings.values,
          .seed = request.options.seed,
          .effects = request.options.effects,
          .weather = request.options.weather,
          .truth = request.options.channels.truth,
          .compensator = request.levelling.compensator,
          .panorama = request.panorama,
          .panorama_columns = request.panorama_columns};
}

Result<std::vector<std::size_t>> stationsFrom(const Job& job, const std::string& wanted) {
  std::vector<std::size_t> result;
  if (job.stations.empty())
    return failure(ErrorKind::usage,
                   "there are no stations: add one with `standpoint station PROJECT --add S1 --on X,Y`", "--stations");
  if (wanted == "all") {
    for (std::size_t i = 0; i < job.stations.size(); ++i) result.push_back(i);
    return result;
  }
  for (std::size_t from = 0; from <= wanted.size();) {
    const auto comma = std::min(wanted.find(',', from), wanted.size());
    const auto name = wanted.substr(from, comma - from);
    const auto at =
        std::find_if(job.stations.begin(), job.stations.end(), [&](const Station& s) { return s.name == name; });
    if (at == job.stations.end())
      return failure(ErrorKind::usage, fmt::format("unknown station '{}'", name), "--stations");
    result.push_back(static_cast<std::size_t>(at - job.stations.begin()));
    from = comma + 1;
  }
  return result;
}

Result<ScanSettings> settingsFrom(const Instrument& instrument, const json& options) {
  SettingValues values;
  for (const auto& pair : options.value("set", json::array())) {
    const auto text = pair.get<std::string>();
    values.emplace_back(text.substr(0, text.find('=')), text.substr(text.find('=') + 1));
  }
  return resolveSettings(instrument, values);
}

fs::path fileOf(const ScanRequest& request, const Station& station) {
  if (request.one_file) return request.output;
  if (request.output.has_extension() && !fs::is_directory(request.output))
    return request.output.parent_path() /
           (request.output.stem().string() + "-" + station.name + request.format->extension);
  return request.output / (station.name + request.format->extension);
}

Result<ScanRequest> scanRequestFrom(const Document& document, const json& options) {
  ScanRequest request;
  auto instrument = instrumentById(options.at("instrument").get<std::string>());
  if (!instrument) return failure(instrument.error());
  request.instrument = *std::move(instrument);
  auto settings = settingsFrom(request.instrument, options);
  if (!settings) return failure(settings.error());
  request.settings = *std::move(settings);
  request.instrument.camera = request.settings.camera;
  if (const auto most = chosenEffect(request.instrument, request.settings.values, "most_returns"))
    request.instrument.waveform.max_returns = static_cast<int>(*most);
  request.options.seed = options.at("seed").get<std::uint64_t>();
  if (auto effects = effectsFrom(options); effects)
    request.options.effects = *effects;
  else
    return failure(effects.error());
  if (options.contains("weather")) {
    auto weather = weatherFrom(options["weather"].get<std::string>());
    if (!weather) return failure(weather.error());
    request.options.weather = *weather;
  }
  if (options.contains("sun")) {
    auto sun = sunFrom(options["sun"].get<std::string>());
    if (!sun) return failure(sun.error());
    request.options.sun = *sun;
  }
  request.options.interference = options.value("interference", 0.0);
  if (options.contains("field-fault")) {
    auto field_fault = fieldFaultFrom(options["field-fault"].get<std::vector<std::string>>());
    if (!field_fault) return failure(field_fault.error());
    request.field_fault = *field_fault;
  }
  if (options.contains("note")) request.notes = options["note"].get<std::vector<std::string>>();
  request.levelling = {.compensator = options.at("compensator") == "on",
                       .exact = !request.options.effects.has(Effect::levelling),
                       .seed = request.options.seed};
  request.panorama = options.value("panorama", false);
  if (request.panorama && !request.settings.imaging)
    return failure(ErrorKind::usage, "a panorama requires settings that take images", "--panorama");
  if (!request.panorama && !request.settings.laser)
    return failure(ErrorKind::usage, "these settings measure no points and no panorama is requested", "--set");
  if (options.contains("panorama-size")) {
    const auto columns = options["panorama-size"].get<std::uint32_t>();
    if (!request.panorama) return failure(ErrorKind::usage, "requires --panorama", "--panorama-size");
    if (columns % 2 != 0)
      return failure(ErrorKind::usage,
                     fmt::format("{} is odd: use an even width, since the height is half the width", columns),
                     "--panorama-size");
    request.instrument.camera.columns = columns;
    request.panorama_columns = columns;
  }
  const bool truth = options.value("truth", false);
  request.options.channels = {
      .time = truth, .returns = truth || request.instrument.waveform.max_returns > 1, .truth = truth};
  request.options.threads = options.at("threads").get<int>();
  auto stations = stationsFrom(*document.job, options.at("stations").get<std::string>());
  if (!stations) return failure(stations.error());
  request.stations = *std::move(stations);
  if (options.contains("shard"))
    if (auto ok = shard(request.stations, options["shard"].get<std::string>()); !ok) return failure(ok.error());
  if (auto ok = chooseOutput(request, options.at("output").get<std::string>()); !ok) return failure(ok.error());
  request.as = options.value("as", "");
  const auto writer = writerOf(*request.format, request.as);
  if (!writer) return failure(writer.error());
  request.writer = *writer;
  request.resume = options.value("resume", false);
  return request;
}

void noteDefaultRules(const Document& document, Report& report) {
  if (!document.materials) report.note("materials", "no materials assigned; this scan used the default rules");
}

Result<MaterialAssignment> scanAssignment(const Document& document, Progress& progress) {
  if (document.materials) return document.materials->result.assignment;
  auto assigned = assignDocumentMaterials(document, {}, progress);
  if (!assigned) return failure(assigned.error());
  return assigned->document.materials->result.assignment;
}

}  // namespace standpoint
