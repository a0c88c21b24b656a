// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/radiometry/effects.h"

#include <algorithm>
#include <string>

namespace standpoint {

const std::array<EffectName, 27>& effectNames() {
  static constexpr std::array<EffectName, 27> kNames = {{
      {Effect::range_noise, "range-noise", "white range noise"},
      {Effect::angle_noise, "angle-noise", "angular jitter"},
      {Effect::bias, "bias", "systematic range and angle errors"},
      {Effect::striping, "striping", "noise along and between columns"},
      {Effect::detection, "detection", "loss of weak returns"},
      {Effect::chance, "chance", "randomness at the detection threshold"},
      {Effect::near_range, "near-range", "low sensitivity at close range"},
      {Effect::atmosphere, "atmosphere", "atmospheric extinction"},
      {Effect::weather, "weather", "returns from rain, snow, fog and dust"},
      {Effect::footprint, "footprint", "beam width: mixed points"},
      {Effect::panes, "panes", "transparency of glass"},
      {Effect::mirrors, "mirrors", "mirror images"},
      {Effect::variation, "variation", "variation of a material on and between surfaces"},
      {Effect::saturation, "saturation", "range errors from saturation"},
      {Effect::quantisation, "quantisation", "intensity quantisation"},
      {Effect::levelling, "levelling", "compensator error at tilted stations"},
      {Effect::amplitude_noise, "amplitude-noise", "intensity noise"},
      {Effect::filters, "filters", "filters built into the instrument"},
      {Effect::ambiguity, "ambiguity", "range ambiguity of phase-shift instruments"},
      {Effect::halo, "halo", "false points around retroreflectors"},
      {Effect::sun, "sun", "daylight in the receiver"},
      {Effect::interference, "interference", "interference from another instrument"},
      {Effect::rough_mirrors, "rough-mirrors", "mirror images in wet or glossy rough surfaces"},
      {Effect::textures, "textures", "images on surfaces: posters, prints, joints"},
      {Effect::range_offset, "range-offset", "longer ranges on dark surfaces"},
      {Effect::incidence_noise, "incidence-noise", "range noise of speckle on slanted surfaces"},
      {Effect::multipath, "multipath", "rounded corners of phase-shift instruments"},
  }};
  return kNames;
}

std::string effectList() {
  std::string list;
  for (const auto& e : effectNames()) list += (list.empty() ? "" : ", ") + std::string(e.name);
  return list;
}

std::string leftOut(Effects effects) {
  std::string names;
  for (const auto& e : effectNames())
    if (!effects.has(e.effect)) names += (names.empty() ? "" : ",") + std::string(e.name);
  return names;
}

Result<Effects> effectsWithout(std::string_view names) {
  Effects effects;
  for (std::size_t from = 0; from <= names.size();) {
    const auto comma = std::min(names.find(',', from), names.size());
    const auto name = names.substr(from, comma - from);
    const auto& known = effectNames();
    const auto found = std::find_if(known.begin(), known.end(), [&](const EffectName& e) { return e.name == name; });
    if (found == known.end())
      return failure(ErrorKind::usage, "unknown effect '" + std::string(name) + "'; available: " + effectList(),
                     "--without");
    effects = effects.without(found->effect);
    from = comma + 1;
  }
  return effects;
}

}  // namespace standpoint
