// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/scan_form.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "editor/words/words.h"
#include "project/survey/scan_request.h"

namespace standpoint {

namespace {

std::string joined(std::string a, const std::string& b, const char* gap) {
  return a.empty() ? b : std::move(a) + gap + b;
}

}  // namespace

void chooseInstrument(ScanChoice& asked, const Instrument& instrument) {
  asked.instrument = instrument.id;
  asked.settings.clear();
  for (const auto& setting : instrument.settings) asked.settings.emplace_back(setting.key, setting.default_value);
}

ScanVerbOptions optionsAlong(const CarriedScan& carried, const std::string& trajectory) {
  auto options = optionsOf(carried.choice);
  options.trajectory = trajectory;
  options.trajectory_error = carried.error;
  options.closures = carried.closures ? Switch::on : Switch::off;
  options.anchors = carried.anchors ? Switch::on : Switch::off;
  options.deskew = carried.deskew;
  return options;
}

std::string effectsSummary(Effects effects, ScanQuality quality) {
  if (quality == ScanQuality::preview) return joined(effectsSummary(effects), tr("preview quality"), ", ");
  if (quality == ScanQuality::reference) return joined(effectsSummary(effects), tr("reference quality"), ", ");
  if (effects == Effects()) return tr("all effects");
  if (effects == Effects::none()) return "ideal";
  const auto left_out = leftOut(effects);
  const auto count = static_cast<std::size_t>(std::count(left_out.begin(), left_out.end(), ',')) + 1;
  if (count <= 2) return trf("without {}", left_out);
  return trf("{} of {} effects", effectNames().size() - count, effectNames().size());
}

std::string weatherSummary(const Weather& w) {
  std::string text;
  if (w.rain_mm_h > 0) text = trf("rain {} mm/h", w.rain_mm_h);
  if (w.snow_mm_h > 0) text = joined(text, trf("snow {} mm/h", w.snow_mm_h), ", ");
  if (w.fog_mor_m > 0) text = joined(text, trf("fog {} m", w.fog_mor_m), ", ");
  if (w.dust_mor_m > 0) text = joined(text, trf("dust {} m", w.dust_mor_m), ", ");
  if (w.visibility_km != Weather().visibility_km) text = joined(text, trf("visibility {} km", w.visibility_km), ", ");
  return text.empty() ? tr("clear air") : text;
}

std::string readableEffect(const EffectName& effect) {
  std::string name(effect.name);
  std::replace(name.begin(), name.end(), '-', ' ');
  name.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(name.front())));
  return name;
}

}  // namespace standpoint
