// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/survey/waveform_verb.h"

#include <cmath>

#include <fmt/format.h>

#include "core/output_place.h"
#include "core/part_file.h"
#include "core/random.h"
#include "core/units.h"
#include "project/answers.h"
#include "project/survey/scan_preparation.h"
#include "project/survey/scan_request.h"
#include "scanners/engine/pulse_waveform.h"
#include "survey/instruments.h"

namespace standpoint {

namespace {

WaveformRequest requestOf(const WaveformOptions& options, const Pose& local_from_scanner) {
  const double azimuth = options.direction->azimuth_deg * kRadPerDeg;
  const double elevation = options.direction->elevation_deg * kRadPerDeg;
  const Eigen::Vector3d local(std::cos(elevation) * std::sin(azimuth), std::cos(elevation) * std::cos(azimuth),
                              std::sin(elevation));
  const Eigen::Vector3d own = local_from_scanner.rotation.conjugate() * local;
  return {std::atan2(-own.y(), own.x()), std::atan2(own.z(), std::hypot(own.x(), own.y())), options.bin_m};
}

Result<void> writeCsv(const PulseWaveform& waveform, const std::filesystem::path& file) {
  TRY_ASSIGN(auto part, PartFile::create(file));
  TRY(part.append(std::string_view("range_m,power\n")));
  std::string rows;
  for (std::size_t i = 0; i < waveform.power.size(); ++i)
    rows +=
        fmt::format("{:.6f},{:.6e}\n", waveform.first_m + static_cast<double>(i) * waveform.bin_m, waveform.power[i]);
  TRY(part.append(std::string_view(rows)));
  return part.commit();
}

}  // namespace

Result<BeamDirection> FieldValue<BeamDirection>::read(const nlohmann::json& value) {
  const auto text = value.get<std::string>();
  const auto numbers = parseNumbers(text);
  if (!numbers || numbers->size() != 2)
    return failure(ErrorKind::usage, fmt::format("'{}' must be AZIMUTH,ELEVATION in degrees", text), "--direction");
  const BeamDirection direction{(*numbers)[0], (*numbers)[1]};
  if (std::abs(direction.azimuth_deg) > 360 || std::abs(direction.elevation_deg) > 90)
    return failure(ErrorKind::usage,
                   fmt::format("'{}': the azimuth must be from -360 to 360, the elevation from -90 to 90", text),
                   "--direction");
  return direction;
}

nlohmann::json FieldValue<BeamDirection>::write(const BeamDirection& direction) {
  return fmt::format("{},{}", direction.azimuth_deg, direction.elevation_deg);
}

const Fields<WaveformOptions>& waveformFields() {
  using O = WaveformOptions;
  static const Fields<O> fields = {
      {"station", &O::station, "name of the station", {.required = true}},
      {"instrument", &O::instrument, "id or file of a time-of-flight instrument", {.required = true}},
      {"set", &O::settings, "settings in the device's own words, such as resolution=12mm"},
      {"direction", &O::direction, "AZIMUTH,ELEVATION of the beam in degrees, clockwise from the file's Y; required"},
      {"without", &O::without, "effects to leave out, as of a scan: footprint, panes, mirrors, …"},
      {"bin", &O::bin_m, "width of a bin (0: a twentieth of the pulse)", {.unit = "m", .minimum = 0, .maximum = 100}},
      {"output",
       &O::output,
       "file to write (.csv): range in m and power over that of a white wall at 1 m",
       {.required = true}}};
  return fields;
}

const AnswerFields<WaveformEcho>& answerFields(const WaveformEcho*) {
  using A = WaveformEcho;
  static const AnswerFields<A> fields = {{"range_m", &A::range_m}, {"power_db", &A::power_db}};
  return fields;
}

const AnswerFields<WaveformAnswer>& answerFields(const WaveformAnswer*) {
  using A = WaveformAnswer;
  static const AnswerFields<A> fields = {
      {"bins", &A::bins}, {"first_m", &A::first_m}, {"bin_m", &A::bin_m}, {"echoes", &A::echoes}, {"file", &A::file}};
  return fields;
}

Result<Answered<WaveformAnswer>> runWaveform(const Document& document, const WaveformOptions& options,
                                             Progress& progress) {
  progress.stage("Waveform");
  if (options.output.extension() != ".csv")
    return failure(ErrorKind::usage,
                   fmt::format("unsupported format '{}'; use .csv", options.output.extension().string()), "--output");
  TRY(checkFolderOf(options.output, "--output"));
  if (!options.direction) return failure(ErrorKind::usage, "specify AZIMUTH,ELEVATION in degrees", "--direction");
  TRY_ASSIGN(const auto instrument, instrumentNamed(options.instrument));
  TRY_ASSIGN(const auto settings, resolveSettings(instrument, options.settings));
  TRY_ASSIGN(const auto stations, stationsFrom(*document.job, {{options.station}}));
  const Station& station = document.job->stations[stations.front()];
  TRY_ASSIGN(const auto prepared, prepareScan(document, nullptr, progress));
  ScanOptions scan;
  scan.effects = options.without.value_or(scan.effects);
  scan.station_key = static_cast<std::uint32_t>(stableHash(station.name.c_str()));
  TRY_ASSIGN(const auto waveform, pulseWaveform(*prepared->scene, prepared->world.assignment, instrument, settings,
                                                station.true_pose, scan, requestOf(options, station.true_pose)));
  TRY(writeCsv(waveform, options.output));
  Answered<WaveformAnswer> outcome{document};
  noteDefaultRules(document, outcome.report);
  if (waveform.power.empty()) outcome.report.warn(station.name, "nothing comes back from there: the file has no bins");
  outcome.answer = {waveform.power.size(), waveform.first_m, waveform.bin_m, {}, options.output};
  for (const Echo& echo : waveform.echoes)
    outcome.answer.echoes.push_back({echo.range_m, 10 * std::log10(std::max(1e-30, static_cast<double>(echo.x)))});
  outcome.description = fmt::format("Wrote a waveform of {} bins with {} echo{}", waveform.power.size(),
                                    waveform.echoes.size(), waveform.echoes.size() == 1 ? "" : "es");
  return outcome;
}

}  // namespace standpoint
