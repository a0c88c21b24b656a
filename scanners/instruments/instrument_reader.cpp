// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include <nlohmann/json.hpp>

#include "core/json_file.h"
#include "core/units.h"
#include "scanners/instruments/figure_reader.h"
#include "scanners/instruments/instrument.h"

namespace standpoint {

namespace {

using Json = nlohmann::json;

class InstrumentReader : FigureReader {
 public:
  InstrumentReader(std::string file, const Json& document) : FigureReader(std::move(file)), document_(document) {}

  Result<Instrument> read() {
    Group root = open(document_, "");
    instrument_.id = root.fields.text("id");
    instrument_.maker = root.fields.text("maker");
    instrument_.model = root.fields.text("model");
    readSources(root);
    instrument_.technology = word(root, "technology", {"time_of_flight", "phase_shift"});
    readOptics(root);
    if (root.fields.has("moving"))
      readMoving(root);
    else
      readTripod(root);
    readAngles(root);
    readSignal(root);
    readNoise(root);
    readWaveform(root);
    readCorrelated(root);
    readSaturation(root);
    if (root.fields.has("range_offset")) readRangeOffset(root);
    if (root.fields.has("filters")) readFilters(root);
    readSettings(root);
    root.fields.close();
    if (!error()) checkWhole();
    if (error()) return failure(*error());
    instrument_.evidence = evidence();
    return std::move(instrument_);
  }

 private:
  void readOptics(Group& root) {
    Group beam = child(root, "beam");
    instrument_.wavelength_nm = figure(beam, "wavelength_nm", {200, 3000});
    instrument_.divergence_rad = figure(beam, "divergence_mrad", {0.001, 100, 1e-3});
    instrument_.exit_diameter_m = figure(beam, "exit_diameter_mm", {0.1, 1000, 1e-3});
    beam.fields.close();
    Group range = child(root, "range");
    instrument_.min_range_m = figure(range, "min_m", {0, 100});
    instrument_.max_range_m = figure(range, "max_m", {1, 10000});
    instrument_.reference_reflectivity = figure(range, "reference_reflectivity", {0.001, 1});
    instrument_.range_bias_m = figure(range, "bias_mm", {0, 1000, 1e-3});
    instrument_.range_bias_ppm = figure(range, "bias_ppm", {0, 10000});
    if (instrument_.technology == "phase_shift" && range.fields.has("unambiguous_m"))
      instrument_.unambiguous_m = figure(range, "unambiguous_m", {0, 100000});
    range.fields.close();
  }

  void readAngles(Group& root) {
    Group angles = child(root, "angles");
    if (!instrument_.moving) {
      instrument_.min_elevation_rad = figure(angles, "min_elevation_deg", {-90, 90, kRadPerDeg});
      instrument_.max_elevation_rad = figure(angles, "max_elevation_deg", {-90, 90, kRadPerDeg});
    }
    instrument_.angle_sigma_rad = figure(angles, "accuracy_arcsec", {0, 3600, kRadPerArcsec});
    instrument_.angle_jitter_rad = figure(angles, "jitter_arcsec", {0, 3600, kRadPerArcsec});
    angles.fields.close();
  }

  void readTripod(Group& root) {
    Group mirror = child(root, "mirror");
    instrument_.mirror_max_hz = figure(mirror, "max_hz", {0, 10000});
    instrument_.column_factor = figure(mirror, "column_factor", {1, 2});
    instrument_.overhead_s = figure(mirror, "overhead_s", {0, 3600});
    mirror.fields.close();
    Group stand = child(root, "stand");
    instrument_.trunnion_height_m = figure(stand, "trunnion_height_m", {0, 2});
    instrument_.tripod_height_m = figure(stand, "tripod_height_m", {0.1, 10});
    stand.fields.close();
    if (root.fields.has("compensator")) readCompensator(root);
    Group imaging = child(root, "imaging");
    instrument_.imaging_seconds = figure(imaging, "seconds", {0, 3600});
    instrument_.camera.columns = static_cast<std::uint32_t>(count(imaging, "columns", {16, 32768})) / 2 * 2;
    instrument_.camera.shots = count(imaging, "shots", {1, 360});
    instrument_.camera.hdr = count(imaging, "hdr", {0, 1}) == 1;
    instrument_.camera.offset_up_m = figure(imaging, "offset_up_mm", {-500, 500, 1e-3});
    imaging.fields.close();
  }

