// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/survey/scan_request.h"

#include <algorithm>
#include <array>
#include <charconv>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/output_place.h"
#include "core/units.h"
#include "project/materials/materials_verb.h"
#include "scanners/instruments/chosen_effect.h"
#include "survey/instruments.h"

namespace standpoint {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

// Keeps the stations i, i+n, i+2n, …; every random number belongs to its station, so shards together give the same
// bytes as the whole.
std::vector<std::size_t> shardOf(const std::vector<std::size_t>& stations, const Shard& shard) {
  std::vector<std::size_t> kept;
  for (std::size_t k = shard.index - 1; k < stations.size(); k += shard.count) kept.push_back(stations[k]);
  return kept;
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
    request.one_file = request.format->many_scans || request.stations.size() <= 1;
    return checkFolderOf(output, "--output");
  }
  request.format = cloudFormatFor("x.e57");
  std::error_code error;
  fs::create_directories(output, error);
  if (error) return failure(ErrorKind::file_system, "cannot create the folder: " + error.message(), output.string());
  return {};
}

Result<Effects> effectsFrom(const ScanVerbOptions& options) {
  if (!options.ideal) return options.without.value_or(Effects());
  if (options.without) return failure(ErrorKind::usage, "an ideal scan already excludes all effects", "--without");
  return Effects::none();
}

Result<void> choosePanorama(ScanRequest& request, const ScanVerbOptions& options) {
  request.panorama = options.panorama;
  if (request.panorama && !request.settings.imaging)
    return failure(ErrorKind::usage, "a panorama requires settings that take images", "--panorama");
  if (!request.panorama && !request.settings.laser)
    return failure(ErrorKind::usage, "these settings measure no points and no panorama is requested", "--set");
  if (!options.panorama_columns) return {};
  const auto columns = *options.panorama_columns;
  if (!request.panorama) return failure(ErrorKind::usage, "requires --panorama", "--panorama-size");
  if (columns % 2 != 0)
    return failure(ErrorKind::usage,
                   fmt::format("{} is odd: use an even width, since the height is half the width", columns),
                   "--panorama-size");
  request.instrument.camera.columns = columns;
  request.panorama_columns = columns;
  return {};
}

// What a scanner that is carried has not.
Result<void> checkCarried(const ScanVerbOptions& options) {
  const auto refuse = [](const char* what, const char* option) {
    return failure(ErrorKind::usage, fmt::format("{} belongs to stations; leave it out with --trajectory", what),
                   option);
  };
  if (!options.stations.names.empty()) return refuse("a choice of stations", "--stations");
  if (options.panorama || options.panorama_columns) return refuse("a panorama", "--panorama");
  if (options.field_fault.any()) return refuse("a field fault", "--field-fault");
  if (options.compensator == Switch::off) return refuse("a compensator", "--compensator");
  if (options.resume) return refuse("an earlier run to resume", "--resume");
  return {};
}

// Of all heads of an instrument that is carried.
std::size_t laserChannels(const Instrument& instrument) {
  if (!instrument.moving) return 0;
  return instrument.moving->channel_elevations_rad.size() * static_cast<std::size_t>(instrument.moving->heads);
}

// What differs from clear air, as weatherFrom() reads it.
std::string textOf(const Weather& w) {
  std::string text;
  const auto say = [&](const char* key, double value, double usual) {
    if (value != usual) text += fmt::format("{}{}={}", text.empty() ? "" : " ", key, value);
  };
  constexpr Weather kUsual;
  say("visibility", w.visibility_km, kUsual.visibility_km);
  say("rain", w.rain_mm_h, kUsual.rain_mm_h);
  say("snow", w.snow_mm_h, kUsual.snow_mm_h);
  say("fog", w.fog_mor_m, kUsual.fog_mor_m);
  say("dust", w.dust_mor_m, kUsual.dust_mor_m);
  return text;
}

void noteMoversFrom(ScanRequest& request) {
  const double from_s = request.options.bodies_ahead_s;
  if (from_s != 0) request.notes.push_back(fmt::format("movers-from={} s", from_s));
}

}  // namespace

double stationStart_s(const ScanRequest& request, std::size_t station) {
  const double each_s = request.settings.scan_seconds + request.settings.imaging_seconds;
  return static_cast<double>(station) * (each_s + (request.stations_follow ? kChangeover_s : 0));
}

