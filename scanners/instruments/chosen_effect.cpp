// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/instruments/chosen_effect.h"

#include <algorithm>

namespace standpoint {

std::optional<double> chosenEffect(const Instrument& instrument, const SettingValues& values, const std::string& key) {
  for (const auto& setting : instrument.settings)
    for (const auto& choice : setting.choices) {
      const auto effect = choice.effects.find(key);
      if (effect != choice.effects.end() &&
          std::find(values.begin(), values.end(), std::pair(setting.key, choice.value)) != values.end())
        return effect->second;
    }
  return std::nullopt;
}

}  // namespace standpoint
