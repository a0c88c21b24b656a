// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "emulated-ui/device/device.h"
#include "emulated-ui/device/format.h"
#include "emulated-ui/device/linking.h"
#include "emulated-ui/device/numbers.h"
#include "emulated-ui/device/setup_facts.h"

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
  return phase->lasts_fact.empty() ? phase->lasts_s.value_or(0) : d.number(phase->lasts_fact);
}

double phaseProgress(const Device& d) {
  const double lasts = phaseLasts(d);
  return lasts > 0 ? std::clamp(d.state().elapsed_s / lasts, 0.0, 1.0) : 0;
}

double wholeScan_s(const Device& d) { return d.expected().scan_seconds + d.expected().imaging_seconds; }

// What is done of the whole scan with its pictures, never further than the simulation behind it.
double progress(const Device& d) {
  const auto& s = d.state();
  if (!s.running) return 0;
  const double fraction = std::clamp(s.scanned_s / std::max(1.0, wholeScan_s(d)), 0.0, 1.0);
  return s.data ? fraction : std::min(fraction, s.engine_fraction);
}

// By the instrument's clock, as far as the scan has come: where that waits for the simulation, this does, too.
double remaining(const Device& d) { return d.state().running ? (1 - progress(d)) * wholeScan_s(d) : 0; }

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

std::string linkState(const StoredSetup* s) {
  if (s == nullptr || !s->link) return "none";
  return s->link->joined ? "joined" : "failed";
}

LinkResult lastLink(const Device& d) {
  const auto* setup = setupOfFile(d, d.state().linking);
  return setup != nullptr && setup->link ? *setup->link : LinkResult{};
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
  return text.empty() ? wordFact("") : numberFact(numberIn(text).value_or(0));
}

}  // namespace