ScanRequest requestAt(const ScanRequest& request, std::size_t station) {
  ScanRequest of_station = request;
  if (!request.stations_follow) return of_station;
  of_station.options.bodies_ahead_s = stationStart_s(request, station);
  noteMoversFrom(of_station);
  return of_station;
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
          .panorama_columns = request.panorama_columns,
          .quality = request.options.quality};
}

ScanVerbOptions optionsOf(const ScanChoice& choice) {
  ScanVerbOptions options;
  options.instrument = choice.instrument;
  options.settings = choice.settings;
  options.seed = choice.seed;
  options.ideal = choice.effects == Effects::none();
  if (!options.ideal && choice.effects != Effects()) options.without = choice.effects;
  if (choice.weather != Weather()) options.weather = choice.weather;
  options.truth = choice.truth;
  options.compensator = choice.compensator ? Switch::on : Switch::off;
  options.quality = choice.quality;
  options.panorama = choice.panorama;
  if (choice.panorama && choice.panorama_columns > 0) options.panorama_columns = choice.panorama_columns;
  return options;
}

Result<std::vector<std::size_t>> stationsFrom(const Job& job, const StationNames& wanted) {
  std::vector<std::size_t> result;
  if (job.stations.empty()) return failure(ErrorKind::usage, "there are no stations: add one first", "--stations");
  for (const auto& name : wanted.names) {
    const auto at =
        std::find_if(job.stations.begin(), job.stations.end(), [&](const Station& s) { return s.name == name; });
    if (at == job.stations.end())
      return failure(ErrorKind::usage, fmt::format("unknown station '{}'", name), "--stations");
    result.push_back(static_cast<std::size_t>(at - job.stations.begin()));
  }
  for (std::size_t i = 0; wanted.names.empty() && i < job.stations.size(); ++i) result.push_back(i);
  return result;
}

fs::path fileOf(const ScanRequest& request, const Station& station) {
  if (request.one_file) return request.output;
  if (request.output.has_extension() && !fs::is_directory(request.output))
    return request.output.parent_path() /
           (request.output.stem().string() + "-" + station.name + request.format->extension);
  return request.output / (station.name + request.format->extension);
}

Result<StationNames> FieldValue<StationNames>::read(const json& value) {
  const auto& text = value.get_ref<const std::string&>();
  StationNames stations;
  if (text == "all") return stations;
  for (std::size_t from = 0; from <= text.size();) {
    const auto comma = std::min(text.find(',', from), text.size());
    stations.names.push_back(text.substr(from, comma - from));
    from = comma + 1;
  }
  return stations;
}

json FieldValue<StationNames>::write(const StationNames& stations) {
  return stations.names.empty() ? "all" : fmt::format("{}", fmt::join(stations.names, ","));
}

Result<Shard> FieldValue<Shard>::read(const json& value) {
  const auto& text = value.get_ref<const std::string&>();
  const char* const end = text.data() + text.size();
  Shard shard;
  const auto index = std::from_chars(text.data(), end, shard.index);
  if (index.ec == std::errc() && index.ptr != end && *index.ptr == '/') {
    const auto count = std::from_chars(index.ptr + 1, end, shard.count);
    if (count.ec == std::errc() && count.ptr == end && shard.index >= 1 && shard.index <= shard.count) return shard;
  }
  return failure(ErrorKind::usage, fmt::format("'{}' is not i/n with 1 <= i <= n", text));
}

json FieldValue<Shard>::write(const Shard& shard) { return fmt::format("{}/{}", shard.index, shard.count); }

Result<Effects> FieldValue<Effects>::read(const json& text) { return effectsWithout(text.get<std::string>()); }
json FieldValue<Effects>::write(Effects effects) { return leftOut(effects); }
Result<Weather> FieldValue<Weather>::read(const json& text) { return weatherFrom(text.get<std::string>()); }
json FieldValue<Weather>::write(const Weather& weather) { return textOf(weather); }
Result<Sun> FieldValue<Sun>::read(const json& text) { return sunFrom(text.get<std::string>()); }
json FieldValue<Sun>::write(const Sun& sun) {
  return fmt::format("{},{},{}", sun.azimuth_rad / kRadPerDeg, sun.elevation_rad / kRadPerDeg, sun.irradiance_W_m2);
}

std::span<const Choice<Switch>> choices(Switch) {
  static constexpr std::array kSwitches = {Choice<Switch>{"on", Switch::on}, Choice<Switch>{"off", Switch::off}};
  return kSwitches;
}