  void readCompensator(Group& root) {
    Group group = child(root, "compensator");
    Compensator compensator;
    compensator.kind = word(group, "kind", {"liquid", "inclinometer", "imu", "self_levelling"});
    compensator.range_rad = figure(group, "range_deg", {0, 90, kRadPerDeg});
    compensator.accuracy_rad = figure(group, "accuracy_arcsec", {0, 36000, kRadPerArcsec});
    if (group.fields.has("reduced_range_deg")) {
      compensator.reduced_range_rad = figure(group, "reduced_range_deg", {0, 90, kRadPerDeg});
      compensator.reduced_accuracy_rad = figure(group, "reduced_accuracy_arcsec", {0, 36000, kRadPerArcsec});
    }
    group.fields.close();
    instrument_.compensator = std::move(compensator);
  }

  void readMoving(Group& root) {
    Group group = child(root, "moving");
    MovingHead head;
    head.mount = word(group, "mount", {"hand", "body", "vehicle", "aircraft", "any"});
    head.heads = count(group, "heads", {1, 16});
    head.channel_elevations_rad = figures(group, "channel_elevations_deg", {-90, 90, kRadPerDeg}, 1024);
    head.points_per_s = figure(group, "points_per_s", {1, 1e9});
    head.min_rotation_hz = figure(group, "least_rotation_hz", {0, 10000});
    head.max_rotation_hz = figure(group, "most_rotation_hz", {0, 10000});
    head.second_rotation_hz = figure(group, "second_rotation_hz", {0, 10000});
    head.turn_rad = figure(group, "turn_deg", {1, 360, kRadPerDeg});
    readFirings(group, head);
    readHeads(group, head);
    head.cloud_accuracy_m = figure(group, "cloud_accuracy_mm", {0, 10000, 1e-3});
    if (group.fields.has("most_speed_mps")) head.most_speed_mps = figure(group, "most_speed_mps", {0.1, 100});
    if (group.fields.has("most_turn_deg_per_s"))
      head.most_turn_radps = figure(group, "most_turn_deg_per_s", {1, 3600, kRadPerDeg});
    group.fields.close();
    if (head.min_rotation_hz > head.max_rotation_hz)
      fail("/moving/most_rotation_hz", "must not be below least_rotation_hz");
    const auto& elevations = head.channel_elevations_rad;
    if (!elevations.empty()) {
      instrument_.min_elevation_rad = *std::min_element(elevations.begin(), elevations.end());
      instrument_.max_elevation_rad = *std::max_element(elevations.begin(), elevations.end());
    }
    instrument_.moving = std::move(head);
  }

  void readFirings(Group& group, MovingHead& head) {
    const Domain microseconds{0, 1e6, 1e-6};
    if (group.fields.has("firing_us")) head.firing_s = figure(group, "firing_us", {0.01, 1e6, 1e-6});
    if (group.fields.has("first_channel_us")) head.first_channel_s = figure(group, "first_channel_us", microseconds);
    if (group.fields.has("channel_us")) head.channel_s = figure(group, "channel_us", microseconds);
    if (group.fields.has("start_deg")) head.start_rad = figure(group, "start_deg", {-360, 360, kRadPerDeg});
    if (group.fields.has("turn_middle_deg"))
      head.turn_middle_rad = figure(group, "turn_middle_deg", {-360, 360, kRadPerDeg});
    const std::size_t channels = head.channel_elevations_rad.size();
    if (group.fields.has("azimuth_offsets_deg"))
      head.azimuth_offsets_rad = figures(group, "azimuth_offsets_deg", {-90, 90, kRadPerDeg}, channels);
    if (group.fields.has("beam_radius_mm")) head.beam_radius_m = figure(group, "beam_radius_mm", {0, 500, 1e-3});
    const double last_s = head.first_channel_s + head.channel_s * (static_cast<double>(channels) - 1);
    if (head.firing_s > 0 && last_s >= head.firing_s)
      fail("/moving/firing_us", "must be longer than its channels take");
  }