const std::vector<FactRow>& sharedFacts() {
  static const std::vector<FactRow> rows = [] {
    std::vector<FactRow> all = {
        {.name = "power",
         .domain = {{"on", "off"}},
         .value = [](const Device& d) { return wordFact(d.on() ? "on" : "off"); },
         .about = "whether the device is powered on"},
        {.name = "asleep",
         .domain = yesOrNo(),
         .value = [](const Device& d) { return yesNo(d.asleep()); },
         .about = "the display is dark after idling"},
        {.name = "clock",
         .unit = Unit::seconds,
         .domain = numbers(0, 1e9),
         .value = [](const Device& d) { return numberFact(d.state().clock_s); },
         .about = "device time in seconds"},
        {.name = "phase.lasts",
         .unit = Unit::seconds,
         .domain = numbers(0, 1e6),
         .value = [](const Device& d) { return numberFact(phaseLasts(d)); },
         .about = "duration of the phase in seconds"},
        {.name = "phase.elapsed",
         .unit = Unit::seconds,
         .domain = numbers(0, 1e9),
         .value = [](const Device& d) { return numberFact(d.state().elapsed_s); },
         .about = "seconds since the phase started"},
        {.name = "phase.progress",
         .unit = Unit::fraction,
         .domain = numbers(0, 1),
         .value = [](const Device& d) { return numberFact(phaseProgress(d)); },
         .about = "completed fraction of the phase"},
        {.name = "battery",
         .unit = Unit::fraction,
         .domain = numbers(0, 1),
         .value = [](const Device& d) { return numberFact(around(d).battery); },
         .about = "remaining fraction"},
        {.name = "battery.state",
         .domain = {{"good", "low", "critical"}},
         .value =
             [](const Device& d) {
               const double b = around(d).battery;
               return wordFact(b < body(d).battery_critical  ? "critical"
                               : b < body(d).battery_warning ? "low"
                                                             : "good");
             },
         .about = "rated by the device's limits"},
        {.name = "mains",
         .domain = yesOrNo(),
         .value = [](const Device& d) { return yesNo(around(d).mains); },
         .about = "whether mains power is connected"},
        {.name = "card",
         .domain = {{"present", "absent", "locked"}},
         .value =
             [](const Device& d) {
               return wordFact(!around(d).card_present ? "absent" : around(d).card_locked ? "locked" : "present");
             },
         .about = "the memory card or USB stick"},
        {.name = "card.free",
         .unit = Unit::bytes,
         .domain = numbers(0, 1e16),
         .value = [](const Device& d) { return numberFact(freeBytes(d)); },
         .about = "writable bytes"},
        {.name = "card.scans_left",
         .domain = numbers(0, 1e9),
         .value =
             [](const Device& d) { return numberFact(std::floor(freeBytes(d) / std::max(1.0, d.expectedBytes()))); },
         .about = "number of scans with these settings that still fit"},
        {.name = "cover",
         .domain = {{"open", "closed"}},
         .value = [](const Device& d) { return wordFact(around(d).cover_open ? "open" : "closed"); },
         .about = "cover of the battery and memory compartment"},
        {.name = "temperature",
         .unit = Unit::celsius,
         .domain = numbers(-60, 90),
         .value = [](const Device& d) { return numberFact(around(d).temperature_c); },
         .about = "of the instrument"},
        {.name = "temperature.state",
         .domain = {{"good", "cold", "hot"}},
         .value = [](const Device& d) { return wordFact(temperatureState(d)); },
         .about = "rated by the device's limits"},
        {.name = "warm",
         .domain = yesOrNo(),
         .value = [](const Device& d) { return wordFact(warmState(d)); },
         .about = "the instrument has reached its operating temperature"},
        {.name = "tilt",
         .unit = Unit::degrees,
         .domain = numbers(0, 90),
         .value = [](const Device& d) { return numberFact(d.tilt()); },
         .about = "tilt of the vertical axis"},
        {.name = "tilt.x",
         .unit = Unit::degrees,
         .domain = numbers(-90, 90),
         .value = [](const Device& d) { return numberFact(around(d).tilt_x_deg); },
         .about = ""},
        {.name = "tilt.y",
         .unit = Unit::degrees,
         .domain = numbers(-90, 90),
         .value = [](const Device& d) { return numberFact(around(d).tilt_y_deg); },
         .about = ""},
        {.name = "level",
         .domain = {{"good", "reduced", "out"}},
         .value = [](const Device& d) { return wordFact(levelState(d)); },
         .about = "rated by the compensator's limits"},
        {.name = "levelled",
         .domain = yesOrNo(),
         .value = [](const Device& d) { return yesNo(d.levelled()); },
         .about = "the compensator is on and within its range"},
        {.name = "has_compensator",
         .domain = yesOrNo(),
         .value = [](const Device& d) { return yesNo(d.type().instrument.compensator.has_value()); },
         .about = "according to its data sheet"},
        {.name = "compensator.range",
         .unit = Unit::degrees,
         .domain = numbers(0, 360),
         .value = [](const Device& d) { return numberFact(d.levelledRange()); },
         .about = "range of the scanner's compensator"},
        {.name = "scanner",
         .value = [](const Device& d) { return wordFact(d.type().instrument.maker + " " + d.type().instrument.model); },
         .about = "manufacturer and model"},
        {.name = "dust",
         .domain = yesOrNo(),
         .value = [](const Device& d) { return yesNo(around(d).dust); },
         .about = "dust on the optics"},
        {.name = "station",
         .value = [](const Device& d) { return wordFact(around(d).station); },
         .about = "station of the tripod"},
        {.name = "standing",
         .domain = yesOrNo(),
         .value = [](const Device& d) { return yesNo(!around(d).station.empty()); },
         .about = "whether the tripod is at a station"},
        {.name = "nearest",
         .unit = Unit::metres,
         .domain = numbers(0, 1e6),
         .value = [](const Device& d) { return numberFact(around(d).nearest_m); },
         .about = "distance to the nearest surface in metres"},
        {.name = "nearest.least",
         .unit = Unit::metres,
         .domain = numbers(0, 1e6),
         .value = [](const Device& d) { return numberFact(d.type().instrument.min_range_m); },
         .about = "minimum range from the data sheet"},
        {.name = "operator.in_view",
         .domain = yesOrNo(),
         .value = [](const Device& d) { return yesNo(around(d).operator_in_view); },
         .about = "the operator is in the scanner's view"},
        {.name = "tracking",
         .domain = yesOrNo(),
         .value = [](const Device& d) { return yesNo(around(d).tracking); },
         .about = "the path between setups is tracked"},
        {.name = "wlan",
         .domain = yesOrNo(),
         .value = [](const Device& d) { return yesNo(around(d).wlan); },
         .about = "whether the wireless link works"},
        {.name = "tripod_moved",
         .domain = yesOrNo(),
         .value = [](const Device& d) { return yesNo(d.state().moved); },
         .about = "the tripod was moved during this scan"},
        {.name = "project",
         .value = [](const Device& d) { return wordFact(d.project() == nullptr ? "" : d.project()->name); },
         .about = "name of the open project or job"},
        {.name = "project.open",
         .domain = yesOrNo(),
         .value = [](const Device& d) { return yesNo(d.project() != nullptr); },
         .about = "whether a project is open"},
        {.name = "project.base",
         .value = [](const Device& d) { return wordFact(d.project() == nullptr ? "" : d.project()->base); },
         .about = "base of the scans' names"},
        {.name = "project.cluster",
         .value = [](const Device& d) { return wordFact(d.project() == nullptr ? "" : d.project()->cluster); },
         .about = "folder of the next scans"},
        {.name = "project.first",
         .domain = numbers(0, 1e6),
         .value = [](const Device& d) { return numberFact(d.project() == nullptr ? 0 : d.project()->first); },
         .about = "number of its first setup"},
        {.name = "projects",
         .domain = numbers(0, 1e6),
         .value = [](const Device& d) { return numberFact(static_cast<double>(d.state().projects.size())); },
         .about = "on the device"},
        {.name = "setups",
         .domain = numbers(0, 1e6),
         .value = [](const Device& d) { return numberFact(setups(d)); },
         .about = "stored in the open project"},
        {.name = "setups.all",
         .domain = numbers(0, 1e6),
         .value = [](const Device& d) { return numberFact(countAll(d, [](const StoredSetup&) { return true; })); },
         .about = "on the device"},
        {.name = "setups.transferred",
         .domain = numbers(0, 1e6),
         .value =
             [](const Device& d) {
               return numberFact(countAll(d, [](const StoredSetup& s) { return s.transferred; }));
             },
         .about = "with a copy in the office"},
        {.name = "setups.untransferred",
         .domain = numbers(0, 1e6),
         .value =
             [](const Device& d) {
               return numberFact(countAll(d, [](const StoredSetup& s) { return !s.transferred; }));
             },
         .about = "setups that are only on the card"},
        {.name = "setups.looked_at",
         .domain = numbers(0, 1e6),
         .value =
             [](const Device& d) { return numberFact(countAll(d, [](const StoredSetup& s) { return s.looked_at; })); },
         .about = "setups whose preview was opened"},
        {.name = "setups.tripod_moved",
         .domain = numbers(0, 1e6),
         .value = [](const Device& d) { return numberFact(countAll(d, [](const StoredSetup& s) { return s.moved; })); },
         .about = "setups affected by tripod movement"},
        {.name = "setup.next",
         .domain = numbers(0, 1e6),
         .value = [](const Device& d) { return numberFact(nextNumber(d)); },
         .about = "number of the next setup"},
        {.name = "link",
         .domain = {{"none", "joined", "failed"}},
         .value = [](const Device& d) { return wordFact(linkState(d.newestSetup())); },
         .about = "link of the newest setup to the previous one"},
        {.name = "link.overlap",
         .unit = Unit::fraction,
         .domain = numbers(0, 1),
         .value =
             [](const Device& d) {
               return numberFact(d.newestSetup() != nullptr && d.newestSetup()->link ? d.newestSetup()->link->overlap
                                                                                     : 0);
             },
         .about = "overlap as a fraction of the newer cloud"},
        {.name = "link.error",
         .unit = Unit::millimetres,
         .domain = numbers(0, 1e6),
         .value =
             [](const Device& d) {
               return numberFact(
                   d.newestSetup() != nullptr && d.newestSetup()->link ? d.newestSetup()->link->error_m * 1000 : 0);
             },
         .about = "RMS in millimetres"},
        {.name = "linked",
         .domain = {{"none", "joined", "failed"}},
         .value = [](const Device& d) { return wordFact(linkState(setupOfFile(d, d.state().linking))); },
         .about = "outcome of the link that was attempted last"},
        {.name = "linked.to",
         .value =
             [](const Device& d) {
               const auto* to = setupOfFile(d, d.state().linking_to);
               return wordFact(to == nullptr ? "" : to->name);
             },
         .about = "setup that this link is to"},
        {.name = "linked.overlap",
         .unit = Unit::fraction,
         .domain = numbers(0, 1),
         .value = [](const Device& d) { return numberFact(lastLink(d).overlap); },
         .about = "overlap of this link as a fraction of the newer cloud"},
        {.name = "linked.error",
         .unit = Unit::millimetres,
         .domain = numbers(0, 1e6),
         .value = [](const Device& d) { return numberFact(lastLink(d).error_m * 1000); },
         .about = "RMS of this link in millimetres"},
        {.name = "shown.name",
         .value = [](const Device& d) { return wordFact(d.shownSetup() == nullptr ? "" : d.shownSetup()->name); },
         .about = "of the displayed setup"},
        {.name = "shown.station",
         .value = [](const Device& d) { return wordFact(d.shownSetup() == nullptr ? "" : d.shownSetup()->station); },
         .about = ""},
        {.name = "shown.points",
         .unit = Unit::points,
         .domain = numbers(0, 1e12),
         .value =
             [](const Device& d) {
               return numberFact(d.shownSetup() == nullptr ? 0 : static_cast<double>(d.shownSetup()->points));
             },
         .about = ""},
        {.name = "shown.bytes",
         .unit = Unit::bytes,
         .domain = numbers(0, 1e16),
         .value = [](const Device& d) { return numberFact(d.shownSetup() == nullptr ? 0 : d.shownSetup()->bytes); },
         .about = ""},
        {.name = "shown.seconds",
         .unit = Unit::seconds,
         .domain = numbers(0, 1e9),
         .value =
             [](const Device& d) {
               return numberFact(d.shownSetup() == nullptr ? 0 : d.shownSetup()->instrument_seconds);
             },
         .about = ""},
        {.name = "shown.targets",
         .domain = numbers(0, 1e4),
         .value = [](const Device& d) { return numberFact(foundTargets(d.shownSetup())); },
         .about = "targets found in the displayed setup"},
        {.name = "shown.transferred",
         .domain = yesOrNo(),
         .value = [](const Device& d) { return yesNo(d.shownSetup() != nullptr && d.shownSetup()->transferred); },
         .about = ""},
        {.name = "measured",
         .unit = Unit::metres,
         .domain = numbers(0, 1e6),
         .value = [](const Device& d) { return measured(d, "measured"); },
         .about = "distance between the two points picked in the preview, in metres"},
        {.name = "measured.horizontal",
         .unit = Unit::metres,
         .domain = numbers(0, 1e6),
         .value = [](const Device& d) { return measured(d, "measured_horizontal"); },
         .about = "horizontal distance between them"},
        {.name = "measured.vertical",
         .unit = Unit::metres,
         .domain = numbers(-1e6, 1e6),
         .value = [](const Device& d) { return measured(d, "measured_vertical"); },
         .about = "height difference of the second point"},
        {.name = "expected.seconds",
         .unit = Unit::seconds,
         .domain = numbers(0, 1e6),
         .value = [](const Device& d) { return numberFact(d.expected().scan_seconds + d.expected().imaging_seconds); },
         .about = "next scan including images"},
        {.name = "expected.scan",
         .unit = Unit::seconds,
         .domain = numbers(0, 1e6),
         .value = [](const Device& d) { return numberFact(d.expected().scan_seconds); },
         .about = "laser only"},
        {.name = "expected.pass",
         .unit = Unit::seconds,
         .domain = numbers(0, 1e6),
         .value = [](const Device& d) { return numberFact(d.expected().scan_seconds / d.expected().passes); },
         .about = "one laser pass"},
        {.name = "expected.overhead",
         .unit = Unit::seconds,
         .domain = numbers(0, 1e6),
         .value = [](const Device& d) { return numberFact(d.type().instrument.overhead_s); },
         .about = "time before and after the sweep"},
        {.name = "expected.sweep",
         .unit = Unit::seconds,
         .domain = numbers(0, 1e6),
         .value =
             [](const Device& d) {
               return numberFact(std::max(0.0, d.expected().scan_seconds - d.type().instrument.overhead_s));
             },
         .about = "rotation of the head"},
        {.name = "expected.imaging",
         .unit = Unit::seconds,
         .domain = numbers(0, 1e6),
         .value = [](const Device& d) { return numberFact(d.expected().imaging_seconds); },
         .about = "imaging"},
        {.name = "expected.points",
         .unit = Unit::points,
         .domain = numbers(0, 1e12),
         .value = [](const Device& d) { return numberFact(points(d)); },
         .about = "none for image-only settings"},
        {.name = "expected.columns",
         .domain = numbers(0, 1e9),
         .value = [](const Device& d) { return numberFact(d.expected().columns); },
         .about = ""},
        {.name = "expected.rows",
         .domain = numbers(0, 1e9),
         .value = [](const Device& d) { return numberFact(d.expected().rows); },
         .about = ""},
        {.name = "expected.bytes",
         .unit = Unit::bytes,
         .domain = numbers(0, 1e16),
         .value = [](const Device& d) { return numberFact(d.expectedBytes()); },
         .about = ""},
        {.name = "expected.spacing",
         .unit = Unit::millimetres,
         .domain = numbers(0, 1e6),
         .value = [](const Device& d) { return numberFact(spacing(d)); },
         .about = "column spacing at 10 m in millimetres"},
        {.name = "expected.noise",
         .domain = numbers(0, 1000),
         .value = [](const Device& d) { return numberFact(d.expected().noise_factor); },
         .about = "factor on the data sheet's range noise"},
        {.name = "expected.range",
         .unit = Unit::metres,
         .domain = numbers(0, 1e5),
         .value = [](const Device& d) { return numberFact(d.expected().max_range_m); },
         .about = "maximum range with these settings"},
        {.name = "passes",
         .domain = numbers(1, 2),
         .value = [](const Device& d) { return numberFact(d.expected().passes); },
         .about = "laser passes: two for a double scan"},
        {.name = "imaging",
         .domain = yesOrNo(),
         .value = [](const Device& d) { return yesNo(d.expected().imaging); },
         .about = "whether images are taken"},
        {.name = "progress",
         .unit = Unit::fraction,
         .domain = numbers(0, 1),
         .value = [](const Device& d) { return numberFact(progress(d)); },
         .about = "of the running scan"},
        {.name = "remaining",
         .unit = Unit::seconds,
         .domain = numbers(0, 1e6),
         .value = [](const Device& d) { return numberFact(remaining(d)); },
         .about = "of the running scan"},
        {.name = "data",
         .domain = yesOrNo(),
         .value = [](const Device& d) { return yesNo(d.state().data.has_value()); },
         .about = "the simulation of the running scan has finished"},
    };
    const auto newest = newestFacts();
    all.insert(all.end(), newest.begin(), newest.end());
    all.insert(all.end(), walkFacts().begin(), walkFacts().end());
    return all;
  }();
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
  return setupFact(*this, name);
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
  return setupFactDomain(*this, name);
}

std::string Device::shown(const std::string& name) const {
  const auto found = fact(name);
  if (!found) return {};
  // What stands in a word's braces is not filled in once more: words that name each other would never end.
  const auto plain = [&](const std::string& key) {
    return type_->words->text(type_->definition.id, key, state_.language);
  };
  FactUnit unit = setupFactUnit(name);
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