std::span<const Choice<ScanQuality>> choices(ScanQuality) {
  static constexpr std::array kQualities = {Choice<ScanQuality>{"preview", ScanQuality::preview},
                                            Choice<ScanQuality>{"default", ScanQuality::standard},
                                            Choice<ScanQuality>{"reference", ScanQuality::reference}};
  return kQualities;
}

std::span<const Choice<TrajectoryError>> choices(TrajectoryError) {
  using E = TrajectoryError;
  static constexpr std::array kErrors = {Choice<E>{"instrument", E::of_instrument},
                                         Choice<E>{"none", E::none},
                                         Choice<E>{"wearable", E::wearable},
                                         Choice<E>{"handheld", E::handheld},
                                         Choice<E>{"poor", E::poor},
                                         Choice<E>{"survey-mms", E::survey_mms},
                                         Choice<E>{"uav", E::uav},
                                         Choice<E>{"mems", E::mems}};
  return kErrors;
}

std::span<const Choice<Deskew>> choices(Deskew) {
  static constexpr std::array kDeskews = {Choice<Deskew>{"pulse", Deskew::pulse},
                                          Choice<Deskew>{"firing", Deskew::firing},
                                          Choice<Deskew>{"turn", Deskew::turn}, Choice<Deskew>{"none", Deskew::none}};
  return kDeskews;
}

const Fields<ScanVerbOptions>& scanFields() {
  using O = ScanVerbOptions;
  static const std::string effects = "effects to leave out: " + effectList();
  static const Fields<O> fields = {
      {"stations", &O::stations, "all, or names separated by commas"},
      {"trajectory", &O::trajectory,
       "instead of stations: the name or file of a trajectory, for an instrument that is carried"},
      {"trajectory-error", &O::trajectory_error,
       "how the trajectory is known: with the error of the instrument's kind, none, or that of a profile"},
      {"closures", &O::closures, "off: places that the trajectory comes back to are not recognised"},
      {"mounting", &O::mounting,
       "how the scanner sits on what carries it: x, y, z in m, roll, pitch, yaw in degrees, x ahead and y to the left"},
      {"mounting-error", &O::mounting_error, "by how much this is believed to be otherwise: the same, and clock in s"},
      {"anchors", &O::anchors, "on: scanned stations within 3 m of the trajectory hold it"},
      {"control", &O::control, "text file of control points that hold it where it stops: name X Y Z [sigma in mm]"},
      {"deskew", &O::deskew, "pose by which points are placed: that of each pulse, firing, or an even turn; none"},
      {"instrument", &O::instrument, "id or file of the instrument, such as leica-rtc360", {.required = true}},
      {"set", &O::settings, "settings in the device's own words, such as resolution=12mm"},
      {"seed", &O::seed, "seed of the noise", {.minimum = 0, .maximum = 9007199254740991.0}},
      {"ideal", &O::ideal, "no effects: the first surface on the axis of each pulse, exactly"},
      {"without", &O::without, effects.c_str()},
      {"quality", &O::quality,
       "preview: one ray per pulse; default: the whole beam at edges; reference: 64 rays for every pulse"},
      {"weather", &O::weather, "visibility=KM rain=MM/H snow=MM/H fog=M dust=M, separated by spaces or commas"},
      {"sun", &O::sun, "AZIMUTH,ELEVATION[,W/m2] in degrees, clockwise from the file's Y; lux too: 135,40,80000lux"},
      {"interference",
       &O::interference,
       "probability of a return from another instrument's light",
       {.minimum = 0, .maximum = 1}},
      {"field-fault", &O::field_fault,
       "faults in the field, at a fraction of the columns or of the turn: until=FRACTION ends the scan, "
       "tripod_moved=FRACTION, passer_by=FRACTION, operator_in_view=FRACTION with operator_distance=METRES, "
       "operator_from=FRACTION, operator_until=FRACTION; noise=FACTOR of the range noise"},
      {"note", &O::notes, "key=text for the file's record of each scan, such as operator=NAME"},
      {"panorama", &O::panorama, "take a panorama at each station and colour the points from it"},
      {"panorama-size",
       &O::panorama_columns,
       "width of --panorama, twice its height (default: that of the instrument's camera)",
       {.unit = "pixels", .minimum = 256, .maximum = 32768}},
      {"compensator", &O::compensator, "off: tilted points from a station out of level"},
      {"movers", &O::movers, "off: nothing moves; people and vehicles are not there, and doors are closed"},
      {"movers-from",
       &O::movers_from_s,
       "time of the movers' clock when each scan begins; without it stations follow one another, 60 s apart",
       {.unit = "s", .minimum = -1e6, .maximum = 1e6}},
      {"operator", &O::operator_there, "off: who carries the scanner along a trajectory is not in its sight"},
      {"truth", &O::truth, "write the truth of each point: time, return, true place, range, incidence, power, origin"},
      {"as",
       &O::as,
       "an E57 of integers of 0.1 mm, or of range and angles; a PCD as a list of points instead of a grid; a LAS of "
       "point format 8",
       {.choices = {"scaled", "spherical", "points", "pdrf8"}}},
      {"threads", &O::threads, "0 = all; the result is the same", {.minimum = 0, .maximum = 1024}},
      {"resume", &O::resume, "continue a run that was cancelled or crashed; keep its finished stations"},
      {"shard", &O::shard,
       "i/n: only every n-th station from the i-th, or the i-th part of a trajectory, for a batch on several machines"},
      {"output",
       &O::output,
       "a folder, or a file (.e57, .ptx, .las, .pcd, …); an E57, PTX or LAS holds all stations",
       {.required = true}}};
  return fields;
}