  // A figure for each, or none for all.
  std::vector<double> forEach(Group& group, const char* key, const Domain& domain, std::size_t count,
                              const char* what) {
    if (!group.fields.has(key)) return {};
    auto list = figures(group, key, domain, 1024);
    if (list.size() != count) fail(std::string("/moving/") + key, std::string("must have one figure for each ") + what);
    return list;
  }

  void readHeads(Group& group, MovingHead& head) {
    const auto heads = static_cast<std::size_t>(head.heads);
    head.channel_heights_m =
        forEach(group, "channel_heights_mm", {-500, 500, 1e-3}, head.channel_elevations_rad.size(), "channel");
    head.tilts_rad = forEach(group, "tilts_deg", {-180, 180, kRadPerDeg}, heads, "head");
    head.forward_m = forEach(group, "head_forward_mm", {-5000, 5000, 1e-3}, heads, "head");
    head.up_m = forEach(group, "head_up_mm", {-5000, 5000, 1e-3}, heads, "head");
  }

  void readSignal(Group& root) {
    Group signal = child(root, "signal");
    instrument_.near_range_m = figure(signal, "near_range_m", {0, 100});
    instrument_.near_range_power = static_cast<int>(figure(signal, "near_range_power", {1, 6}));
    instrument_.detection_softness = figure(signal, "detection_softness", {0, 1});
    instrument_.intensity_low_db = figure(signal, "intensity_low_db", {-200, 100});
    instrument_.intensity_high_db = figure(signal, "intensity_high_db", {-200, 100});
    instrument_.intensity_levels = static_cast<int>(figure(signal, "intensity_levels", {2, 65536}));
    instrument_.amplitude.aperture_m = figure(signal, "receiver_aperture_mm", {0.1, 1000, 1e-3});
    instrument_.amplitude.jitter = figure(signal, "amplitude_jitter", {0, 0.5});
    instrument_.sun_noise = figure(signal, "sun_noise", {0, 1000});
    if (signal.fields.has("near_range_curve")) readNearRangeCurve(signal);
    signal.fields.close();
  }

  void readNearRangeCurve(Group& signal) {
    Group group = child(signal, "near_range_curve");
    auto& curve = instrument_.near_range_curve;
    curve.below_m = figure(group, "below_m", {0.1, 1000});
    curve.amplitude_db = figures(group, "amplitude_db", {-1000, 1000}, 4);
    curve.far_db = figure(group, "far_db", {-1000, 1000});
    group.fields.close();
  }

  void readRangeOffset(Group& root) {
    Group group = child(root, "range_offset");
    auto& offset = instrument_.range_offset;
    offset.power_db = figures(group, "power_db", {-200, 100}, kMostOffsets);
    offset.offset_m = figures(group, "offset_mm", {-1000, 1000, 1e-3}, kMostOffsets);
    group.fields.close();
    if (offset.power_db.size() != offset.offset_m.size())
      fail("/range_offset/offset_mm", "must have one figure for each of power_db");
    if (std::adjacent_find(offset.power_db.begin(), offset.power_db.end(), std::greater_equal<>()) !=
        offset.power_db.end())
      fail("/range_offset/power_db", "must rise");
  }

  void readFilters(Group& root) {
    Group group = child(root, "filters");
    auto& filters = instrument_.filters;
    filters.deviation_m = figure(group, "deviation_mm", {0, 10000, 1e-3});
    filters.weak_factor = figure(group, "weak_factor", {0, 1000});
    filters.overload = count(group, "overload", {0, 1}) == 1;
    group.fields.close();
  }

