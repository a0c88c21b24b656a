// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/settings.h"

namespace standpoint {

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
  for (const auto& other : instrument.settings) {
    if (other.key == key) continue;
    for (const auto& choice : other.choices)
      if (const auto moved = withSetting(wanted, other.key, choice.value); resolveSettings(instrument, moved)) return moved;
  }
  auto plain = wanted;   // the edges of an area, the steps of a pattern of one's own
  for (const auto& other : instrument.settings)
    if (other.choices.empty() && other.key != key) plain = withSetting(plain, other.key, other.standard);
  if (resolveSettings(instrument, plain)) return plain;
  return failure(resolved.error());
}

}  // namespace standpoint
