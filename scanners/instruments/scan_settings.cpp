// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "core/units.h"
#include "scanners/instruments/instrument.h"

namespace standpoint {

namespace {

std::string list(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string allowed(const InstrumentSetting& setting) {
  if (setting.choices.empty()) {
    const auto number = [](double value) { return std::to_string(static_cast<int>(value)); };
    return "a number from " + number(setting.minimum) + " to " + number(setting.maximum) + " " + setting.unit;
  }
  std::vector<std::string> words;
  for (const auto& choice : setting.choices) words.push_back(choice.value);
  return list(words);
}

const SettingChoice* choiceOf(const InstrumentSetting& setting, const std::string& value) {
  const auto found =
      std::find_if(setting.choices.begin(), setting.choices.end(), [&](const auto& c) { return c.value == value; });
  return found == setting.choices.end() ? nullptr : &*found;
}

std::optional<double> number(const std::string& text) {
  double value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

Result<SettingValues> complete(const Instrument& instrument, const SettingValues& values) {
  SettingValues result;
  for (const auto& setting : instrument.settings) result.emplace_back(setting.key, setting.default_value);
  std::vector<bool> given(result.size(), false);
  for (const auto& pair : values) {
    const std::string &key = pair.first, &value = pair.second;
    const auto found = std::find_if(instrument.settings.begin(), instrument.settings.end(),
                                    [&](const auto& s) { return s.key == key; });
    if (found == instrument.settings.end()) {
      std::vector<std::string> keys;
      for (const auto& setting : instrument.settings) keys.push_back(setting.key);
      return failure(ErrorKind::usage, "the " + instrument.model + " has no such setting; available: " + list(keys),
                     key);
    }
    const auto index = static_cast<std::size_t>(found - instrument.settings.begin());
    if (given[index]) return failure(ErrorKind::usage, "is given twice", key);
    given[index] = true;
    const auto angle = number(value);
    const bool fits = found->choices.empty() ? angle && *angle >= found->minimum && *angle <= found->maximum
                                             : choiceOf(*found, value) != nullptr;
    if (!fits)
      return failure(ErrorKind::usage,
                     "\"" + value + "\" is not allowed; the " + instrument.model + " takes " + allowed(*found), key);
    result[index].second = value;
  }
  return result;
}

bool isStep(const std::string& key) { return key == "line_step" || key == "frame_step"; }

struct ChosenEffects {
  double columns = 0, rows = 0, seconds = 0, rate_hz = 0, noise_factor = 1, passes = 1, imaging = 0,
         imaging_seconds = 0;
  double seconds_factor = 1, compression = 1, mode = 0;
  bool laser = true;
  PanoramaCamera camera;
  double max_range_m = 0, reference_reflectivity = 0, unambiguous_m = 0;
  double points_per_s = 0, imaging_factor = 1;
  PointFilters drops;
  bool area = true, stepped = false;
  double rotation_hz = 0;
};

void addToCamera(PanoramaCamera& camera, const std::string& key, double value) {
  if (key == "picture_columns") camera.columns = static_cast<std::uint32_t>(value) / 2 * 2;
  if (key == "picture_hdr") camera.hdr = value > 0;
  if (key == "picture_metered") camera.metered = value > 0;
  if (key == "picture_stops") camera.stops += value;
  if (key == "picture_warmth") camera.warmth = value;
  if (key == "picture_flash") camera.flash = value;
}

ChosenEffects gather(const Instrument& instrument, const SettingValues& values) {
  ChosenEffects sum;
  sum.imaging_seconds = instrument.imaging_seconds;
  sum.camera = instrument.camera;
  sum.max_range_m = instrument.max_range_m;
  sum.reference_reflectivity = instrument.reference_reflectivity;
  sum.unambiguous_m = instrument.unambiguous_m;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const SettingChoice* choice = choiceOf(instrument.settings[i], values[i].second);
    if (choice == nullptr) continue;
    for (const auto& [key, value] : choice->effects) {
      if (key == "columns") sum.columns = value;
      if (key == "rows") sum.rows = value;
      if (key == "scan_seconds") sum.seconds = value;
      if (key == "rate_hz") sum.rate_hz = value;
      if (key == "noise_factor") sum.noise_factor *= value;
      if (key == "passes") sum.passes *= value;
      if (key == "imaging") sum.imaging = value;
      if (key == "imaging_seconds") sum.imaging_seconds = value;
      if (key == "max_range_m") sum.max_range_m = value;
      if (key == "reference_reflectivity") sum.reference_reflectivity = value;
      if (key == "unambiguous_m") sum.unambiguous_m = value;
      if (key == "drop_mixed_mm") sum.drops.deviation_m = 1e-3 * value;
      if (key == "drop_weak") sum.drops.weak_factor = value;
      if (key == "drop_overload") sum.drops.overload = value > 0;
      if (key == "area") sum.area = value > 0;
      if (key == "stepped") sum.stepped = value > 0;
      if (key == "points_per_s") sum.points_per_s = sum.points_per_s > 0 ? std::min(sum.points_per_s, value) : value;
      if (key == "rotation_hz") sum.rotation_hz = value;
      if (key == "imaging_factor") sum.imaging_factor *= value;
      if (key == "seconds_factor") sum.seconds_factor *= value;
      if (key == "compression") sum.compression = value;
      if (key == "mode") sum.mode = value;
      if (key == "laser") sum.laser = value > 0;
      if (key.starts_with("picture_")) addToCamera(sum.camera, key, value);
    }
  }
  if (sum.camera.hdr) sum.camera.flash = 0;  // brackets of the light that there is
  return sum;
}

double effectOf(const SettingChoice& choice, const char* key, double otherwise) {
  const auto found = choice.effects.find(key);
  return found == choice.effects.end() ? otherwise : found->second;
}

// Which speeds of the mirror and which noise compression a grid can have.
class GridLimits {
 public:
  GridLimits(const Instrument& instrument, double columns) : max_hz_(instrument.mirror_max_hz), columns_(columns) {
    for (const auto& setting : instrument.settings)
      for (const auto& choice : setting.choices) finest_ = std::max(finest_, effectOf(choice, "columns", 0));
  }
  // The mirror turns once for two columns, the front one and the back one, so a rate and a grid make a turning speed.
  bool turns(double rate_hz) const { return max_hz_ <= 0 || rate_hz <= 0 || rate_hz / columns_ <= max_hz_; }
  // A finer grid is measured and brought together, and it is one that the instrument has.
  bool compresses(double compression) const { return compression * columns_ <= std::max(finest_, columns_); }
  bool takes(const SettingChoice& choice) const {
    return turns(effectOf(choice, "rate_hz", 0)) && compresses(effectOf(choice, "compression", 1));
  }

 private:
  double max_hz_, columns_, finest_ = 0;
};

Result<void> checkGrid(const Instrument& instrument, const SettingValues& values, const ChosenEffects& effects) {
  const GridLimits limits(instrument, effects.columns);
  const bool turns = limits.turns(effects.rate_hz);
  if (turns && limits.compresses(effects.compression)) return {};
  const std::string why =
      turns ? "for its noise compression requires a finer grid than available"
            : "for the mirror would exceed " + std::to_string(static_cast<int>(instrument.mirror_max_hz)) + " Hz";
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::vector<std::string> words;
    bool decides = false;
    for (const auto& choice : instrument.settings[i].choices) {
      decides = decides || choice.effects.contains(turns ? "compression" : "rate_hz");
      if (limits.takes(choice)) words.push_back(choice.value);
    }
    if (decides)
      return failure(
          ErrorKind::usage,
          "\"" + values[i].second + "\" is not allowed at this resolution, " + why + "; allowed here: " + list(words),
          values[i].first);
  }
  return failure(ErrorKind::usage, "is not allowed, " + why, "settings");
}

Result<void> checkMode(const Instrument& instrument, const SettingValues& values, const ChosenEffects& effects) {
  const auto belongs = [&](const SettingChoice& c) { return effectOf(c, "of_mode", effects.mode) == effects.mode; };
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto& setting = instrument.settings[i];
    const auto* choice = choiceOf(setting, values[i].second);
    if (choice == nullptr || belongs(*choice)) continue;
    std::vector<std::string> words;
    for (const auto& other : setting.choices)
      if (belongs(other)) words.push_back(other.value);
    return failure(ErrorKind::usage, "\"" + values[i].second + "\" belongs to another mode; allowed: " + list(words),
                   values[i].first);
  }
  return {};
}

bool isGate(const std::string& key) { return key == "nearest_m" || key == "farthest_m"; }

// 0 where it is not set.
double gateOf(const SettingValues& values, const std::string& key) {
  for (const auto& [name, value] : values)
    if (name == key) return *number(value);
  return 0;
}

struct Area {
  double horizontal_from = 0, horizontal_to = 360, vertical_from = 0, vertical_to = 0;  // degrees
};

Result<Area> areaOf(const Instrument& instrument, const SettingValues& values, bool allowed_here) {
  Area area;
  area.vertical_from = instrument.min_elevation_rad / kRadPerDeg;
  area.vertical_to = instrument.max_elevation_rad / kRadPerDeg;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto& [key, value] = values[i];
    if (!instrument.settings[i].choices.empty() || isGate(key) || isStep(key)) continue;
    const double angle = *number(value);
    if (!allowed_here && angle != *number(instrument.settings[i].default_value))
      return failure(ErrorKind::usage, "area edges require the matching field of view", key);
    if (key == "horizontal_from") area.horizontal_from = angle;
    if (key == "horizontal_to") area.horizontal_to = angle;
    if (key == "vertical_from") area.vertical_from = angle;
    if (key == "vertical_to") area.vertical_to = angle;
  }
  if (area.horizontal_to <= area.horizontal_from) area.horizontal_to += 360;  // an area across the zero direction
  if (area.vertical_to <= area.vertical_from)
    return failure(ErrorKind::usage, "must be above vertical_from", "vertical_to");
  return area;
}