  void readNoise(Group& root) {
    const Json& entries = list(root.fields, "range_noise", 100);
    for (std::size_t i = 0; i < entries.size(); ++i) {
      Group entry = open(entries[i], "/range_noise/" + std::to_string(i));
      RangeNoise noise;
      noise.range_m = figure(entry, "range_m", {0.1, 10000});
      noise.reflectivity = figure(entry, "reflectivity", {0.001, 1});
      noise.sigma_m = figure(entry, "sigma_mm", {0.001, 1000, 1e-3});
      entry.fields.close();
      for (const auto& other : instrument_.range_noise)
        if (other.range_m == noise.range_m && other.reflectivity == noise.reflectivity)
          entry.fields.wrong("", "repeats an entry of the same range and reflectivity");
      instrument_.range_noise.push_back(noise);
    }
    if (!root.fields.has("noise_knee_m")) return;
    instrument_.noise_knee_m = figure(root, "noise_knee_m", {0.1, 10000});
    if (instrument_.range_noise.size() > 1)
      fail("/noise_knee_m",
           "is for a single figure: the figures of range_noise say themselves how noise falls with power");
  }

  // The other technology's figure is an unknown key.
  void readWaveform(Group& root) {
    Group group = child(root, "waveform");
    auto& waveform = instrument_.waveform;
    if (instrument_.technology == "phase_shift") {
      waveform.fine_wavelength_m = figure(group, "fine_wavelength_m", {0.01, 1000});
      if (group.fields.has("field_of_view_mrad"))
        waveform.field_of_view_rad = figure(group, "field_of_view_mrad", {0, 100, 1e-3});
    } else {
      waveform.pulse_width_s = figure(group, "pulse_width_ns", {0.01, 1000, 1e-9});
    }
    waveform.max_returns = count(group, "most_returns", {1, 255});
    group.fields.close();
  }

  void readCorrelated(Group& root) {
    Group group = child(root, "correlated_noise");
    auto& noise = instrument_.correlated;
    noise.column_fraction = figure(group, "column_share", {0, 1});
    noise.along_fraction = figure(group, "along_share", {0, 1});
    noise.column_correlation = figure(group, "column_correlation", {0, 0.999});
    noise.hurst = figure(group, "hurst", {0.5, 0.95});
    noise.column_extra_m = figure(group, "column_extra_mm", {0, 1000, 1e-3});
    noise.wobble_m = figure(group, "wobble_mm", {0, 1000, 1e-3});
    noise.wobble_order = count(group, "wobble_order", {1, 64});
    noise.elevation_wobble_rad = figure(group, "elevation_wobble_arcsec", {0, 3600, kRadPerArcsec});
    noise.azimuth_flicker_rad = figure(group, "azimuth_flicker_arcsec", {0, 3600, kRadPerArcsec});
    noise.clock_jitter_s = figure(group, "clock_jitter_ns", {0, 1e6, 1e-9});
    group.fields.close();
  }

  void readSaturation(Group& root) {
    Group group = child(root, "saturation");
    instrument_.saturation.level_db = figure(group, "level_db", {-100, 100});
    instrument_.saturation.walk_m_per_decade = figure(group, "walk_mm_per_decade", {-1000, 1000, 1e-3});
    instrument_.saturation.pedestal = figure(group, "pedestal", {0, 0.1});
    group.fields.close();
  }

  void readSettings(Group& root) {
    const Json& entries = list(root.fields, "settings", 100);
    for (std::size_t i = 0; i < entries.size() && !error(); ++i)
      readSetting(open(entries[i], "/settings/" + std::to_string(i)));
  }

  void readSetting(Group group) {
    InstrumentSetting setting;
    setting.key = group.fields.text("key");
    setting.label = group.fields.text("label");
    setting.unit = group.fields.anyText("unit");
    setting.default_value = group.fields.text("standard");
    cite(group.fields.pointer(), group.source, group.note);
    for (const auto& other : instrument_.settings)
      if (other.key == setting.key) group.fields.wrong("key", "\"" + setting.key + "\" is duplicated");
    if (group.fields.has("choices"))
      readChoices(group, setting);
    else
      readNumber(group, setting);
    group.fields.close();
    instrument_.settings.push_back(std::move(setting));
  }

