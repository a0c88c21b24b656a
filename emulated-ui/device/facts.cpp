// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "emulated-ui/device/device.h"
#include "emulated-ui/device/format.h"
#include "emulated-ui/device/numbers.h"

namespace standpoint {

namespace {

using Unit = FactUnit;

FactDomain yesOrNo() { return {{"yes", "no"}}; }
FactDomain anyWord() { return {}; }
FactDomain numbers(double minimum, double maximum) { return {{}, true, minimum, maximum}; }

const BodyRow& body(const Device& d) { return d.type().definition.body; }
const Surroundings& around(const Device& d) { return d.state().around; }

double freeBytes(const Device& d) {
  return around(d).card_present && !around(d).card_locked
             ? std::max(0.0, around(d).card_bytes - around(d).card_used_bytes)
             : 0;
}

double phaseLasts(const Device& d) {
  const auto* phase = findPhase(d.type().definition, d.state().phase);
  if (phase->lasts.empty()) return 0;
  if (const auto number = numberIn(phase->lasts)) return *number;
  return d.fact(phase->lasts).value_or(numberFact(0)).number.value_or(0);
}

double phaseProgress(const Device& d) {
  const double lasts = phaseLasts(d);
  return lasts > 0 ? std::clamp(d.state().elapsed_s / lasts, 0.0, 1.0) : 0;
}

// What is done of the whole scan with its pictures, never further than the simulation behind it.
double progress(const Device& d) {
  const auto& s = d.state();
  if (!s.running) return 0;
  const double fraction =
      std::clamp(s.scanned_s / std::max(1.0, d.expected().scan_seconds + d.expected().imaging_seconds), 0.0, 1.0);
  return s.data ? fraction : std::min(fraction, s.engine_fraction);
}

// By the instrument's clock, which may be ahead of the simulation.
double remaining(const Device& d) {
  return d.state().running
             ? std::max(0.0, d.expected().scan_seconds + d.expected().imaging_seconds - d.state().scanned_s)
             : 0;
}

double spacing(const Device& d) {
  const auto& e = d.expected();
  return (e.azimuth_to_rad - e.azimuth_from_rad) / std::max(1U, e.columns) * 10 * 1000;
}

double points(const Device& d) {
  return d.expected().laser ? static_cast<double>(d.expected().columns) * d.expected().rows : 0;
}

int nextNumber(const Device& d) {
  const auto* p = d.project();
  if (p == nullptr) return 1;
  int next = p->first;
  for (const auto& s : p->setups) next = std::max(next, s.number + 1);
  return next;
}

double setups(const Device& d) { return d.project() == nullptr ? 0 : static_cast<double>(d.project()->setups.size()); }

double countAll(const Device& d, bool (*which)(const StoredSetup&)) {
  double n = 0;
  for (const auto& p : d.state().projects)
    n += static_cast<double>(std::count_if(p.setups.begin(), p.setups.end(), which));
  return n;
}

double foundTargets(const StoredSetup* s) {
  return s == nullptr ? 0
                      : static_cast<double>(std::count_if(s->targets.begin(), s->targets.end(),
                                                          [](const FittedTarget& t) { return t.found; }));
}

double worstResidual(const StoredSetup* s) {
  double worst = 0;
  if (s != nullptr)
    for (const auto& t : s->targets) worst = t.found ? std::max(worst, t.residual_m * 1000) : worst;
  return worst;
}

double newest(const Device& d, bool (*which)(const StoredSetup&)) {
  return d.newestSetup() != nullptr && which(*d.newestSetup()) ? 1 : 0;
}

std::string linkState(const StoredSetup* s) {
  if (s == nullptr || !s->link) return "none";
  return s->link->joined ? "joined" : "failed";
}

std::string warmState(const Device& d) { return around(d).acclimatised_s >= body(d).warm_up_s ? "yes" : "no"; }

std::string temperatureState(const Device& d) {
  const double t = around(d).temperature_c;
  return t < body(d).coldest_c ? "cold" : t > body(d).hottest_c ? "hot" : "good";
}

std::string levelState(const Device& d) {
  const double t = d.tilt();
  return t <= body(d).tilt_full_deg ? "good" : t <= body(d).tilt_limit_deg ? "reduced" : "out";
}

Fact measured(const Device& d, const char* entry) {
  const auto text = d.entry(entry);
  return text.empty() ? wordFact("") : numberFact(std::strtod(text.c_str(), nullptr));
}

}  // namespace

const std::vector<FactRow>& sharedFacts() {
  static const std::vector<FactRow> rows = {
      {"power",
       Unit::none,
       {{"on", "off"}},
       [](const Device& d) { return wordFact(d.on() ? "on" : "off"); },
       "whether the device is powered on"},
      {"asleep", Unit::none, yesOrNo(), [](const Device& d) { return yesNo(d.asleep()); },
       "the display is dark after idling"},
      {"clock", Unit::seconds, numbers(0, 1e9), [](const Device& d) { return numberFact(d.state().clock_s); },
       "device time in seconds"},
      {"phase.lasts", Unit::seconds, numbers(0, 1e6), [](const Device& d) { return numberFact(phaseLasts(d)); },
       "duration of the phase in seconds"},
      {"phase.elapsed", Unit::seconds, numbers(0, 1e9), [](const Device& d) { return numberFact(d.state().elapsed_s); },
       "seconds since the phase started"},
      {"phase.progress", Unit::fraction, numbers(0, 1), [](const Device& d) { return numberFact(phaseProgress(d)); },
       "completed fraction of the phase"},
      {"battery", Unit::fraction, numbers(0, 1), [](const Device& d) { return numberFact(around(d).battery); },
       "remaining fraction"},
      {"battery.state",
       Unit::none,
       {{"good", "low", "critical"}},
       [](const Device& d) {
         const double b = around(d).battery;
         return wordFact(b < body(d).battery_critical ? "critical" : b < body(d).battery_warning ? "low" : "good");
       },
       "rated by the device's limits"},
      {"mains", Unit::none, yesOrNo(), [](const Device& d) { return yesNo(around(d).mains); },
       "whether mains power is connected"},
      {"card",
       Unit::none,
       {{"present", "absent", "locked"}},
       [](const Device& d) {
         return wordFact(!around(d).card_present ? "absent" : around(d).card_locked ? "locked" : "present");
       },
       "the memory card or USB stick"},
      {"card.free", Unit::bytes, numbers(0, 1e16), [](const Device& d) { return numberFact(freeBytes(d)); },
       "writable bytes"},
      {"card.scans_left", Unit::none, numbers(0, 1e9),
       [](const Device& d) { return numberFact(std::floor(freeBytes(d) / std::max(1.0, d.expectedBytes()))); },
       "number of scans with these settings that still fit"},
      {"cover",
       Unit::none,
       {{"open", "closed"}},
       [](const Device& d) { return wordFact(around(d).cover_open ? "open" : "closed"); },
       "cover of the battery and memory compartment"},
      {"temperature", Unit::celsius, numbers(-60, 90),
       [](const Device& d) { return numberFact(around(d).temperature_c); }, "of the instrument"},
      {"temperature.state",
       Unit::none,
       {{"good", "cold", "hot"}},
       [](const Device& d) { return wordFact(temperatureState(d)); },
       "rated by the device's limits"},
      {"warm", Unit::none, yesOrNo(), [](const Device& d) { return wordFact(warmState(d)); },
       "the instrument has reached its operating temperature"},
      {"tilt", Unit::degrees, numbers(0, 90), [](const Device& d) { return numberFact(d.tilt()); },
       "tilt of the vertical axis"},
      {"tilt.x", Unit::degrees, numbers(-90, 90), [](const Device& d) { return numberFact(around(d).tilt_x_deg); }, ""},
      {"tilt.y", Unit::degrees, numbers(-90, 90), [](const Device& d) { return numberFact(around(d).tilt_y_deg); }, ""},
      {"level",
       Unit::none,
       {{"good", "reduced", "out"}},
       [](const Device& d) { return wordFact(levelState(d)); },
       "rated by the compensator's limits"},
      {"dust", Unit::none, yesOrNo(), [](const Device& d) { return yesNo(around(d).dust); }, "dust on the optics"},
      {"station", Unit::none, anyWord(), [](const Device& d) { return wordFact(around(d).station); },
       "station of the tripod"},
      {"standing", Unit::none, yesOrNo(), [](const Device& d) { return yesNo(!around(d).station.empty()); },
       "whether the tripod is at a station"},
      {"nearest", Unit::metres, numbers(0, 1e6), [](const Device& d) { return numberFact(around(d).nearest_m); },
       "distance to the nearest surface in metres"},
      {"nearest.least", Unit::metres, numbers(0, 1e6),
       [](const Device& d) { return numberFact(d.type().instrument.min_range_m); },
       "minimum range from the data sheet"},
      {"operator.in_view", Unit::none, yesOrNo(), [](const Device& d) { return yesNo(around(d).operator_in_view); },
       "the operator is in the scanner's view"},
      {"tracking", Unit::none, yesOrNo(), [](const Device& d) { return yesNo(around(d).tracking); },
       "the path between setups is tracked"},
      {"wlan", Unit::none, yesOrNo(), [](const Device& d) { return yesNo(around(d).wlan); },
       "whether the wireless link works"},
      {"tripod_moved", Unit::none, yesOrNo(), [](const Device& d) { return yesNo(d.state().moved); },
       "the tripod was moved during this scan"},
      {"project", Unit::none, anyWord(),
       [](const Device& d) { return wordFact(d.project() == nullptr ? "" : d.project()->name); },
       "name of the open project or job"},
      {"project.open", Unit::none, yesOrNo(), [](const Device& d) { return yesNo(d.project() != nullptr); },
       "whether a project is open"},
      {"project.base", Unit::none, anyWord(),
       [](const Device& d) { return wordFact(d.project() == nullptr ? "" : d.project()->base); },
       "base of the scans' names"},
      {"project.cluster", Unit::none, anyWord(),
       [](const Device& d) { return wordFact(d.project() == nullptr ? "" : d.project()->cluster); },
       "folder of the next scans"},
      {"project.first", Unit::none, numbers(0, 1e6),
       [](const Device& d) { return numberFact(d.project() == nullptr ? 0 : d.project()->first); },
       "number of its first setup"},
      {"projects", Unit::none, numbers(0, 1e6),
       [](const Device& d) { return numberFact(static_cast<double>(d.state().projects.size())); }, "on the device"},
      {"setups", Unit::none, numbers(0, 1e6), [](const Device& d) { return numberFact(setups(d)); },
       "stored in the open project"},
      {"setups.all", Unit::none, numbers(0, 1e6),
       [](const Device& d) { return numberFact(countAll(d, [](const StoredSetup&) { return true; })); },
       "on the device"},
      {"setups.transferred", Unit::none, numbers(0, 1e6),
       [](const Device& d) { return numberFact(countAll(d, [](const StoredSetup& s) { return s.transferred; })); },
       "with a copy in the office"},
      {"setups.untransferred", Unit::none, numbers(0, 1e6),
       [](const Device& d) { return numberFact(countAll(d, [](const StoredSetup& s) { return !s.transferred; })); },
       "setups that are only on the card"},
      {"setups.looked_at", Unit::none, numbers(0, 1e6),
       [](const Device& d) { return numberFact(countAll(d, [](const StoredSetup& s) { return s.looked_at; })); },
       "setups whose preview was opened"},
      {"setups.tripod_moved", Unit::none, numbers(0, 1e6),
       [](const Device& d) { return numberFact(countAll(d, [](const StoredSetup& s) { return s.moved; })); },
       "setups affected by tripod movement"},
      {"setup.next", Unit::none, numbers(0, 1e6), [](const Device& d) { return numberFact(nextNumber(d)); },
       "number of the next setup"},
      {"newest.name", Unit::none, anyWord(),
       [](const Device& d) { return wordFact(d.newestSetup() == nullptr ? "" : d.newestSetup()->name); },
       "of the newest setup"},
      {"newest.partial", Unit::none, yesOrNo(),
       [](const Device& d) { return yesNo(newest(d, [](const StoredSetup& s) { return s.partial; }) > 0); },
       "the setup is incomplete"},
      {"newest.unlevelled", Unit::none, yesOrNo(),
       [](const Device& d) { return yesNo(newest(d, [](const StoredSetup& s) { return s.unlevelled; }) > 0); },
       "stored without levelling"},
      {"newest.tripod_moved", Unit::none, yesOrNo(),
       [](const Device& d) { return yesNo(newest(d, [](const StoredSetup& s) { return s.moved; }) > 0); },
       "the tripod was moved during the setup"},
      {"newest.targets", Unit::none, numbers(0, 1e4),
       [](const Device& d) { return numberFact(foundTargets(d.newestSetup())); }, "targets found in the newest setup"},
      {"newest.sampled", Unit::none, numbers(0, 1e9),
       [](const Device& d) {
         double least = -1;
         if (d.newestSetup() != nullptr)
           for (const auto& t : d.newestSetup()->targets)
             if (t.found) least = least < 0 ? t.points : std::min<double>(least, t.points);
         return numberFact(std::max(0.0, least));
       },
       "lowest number of points on a target of the newest setup"},
      {"newest.residual", Unit::millimetres, numbers(0, 1e6),
       [](const Device& d) { return numberFact(worstResidual(d.newestSetup())); },
       "largest target residual in millimetres"},
      {"link",
       Unit::none,
       {{"none", "joined", "failed"}},
       [](const Device& d) { return wordFact(linkState(d.newestSetup())); },
       "link of the newest setup to the previous one"},
      {"link.overlap", Unit::fraction, numbers(0, 1),
       [](const Device& d) {
         return numberFact(d.newestSetup() != nullptr && d.newestSetup()->link ? d.newestSetup()->link->overlap : 0);
       },
       "overlap as a fraction of the newer cloud"},
      {"link.error", Unit::millimetres, numbers(0, 1e6),
       [](const Device& d) {
         return numberFact(d.newestSetup() != nullptr && d.newestSetup()->link ? d.newestSetup()->link->error_m * 1000
                                                                               : 0);
       },
       "RMS in millimetres"},
      {"shown.name", Unit::none, anyWord(),
       [](const Device& d) { return wordFact(d.shownSetup() == nullptr ? "" : d.shownSetup()->name); },
       "of the displayed setup"},
      {"shown.station", Unit::none, anyWord(),
       [](const Device& d) { return wordFact(d.shownSetup() == nullptr ? "" : d.shownSetup()->station); }, ""},
      {"shown.points", Unit::points, numbers(0, 1e12),
       [](const Device& d) {
         return numberFact(d.shownSetup() == nullptr ? 0 : static_cast<double>(d.shownSetup()->points));
       },
       ""},
      {"shown.bytes", Unit::bytes, numbers(0, 1e16),
       [](const Device& d) { return numberFact(d.shownSetup() == nullptr ? 0 : d.shownSetup()->bytes); }, ""},
      {"shown.seconds", Unit::seconds, numbers(0, 1e9),
       [](const Device& d) { return numberFact(d.shownSetup() == nullptr ? 0 : d.shownSetup()->instrument_seconds); },
       ""},
      {"shown.targets", Unit::none, numbers(0, 1e4),
       [](const Device& d) { return numberFact(foundTargets(d.shownSetup())); },
       "targets found in the displayed setup"},
      {"shown.transferred", Unit::none, yesOrNo(),
       [](const Device& d) { return yesNo(d.shownSetup() != nullptr && d.shownSetup()->transferred); }, ""},
      {"measured", Unit::metres, numbers(0, 1e6), [](const Device& d) { return measured(d, "measured"); },
       "distance between the two points picked in the preview, in metres"},
      {"measured.horizontal", Unit::metres, numbers(0, 1e6),
       [](const Device& d) { return measured(d, "measured_horizontal"); }, "horizontal distance between them"},
      {"measured.vertical", Unit::metres, numbers(-1e6, 1e6),
       [](const Device& d) { return measured(d, "measured_vertical"); }, "height difference of the second point"},
      {"expected.seconds", Unit::seconds, numbers(0, 1e6),
       [](const Device& d) { return numberFact(d.expected().scan_seconds + d.expected().imaging_seconds); },
       "next scan including images"},
      {"expected.scan", Unit::seconds, numbers(0, 1e6),
       [](const Device& d) { return numberFact(d.expected().scan_seconds); }, "laser only"},
      {"expected.pass", Unit::seconds, numbers(0, 1e6),
       [](const Device& d) { return numberFact(d.expected().scan_seconds / d.expected().passes); }, "one laser pass"},
      {"expected.overhead", Unit::seconds, numbers(0, 1e6),
       [](const Device& d) { return numberFact(d.type().instrument.overhead_s); }, "time before and after the sweep"},
      {"expected.sweep", Unit::seconds, numbers(0, 1e6),
       [](const Device& d) {
         return numberFact(std::max(0.0, d.expected().scan_seconds - d.type().instrument.overhead_s));
       },
       "rotation of the head"},
      {"expected.imaging", Unit::seconds, numbers(0, 1e6),
       [](const Device& d) { return numberFact(d.expected().imaging_seconds); }, "imaging"},
      {"expected.points", Unit::points, numbers(0, 1e12), [](const Device& d) { return numberFact(points(d)); },
       "none for image-only settings"},
      {"expected.columns", Unit::none, numbers(0, 1e9),
       [](const Device& d) { return numberFact(d.expected().columns); }, ""},
      {"expected.rows", Unit::none, numbers(0, 1e9), [](const Device& d) { return numberFact(d.expected().rows); }, ""},
      {"expected.bytes", Unit::bytes, numbers(0, 1e16), [](const Device& d) { return numberFact(d.expectedBytes()); },
       ""},
      {"expected.spacing", Unit::millimetres, numbers(0, 1e6), [](const Device& d) { return numberFact(spacing(d)); },
       "column spacing at 10 m in millimetres"},
      {"expected.noise", Unit::none, numbers(0, 1000),
       [](const Device& d) { return numberFact(d.expected().noise_factor); }, "factor on the data sheet's range noise"},
      {"expected.range", Unit::metres, numbers(0, 1e5),
       [](const Device& d) { return numberFact(d.expected().max_range_m); }, "maximum range with these settings"},
      {"passes", Unit::none, numbers(1, 2), [](const Device& d) { return numberFact(d.expected().passes); },
       "laser passes: two for a double scan"},
      {"imaging", Unit::none, yesOrNo(), [](const Device& d) { return yesNo(d.expected().imaging); },
       "whether images are taken"},
      {"progress", Unit::fraction, numbers(0, 1), [](const Device& d) { return numberFact(progress(d)); },
       "of the running scan"},
      {"remaining", Unit::seconds, numbers(0, 1e6), [](const Device& d) { return numberFact(remaining(d)); },
       "of the running scan"},
      {"data", Unit::none, yesOrNo(), [](const Device& d) { return yesNo(d.state().data.has_value()); },
       "the simulation of the running scan has finished"},
  };
  return rows;
}

FactLookup Device::facts() const {
  return [this](const std::string& name) { return fact(name); };
}

std::optional<Fact> Device::fact(const std::string& name) const {
  if (name.starts_with("setting.")) {
    const auto text = setting(name.substr(8));
    if (text.empty()) return std::nullopt;
    return Fact{text, numberIn(text)};
  }
  if (name.starts_with("value.")) {
    const auto found = state_.values.find(name.substr(6));
    if (found == state_.values.end()) return std::nullopt;
    return Fact{found->second, numberIn(found->second)};
  }
  if (name.starts_with("entry.")) {
    const auto found = state_.entries.find(name.substr(6));
    return wordFact(found == state_.entries.end() ? "" : found->second);
  }
  if (name == "phase") return wordFact(state_.phase);
  if (name == "screen") return wordFact(state_.screen);
  if (name == "dialog") return wordFact(state_.dialog);
  for (const auto* rows : {&type_->program.facts, &sharedFacts()})
    for (const auto& row : *rows)
      if (name == row.name) return row.value(*this);
  return std::nullopt;
}

double Device::number(const std::string& name) const {
  const auto found = fact(name);
  return found ? found->number.value_or(0) : 0;
}

std::optional<FactDomain> Device::domain(const std::string& name) const {
  const auto& d = type_->definition;
  const auto ids = [](const auto& rows) {
    FactDomain domain;
    for (const auto& row : rows) domain.words.push_back(row.id);
    return domain;
  };
  if (name == "phase") return ids(d.phases);
  if (name == "screen") return ids(d.screens);
  if (name == "dialog") {
    auto domain = ids(d.dialogs);
    domain.words.emplace_back("");
    return domain;
  }
  if (name.starts_with("entry.")) return anyWord();
  if (name.starts_with("setting.")) {
    for (const auto& s : type_->instrument.settings) {
      if (s.key != name.substr(8)) continue;
      if (s.choices.empty()) return numbers(s.minimum, s.maximum);
      FactDomain domain;
      for (const auto& choice : s.choices) domain.words.push_back(choice.value);
      return domain;
    }
    return std::nullopt;
  }
  if (name.starts_with("value.")) {
    const auto* value = findValue(d, name.substr(6));
    if (value == nullptr) return std::nullopt;
    if (value->kind == WidgetKind::number) return numbers(value->minimum, value->maximum);
    return FactDomain{value->choices, false, 0, 0};
  }
  for (const auto* rows : {&type_->program.facts, &sharedFacts()})
    for (const auto& row : *rows)
      if (name == row.name) return row.domain;
  return std::nullopt;
}

std::string Device::shown(const std::string& name) const {
  const auto found = fact(name);
  if (!found) return {};
  // What stands in a word's braces is not filled in once more: words that name each other would never end.
  const auto plain = [&](const std::string& key) {
    return type_->words->text(type_->definition.id, key, state_.language);
  };
  FactUnit unit = FactUnit::none;
  for (const auto* rows : {&type_->program.facts, &sharedFacts()})
    for (const auto& row : *rows)
      if (name == row.name) unit = row.unit;
  if (!found->number && (name.starts_with("setting.") || name.starts_with("value."))) {
    const auto key = name.substr(name.find('.') + 1) + "=" + found->text;
    if (type_->words->has(type_->definition.id, key, "en")) return plain(key);
    for (const auto& s : type_->instrument.settings)
      for (const auto& choice : s.choices)
        if (name.substr(8) == s.key && choice.value == found->text) return choice.label;
  }
  if (found->text.empty() && !found->number) return "–";
  if (!found->number && type_->words->has(type_->definition.id, name + "=" + found->text, "en"))
    return plain(name + "=" + found->text);
  if ((found->text == "yes" || found->text == "no" || found->text == "on" || found->text == "off") && !found->number)
    return plain(found->text);
  return factText(*found, unit, showsFeet());
}

}  // namespace standpoint