// The two steps of a pattern of one's own make the grid.
Result<void> applySteps(const Instrument& instrument, const SettingValues& values, ChosenEffects& effects) {
  const double full = (instrument.max_elevation_rad - instrument.min_elevation_rad) / kRadPerDeg;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto& [key, value] = values[i];
    if (!isStep(key)) continue;
    const double step = *number(value);
    if (!effects.stepped && step != *number(instrument.settings[i].default_value))
      return failure(ErrorKind::usage, "steps require the custom pattern", key);
    if (effects.stepped)
      (key == "frame_step" ? effects.columns : effects.rows) = std::round((key == "frame_step" ? 360 : full) / step);
  }
  return {};
}

}  // namespace

Result<ScanSettings> resolveSettings(const Instrument& instrument, const SettingValues& values) {
  if (instrument.moving)
    return failure(ErrorKind::usage,
                   "the " + instrument.maker + " " + instrument.model +
                       " is a mobile scanner and requires a trajectory; choose a tripod instrument for stations",
                   instrument.id);
  TRY_ASSIGN(auto filled, complete(instrument, values));
  ChosenEffects effects = gather(instrument, filled);
  TRY(applySteps(instrument, filled, effects));
  if (effects.columns < 2)
    return failure(ErrorKind::unusable, "no setting defines the columns", instrument.id + " /settings");
  TRY(checkMode(instrument, filled, effects));
  TRY(checkGrid(instrument, filled, effects));
  TRY_ASSIGN(auto area, areaOf(instrument, filled, effects.area));

  const double full = (instrument.max_elevation_rad - instrument.min_elevation_rad) / kRadPerDeg;
  const double fraction = (area.horizontal_to - area.horizontal_from) / 360;
  const double rows = effects.rows > 0 ? effects.rows : effects.columns * full / 360;
  const double mirror_hz = effects.rate_hz / effects.columns;
  // A pattern has a time of its own, unless the laser is too slow for it.
  if (effects.points_per_s > 0)
    effects.seconds = std::max(effects.seconds, effects.columns * rows / effects.points_per_s);
  const double turning = effects.seconds > 0 ? effects.seconds - instrument.overhead_s
                         : mirror_hz > 0     ? effects.columns / 2 * instrument.column_factor / mirror_hz
                                             : 0;
  if (turning <= 0)
    return failure(ErrorKind::unusable, "no setting defines the time or rate", instrument.id + " /settings");

  ScanSettings settings;
  settings.values = std::move(filled);
  settings.columns = static_cast<std::uint32_t>(std::max(1.0, std::round(effects.columns * fraction)));
  settings.rows =
      static_cast<std::uint32_t>(std::max(1.0, std::round(rows * (area.vertical_to - area.vertical_from) / full)));
  settings.azimuth_from_rad = area.horizontal_from * kRadPerDeg;
  settings.azimuth_to_rad = area.horizontal_to * kRadPerDeg;
  settings.elevation_from_rad = area.vertical_from * kRadPerDeg;
  settings.elevation_to_rad = area.vertical_to * kRadPerDeg;
  settings.max_range_m = effects.max_range_m;
  settings.reference_reflectivity = effects.reference_reflectivity;
  settings.noise_factor = effects.noise_factor;
  settings.passes = static_cast<int>(effects.passes);
  settings.laser = effects.laser;
  settings.imaging = effects.imaging > 0;
  settings.unambiguous_m = effects.unambiguous_m;
  settings.drops = effects.drops;
  settings.nearest_m = gateOf(settings.values, "nearest_m");
  settings.farthest_m = gateOf(settings.values, "farthest_m");
  if (settings.farthest_m > 0 && settings.farthest_m <= settings.nearest_m)
    return failure(ErrorKind::usage, "must be above nearest_m", "farthest_m");
  settings.camera = effects.camera;
  settings.scan_seconds =
      effects.laser ? (instrument.overhead_s + turning * effects.seconds_factor * fraction) * effects.passes : 0;
  settings.imaging_seconds = settings.imaging ? effects.imaging_seconds * effects.imaging_factor : 0;
  return settings;
}