  void readNumber(Group& group, InstrumentSetting& setting) {
    static const std::set<std::string> kKnown = {"horizontal_from", "horizontal_to", "vertical_from", "vertical_to",
                                                 "nearest_m",       "farthest_m",    "line_step",     "frame_step"};
    if (!kKnown.contains(setting.key))
      return group.fields.wrong(
          "key", "only area edges, range limits and pattern steps can be numbers; other settings require choices");
    const Domain domain = setting.key.ends_with("_m") ? Domain{0, 10000} : Domain{-360, 360};
    setting.minimum = figure(group, "minimum", domain);
    setting.maximum = figure(group, "maximum", domain);
    const Json default_value = Json::parse(setting.default_value, nullptr, false);
    if (!error()) checked(group.fields.pointer("standard"), default_value, {setting.minimum, setting.maximum});
  }

  void readChoices(Group& group, InstrumentSetting& setting) {
    const Json& entries = list(group.fields, "choices", 100);
    const std::string pointer = group.fields.pointer("choices");
    bool has_standard = false;
    for (std::size_t i = 0; i < entries.size() && !error(); ++i) {
      Group entry = open(entries[i], pointer + "/" + std::to_string(i));
      if (entry.source.empty()) entry.source = group.source;
      if (entry.note.empty()) entry.note = group.note;
      setting.choices.push_back(readChoice(entry));
      has_standard = has_standard || setting.choices.back().value == setting.default_value;
      for (std::size_t k = 0; k < i; ++k)
        if (setting.choices[k].value == setting.choices[i].value) entry.fields.wrong("value", "is duplicated");
    }
    if (!has_standard) group.fields.wrong("standard", "is not one of the choices");
  }

  SettingChoice readChoice(Group& entry) {
    static const std::map<std::string, Domain> kEffects = {{"columns", {2, 1e6}},
                                                           {"rows", {1, 1e6}},
                                                           {"scan_seconds", {0.01, 1e5}},
                                                           {"rate_hz", {1, 1e9}},
                                                           {"noise_factor", {0.01, 100}},
                                                           {"passes", {1, 16}},
                                                           {"imaging", {0, 1}},
                                                           {"imaging_seconds", {0, 1e4}},
                                                           {"stepped", {0, 1}},
                                                           {"points_per_s", {1, 1e9}},
                                                           {"imaging_factor", {0, 100}},
                                                           {"area", {0, 1}},
                                                           {"max_range_m", {1, 10000}},
                                                           {"reference_reflectivity", {0.001, 1}},
                                                           {"rotation_hz", {0, 10000}},
                                                           {"most_returns", {1, 255}},
                                                           {"unambiguous_m", {0, 100000}},
                                                           {"drop_mixed_mm", {0, 10000}},
                                                           {"drop_weak", {0, 1000}},
                                                           {"drop_overload", {0, 1}},
                                                           {"laser", {0, 1}},
                                                           {"seconds_factor", {0.01, 100}},
                                                           {"compression", {1, 16}},
                                                           {"mode", {1, 9}},
                                                           {"of_mode", {1, 9}},
                                                           {"picture_columns", {16, 32768}},
                                                           {"picture_hdr", {0, 1}},
                                                           {"picture_metered", {0, 1}},
                                                           {"picture_stops", {-8, 8}},
                                                           {"picture_warmth", {-1, 1}},
                                                           {"picture_flash", {0, 1}},
                                                           {"picture_metering", {0, 2}}};
    SettingChoice choice;
    choice.value = entry.fields.text("value");
    choice.label = entry.fields.text("label");
    for (const auto& key : entry.fields.keys())
      if (const auto effect = kEffects.find(key); effect != kEffects.end())
        choice.effects[key] = figure(entry, key, effect->second);
    entry.fields.close();
    return choice;
  }

