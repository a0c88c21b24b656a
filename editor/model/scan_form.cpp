// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/scan_form.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "project/scan_request.h"

namespace standpoint {

namespace {

std::string joined(std::string a, const std::string& b, const char* gap) {
  return a.empty() ? b : std::move(a) + gap + b;
}

// As `--weather` takes it; nothing where the air is clear.
std::string weatherOption(const Weather& w) {
  std::string text;
  if (w.visibility_km != Weather().visibility_km) text = fmt::format("visibility={}", w.visibility_km);
  if (w.rain_mm_h > 0) text = joined(text, fmt::format("rain={}", w.rain_mm_h), " ");
  if (w.snow_mm_h > 0) text = joined(text, fmt::format("snow={}", w.snow_mm_h), " ");
  if (w.fog_mor_m > 0) text = joined(text, fmt::format("fog={}", w.fog_mor_m), " ");
  if (w.dust_mor_m > 0) text = joined(text, fmt::format("dust={}", w.dust_mor_m), " ");
  return text;
}

}  // namespace

nlohmann::json scanOptions(const ScanChoice& asked) {
  nlohmann::json set = nlohmann::json::array();
  for (const auto& [key, value] : asked.settings) set.push_back(key + "=" + value);
  nlohmann::json options = {{"instrument", asked.instrument},
                            {"set", std::move(set)},
                            {"seed", asked.seed},
                            {"compensator", asked.compensator ? "on" : "off"}};
  if (asked.effects == Effects::none())
    options["ideal"] = true;
  else if (const auto without = leftOut(asked.effects); !without.empty())
    options["without"] = without;
  if (const auto weather = weatherOption(asked.weather); !weather.empty()) options["weather"] = weather;
  if (asked.truth) options["truth"] = true;
  if (asked.panorama) options["panorama"] = true;
  if (asked.panorama && asked.panorama_columns > 0) options["panorama-size"] = asked.panorama_columns;
  return options;
}

void chooseInstrument(ScanChoice& asked, const Instrument& instrument) {
  asked.instrument = instrument.id;
  asked.settings.clear();
  for (const auto& setting : instrument.settings) asked.settings.emplace_back(setting.key, setting.default_value);
}

std::string effectsSummary(Effects effects) {
  if (effects == Effects()) return "all effects";
  if (effects == Effects::none()) return "ideal";
  const auto left_out = leftOut(effects);
  const auto count = static_cast<std::size_t>(std::count(left_out.begin(), left_out.end(), ',')) + 1;
  if (count <= 2) return "without " + left_out;
  return fmt::format("{} of {} effects", effectNames().size() - count, effectNames().size());
}

std::string weatherSummary(const Weather& w) {
  std::string text;
  if (w.rain_mm_h > 0) text = fmt::format("rain {} mm/h", w.rain_mm_h);
  if (w.snow_mm_h > 0) text = joined(text, fmt::format("snow {} mm/h", w.snow_mm_h), ", ");
  if (w.fog_mor_m > 0) text = joined(text, fmt::format("fog {} m", w.fog_mor_m), ", ");
  if (w.dust_mor_m > 0) text = joined(text, fmt::format("dust {} m", w.dust_mor_m), ", ");
  if (w.visibility_km != Weather().visibility_km)
    text = joined(text, fmt::format("visibility {} km", w.visibility_km), ", ");
  return text.empty() ? "clear air" : text;
}

std::string readableEffect(const EffectName& effect) {
  std::string name(effect.name);
  std::replace(name.begin(), name.end(), '-', ' ');
  name.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(name.front())));
  return name;
}

}  // namespace standpoint