Result<ScanSettings> resolveMovingSettings(const Instrument& instrument, const SettingValues& values) {
  if (!instrument.moving)
    return failure(ErrorKind::usage,
                   "the " + instrument.maker + " " + instrument.model +
                       " stands on a tripod and cannot be carried; choose a mobile scanner",
                   instrument.id);
  TRY_ASSIGN(auto filled, complete(instrument, values));
  const ChosenEffects effects = gather(instrument, filled);
  ScanSettings settings;
  settings.values = std::move(filled);
  settings.rotation_hz = effects.rotation_hz;
  settings.firing_s = instrument.moving->firing_s;
  if (effects.columns > 0 && effects.rotation_hz > 0) settings.firing_s = 1 / (effects.columns * effects.rotation_hz);
  if (effects.rate_hz > 0) settings.firing_s = 1 / effects.rate_hz;
  const bool turns = settings.rotation_hz > 0 || instrument.moving->max_rotation_hz <= 0;
  if (!turns || settings.firing_s <= 0)
    return failure(ErrorKind::unusable, "no setting defines the rotation, or the time of a firing",
                   instrument.id + " /settings");
  settings.max_range_m = effects.max_range_m;
  settings.reference_reflectivity = effects.reference_reflectivity;
  settings.noise_factor = effects.noise_factor;
  settings.unambiguous_m = effects.unambiguous_m;
  settings.drops = effects.drops;
  return settings;
}

}  // namespace standpoint