  void checkWhole() {
    if (!instrument_.moving && instrument_.min_elevation_rad >= instrument_.max_elevation_rad)
      fail("/angles/max_elevation_deg", "must be above min_elevation_deg");
    if (instrument_.min_range_m >= instrument_.max_range_m) fail("/range/max_m", "must be above min_m");
    if (instrument_.intensity_low_db >= instrument_.intensity_high_db)
      fail("/signal/intensity_high_db", "must be above intensity_low_db");
    if (instrument_.angle_jitter_rad > instrument_.angle_sigma_rad)
      fail("/angles/jitter_arcsec", "must not exceed accuracy_arcsec, which includes it");
    checkFractions();
    checkRotations();
    if (!error())
      if (const auto default_value =
              instrument_.moving ? resolveMovingSettings(instrument_, {}) : resolveSettings(instrument_, {});
          !default_value)
        fail("/settings", "the default values are not a valid scan: " + default_value.error().message);
  }

  void checkRotations() {
    for (const auto& setting : instrument_.settings)
      for (const auto& choice : setting.choices)
        if (const auto rotation = choice.effects.find("rotation_hz"); rotation != choice.effects.end())
          if (!instrument_.moving || rotation->second < instrument_.moving->min_rotation_hz ||
              rotation->second > instrument_.moving->max_rotation_hz)
            fail("/settings",
                 "\"" + choice.value + "\" of " + setting.key + " rotates the head beyond the limits in /moving");
  }

  // Parts cannot be more than the whole.
  void checkFractions() {
    const auto& noise = instrument_.correlated;
    if (noise.column_fraction + noise.along_fraction > 1)
      fail("/correlated_noise/along_share",
           "must not exceed 1 together with column_share: both are fractions of one variance");
    const double rest = instrument_.angle_sigma_rad * instrument_.angle_sigma_rad -
                        instrument_.angle_jitter_rad * instrument_.angle_jitter_rad;
    if (noise.azimuth_flicker_rad * noise.azimuth_flicker_rad > rest)
      fail("/correlated_noise/azimuth_flicker_arcsec", "must not exceed accuracy_arcsec together with jitter_arcsec");
    if (noise.elevation_wobble_rad * noise.elevation_wobble_rad / 2 >
        rest)  // the variance of a sine is half its amplitude squared
      fail("/correlated_noise/elevation_wobble_arcsec", "must not exceed accuracy_arcsec together with jitter_arcsec");
  }

  const Json& document_;
  Instrument instrument_;
};

}  // namespace

Result<Instrument> readInstrument(const std::filesystem::path& file) {
  TRY_ASSIGN(const auto document, readJsonFile(file, kLargestFile));
  const std::string name = file.filename().string();
  TRY_ASSIGN(auto instrument, InstrumentReader(name, document).read());
  if (instrument.id != file.stem().string())
    return JsonPlace{name, "/id"}.unusable("must match the file name, \"" + file.stem().string() + "\"");
  return instrument;
}

Result<std::vector<std::filesystem::path>> instrumentFiles(const std::filesystem::path& folder) {
  std::error_code code;
  std::vector<std::filesystem::path> files;
  for (std::filesystem::directory_iterator entry(folder, code), last; !code && entry != last; entry.increment(code))
    if (entry->path().extension() == ".json" && entry->path().filename() != "schema.json")
      files.push_back(entry->path());
  if (code) return failure(ErrorKind::file_system, "cannot be listed: " + code.message(), folder.string());
  std::sort(files.begin(), files.end());
  return files;
}

Result<std::vector<Instrument>> readInstruments(const std::filesystem::path& folder) {
  TRY_ASSIGN(const auto files, instrumentFiles(folder));
  std::vector<Instrument> instruments;
  for (const auto& file : files) {
    TRY_ASSIGN(auto instrument, readInstrument(file));
    instruments.push_back(std::move(instrument));
  }
  return instruments;
}

}  // namespace standpoint
