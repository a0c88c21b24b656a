// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/radiometry/effects.h"

#include <algorithm>
#include <string>

namespace standpoint {

const std::array<EffectName, 23>& effectNames() {
  static constexpr std::array<EffectName, 23> kNames = {{
      {Effect::range_noise, "range-noise", "white noise of the range"},
      {Effect::angle_noise, "angle-noise", "jitter of the angles"},
      {Effect::bias, "bias", "systematic errors of range and angles"},
      {Effect::striping, "striping", "noise along and between columns"},
      {Effect::detection, "detection", "the loss of weak returns"},
      {Effect::chance, "chance", "chance at the detection threshold"},
      {Effect::near_range, "near-range", "the blindness at close range"},
      {Effect::atmosphere, "atmosphere", "extinction by the air"},
      {Effect::weather, "weather", "returns from drops, flakes, fog and dust"},
      {Effect::footprint, "footprint", "the beam's width: mixed points"},
      {Effect::panes, "panes", "the transparency of glass"},
      {Effect::mirrors, "mirrors", "mirror images"},
      {Effect::variation, "variation", "the variation of a material from place to place"},
      {Effect::saturation, "saturation", "range errors by too much light"},
      {Effect::quantisation, "quantisation", "the steps of the intensity"},
      {Effect::levelling, "levelling", "the error of the compensator where a station leans"},
      {Effect::amplitude_noise, "amplitude-noise", "the noise of the intensity"},
      {Effect::filters, "filters", "what the instrument's own filters flag and drop"},
      {Effect::ambiguity, "ambiguity", "the folding of far ranges by a phase-shift instrument"},
      {Effect::halo, "halo", "false points around retroreflectors"},
      {Effect::sun, "sun", "daylight in the receiver"},
      {Effect::interference, "interference", "returns of another instrument's light"},
      {Effect::rough_mirrors, "rough-mirrors", "mirror images in what is wet or glossy but not smooth"},
  }};
  return kNames;
}

std::string effectList() {
  std::string list;
  for (const auto& e : effectNames()) list += (list.empty() ? "" : ", ") + std::string(e.name);
  return list;
}

Result<Effects> effectsWithout(std::string_view names) {
  Effects effects;
  for (std::size_t from = 0; from <= names.size();) {
    const auto comma = std::min(names.find(',', from), names.size());
    const auto name = names.substr(from, comma - from);
    const auto& known = effectNames();
    const auto found = std::find_if(known.begin(), known.end(), [&](const EffectName& e) { return e.name == name; });
    if (found == known.end())
      return failure(ErrorKind::usage, "there is no effect '" + std::string(name) + "'; there are " + effectList(),
                     "--without");
    effects = effects.without(found->effect);
    from = comma + 1;
  }
  return effects;
}

}  // namespace standpoint
