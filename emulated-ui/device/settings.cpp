// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/settings.h"

#include <algorithm>
#include <cstdlib>

namespace standpoint {

namespace {

std::vector<std::string> nearestFirst(const InstrumentSetting& setting, const SettingValues& now) {
  std::vector<std::string> values;
  for (const auto& choice : setting.choices) values.push_back(choice.value);
  std::ptrdiff_t at = 0;
  for (const auto& [key, value] : now)
    if (key == setting.key) at = std::find(values.begin(), values.end(), value) - values.begin();
  const auto all = values;
  const auto away = [&](const std::string& v) {
    return std::abs(std::find(all.begin(), all.end(), v) - all.begin() - at);
  };
  std::stable_sort(values.begin(), values.end(),
                   [&](const std::string& a, const std::string& b) { return away(a) < away(b); });
  return values;
}

}  // namespace

SettingValues withSetting(SettingValues values, const std::string& key, const std::string& value) {
  for (auto& [name, current] : values)
    if (name == key) current = value;
  return values;
}

Result<SettingValues> adaptedSettings(const Instrument& instrument, const SettingValues& now, const std::string& key,
                                      const std::string& value) {
  const auto wanted = withSetting(now, key, value);
  auto resolved = resolveSettings(instrument, wanted);
  if (resolved) return wanted;
  bool after = false;
  for (const auto& other : instrument.settings) {
    if (after)
      for (const auto& choice : nearestFirst(other, wanted))
        if (const auto moved = withSetting(wanted, other.key, choice); resolveSettings(instrument, moved)) return moved;
    after = after || other.key == key;
  }
  auto plain = wanted;  // the edges of an area, the steps of a pattern of one's own
  for (const auto& other : instrument.settings)
    if (other.choices.empty() && other.key != key) plain = withSetting(plain, other.key, other.default_value);
  if (resolveSettings(instrument, plain)) return plain;
  return failure(resolved.error());
}

std::string settingsText(const SettingValues& settings) {
  std::string text;
  for (const auto& [key, value] : settings) text += key + "=" + value + ";";
  return text;
}

SettingValues settingsFromText(const std::string& text) {
  SettingValues settings;
  for (std::size_t at = 0; at < text.size();) {
    const auto end = text.find(';', at);
    const auto equals = text.find('=', at);
    if (end == std::string::npos || equals > end) break;
    settings.emplace_back(text.substr(at, equals - at), text.substr(equals + 1, end - equals - 1));
    at = end + 1;
  }
  return settings;
}

}  // namespace standpoint