Result<ScanRequest> scanRequestFrom(const Document& document, const ScanVerbOptions& options) {
  ScanRequest request;
  TRY_ASSIGN(request.instrument, instrumentNamed(options.instrument));
  const bool carried = !options.trajectory.empty();
  if (carried)
    TRY(checkCarried(options));
  else if (!options.control.empty())
    return failure(ErrorKind::usage,
                   "control points hold what is carried along a --trajectory; those of stations belong to 'register'",
                   "--control");
  else if (!options.mounting.empty() || !options.mounting_error.empty())
    return failure(ErrorKind::usage, "a mounting belongs to what is carried along a --trajectory",
                   options.mounting.empty() ? "--mounting-error" : "--mounting");
  TRY_ASSIGN(request.settings, carried ? resolveMovingSettings(request.instrument, options.settings)
                                       : resolveSettings(request.instrument, options.settings));
  request.instrument.camera = request.settings.camera;
  if (const auto most = chosenEffect(request.instrument, request.settings.values, "most_returns"))
    request.instrument.waveform.max_returns = static_cast<int>(*most);
  request.options.seed = options.seed;
  TRY_ASSIGN(const auto effects, effectsFrom(options));
  request.options.effects = effects;
  request.options.quality = options.quality;
  request.options.weather = options.weather.value_or(request.options.weather);
  request.options.sun = options.sun;
  request.options.interference = options.interference;
  request.field_fault = options.field_fault;
  for (const auto& [key, text] : options.notes) request.notes.push_back(key + "=" + text);
  request.levelling = {.compensator = options.compensator == Switch::on,
                       .exact = !request.options.effects.has(Effect::levelling),
                       .seed = request.options.seed};
  request.options.bodies_ahead_s = options.movers_from_s.value_or(0);
  noteMoversFrom(request);
  TRY(choosePanorama(request, options));
  const bool truth = options.truth;
  const bool movers = options.movers == Switch::on && document.job && !document.job->movers.empty();
  request.stations_follow = movers && !carried && !options.movers_from_s;
  request.options.channels = {.time = truth || carried || movers,
                              .channel = laserChannels(request.instrument) > 1,
                              .returns = truth || request.instrument.waveform.max_returns > 1,
                              .truth = truth};
  request.options.threads = options.threads;
  if (!carried) {
    TRY_ASSIGN(auto stations, stationsFrom(*document.job, options.stations));
    request.stations = options.shard ? shardOf(stations, *options.shard) : std::move(stations);
  }
  TRY(chooseOutput(request, options.output));
  request.as = options.as;
  TRY_ASSIGN(const auto writer, writerOf(*request.format, request.as));
  request.writer = writer;
  request.resume = options.resume;
  return request;
}

void noteDefaultRules(const Document& document, Report& report) {
  if (!document.materials) report.note("materials", "no materials assigned; this scan used the default rules");
}

Result<MaterialAssignment> scanAssignment(const Document& document, Progress& progress) {
  if (document.materials) return document.materials->result.assignment;
  TRY_ASSIGN(auto assigned, assignDocumentMaterials(document, {}, progress));
  return assigned.document.materials->result.assignment;
}

}  // namespace standpoint
