// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/setup_facts.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "core/units.h"
#include "emulated-ui/device/device.h"
#include "emulated-ui/device/numbers.h"

namespace standpoint {

namespace {

using Unit = FactUnit;

FactDomain yesNoWords() { return {{"yes", "no"}}; }
FactDomain upTo(double most) { return {{}, true, 0, most}; }
Fact nothingYet() { return wordFact(""); }

double foundIn(const StoredSetup& s) {
  return static_cast<double>(
      std::count_if(s.targets.begin(), s.targets.end(), [](const FittedTarget& t) { return t.found; }));
}

Fact fewestOnTarget(const StoredSetup* s) {
  double least = -1;
  if (s != nullptr)
    for (const auto& t : s->targets)
      if (t.found) least = least < 0 ? t.points : std::min<double>(least, t.points);
  return numberFact(std::max(0.0, least));
}

Fact worstFit(const StoredSetup* s) {
  double worst = 0;
  if (s != nullptr)
    for (const auto& t : s->targets) worst = t.found ? std::max(worst, t.residual_m * 1000) : worst;
  return numberFact(worst);
}

Fact spacingOf(const Device& d, const StoredSetup* s) {
  if (s == nullptr) return nothingYet();
  const auto settings = resolveSettings(d.type().instrument, s->settings);
  if (!settings) return nothingYet();  // of a data sheet that has changed since
  return numberFact((settings->azimuth_to_rad - settings->azimuth_from_rad) / std::max(1U, settings->columns) * 10 *
                    1000);
}

Fact placeErrorOf(const StoredSetup* s, double PlaceError::*what, double factor) {
  return s == nullptr || !s->placed ? nothingYet() : numberFact((*s->placed).*what * factor);
}

constexpr std::string_view kNewest = "newest.", kSetup = "setup.", kSetting = "setting.";

// "newest.points" and "setup.2.points" by their parts.
struct AskedSetup {
  std::optional<std::size_t> number;  // from 1; nothing: the newest
  std::string what;
};
std::optional<AskedSetup> askedFor(const std::string& name) {
  if (name.starts_with(kNewest)) return AskedSetup{std::nullopt, name.substr(kNewest.size())};
  if (!name.starts_with(kSetup)) return std::nullopt;
  const auto dot = name.find('.', kSetup.size());
  if (dot == std::string::npos) return std::nullopt;
  const auto number = numberIn(std::string_view(name).substr(kSetup.size(), dot - kSetup.size()));
  if (!number || *number < 1 || *number > 1e6 || *number != static_cast<double>(static_cast<std::size_t>(*number)))
    return std::nullopt;
  return AskedSetup{static_cast<std::size_t>(*number), name.substr(dot + 1)};
}

const StoredSetup* storedAs(const Device& device, const AskedSetup& asked) {
  if (!asked.number) return device.newestSetup();
  std::size_t left = *asked.number;
  for (const auto& p : device.state().projects) {
    if (left <= p.setups.size()) return &p.setups[left - 1];
    left -= p.setups.size();
  }
  return nullptr;
}

const SetupFactRow* setupRowOf(const AskedSetup& asked) {
  for (const auto& row : setupFactRows())
    if (asked.what == row.name + kNewest.size()) return &row;
  return nullptr;
}

template <std::size_t Row>
Fact ofNewest(const Device& device) {
  return setupFactRows()[Row].value(device, device.newestSetup());
}

constexpr std::size_t kRows = 16;

template <std::size_t... Row>
std::vector<FactRow> newestOf(std::index_sequence<Row...>) {
  const auto& rows = setupFactRows();
  return {FactRow{rows[Row].name, rows[Row].unit, rows[Row].domain, ofNewest<Row>, rows[Row].about}...};
}

}  // namespace

const std::vector<SetupFactRow>& setupFactRows() {
  using D = Device;
  using S = StoredSetup;
  static const std::vector<SetupFactRow> rows = {
      {.name = "newest.name",
       .value = [](const D&, const S* s) { return wordFact(s == nullptr ? "" : s->name); },
       .about = "of the newest setup"},
      {.name = "newest.station",
       .value = [](const D&, const S* s) { return wordFact(s == nullptr ? "" : s->station); },
       .about = "station that it was scanned from"},
      {.name = "newest.partial",
       .domain = yesNoWords(),
       .value = [](const D&, const S* s) { return yesNo(s != nullptr && s->partial); },
       .about = "the setup is incomplete"},
      {.name = "newest.unlevelled",
       .domain = yesNoWords(),
       .value = [](const D&, const S* s) { return yesNo(s != nullptr && s->unlevelled); },
       .about = "stored without levelling"},
      {.name = "newest.tripod_moved",
       .domain = yesNoWords(),
       .value = [](const D&, const S* s) { return yesNo(s != nullptr && s->moved); },
       .about = "the tripod was moved during the setup"},
      {.name = "newest.looked_at",
       .domain = yesNoWords(),
       .value = [](const D&, const S* s) { return yesNo(s != nullptr && s->looked_at); },
       .about = "its preview was opened"},
      {.name = "newest.operator_in_view",
       .domain = yesNoWords(),
       .value = [](const D&, const S* s) { return yesNo(s != nullptr && s->operator_in_view); },
       .about = "the operator was in the scanner's view during the setup"},
      {.name = "newest.points",
       .unit = Unit::points,
       .domain = upTo(1e12),
       .value = [](const D&,
                   const S* s) { return s == nullptr ? nothingYet() : numberFact(static_cast<double>(s->points)); },
       .about = "points in its file"},
      {.name = "newest.seconds",
       .unit = Unit::seconds,
       .domain = upTo(1e6),
       .value = [](const D&, const S* s) { return s == nullptr ? nothingYet() : numberFact(s->instrument_seconds); },
       .about = "time that it took on the instrument"},
      {.name = "newest.spacing",
       .unit = Unit::millimetres,
       .domain = upTo(1e6),
       .value = spacingOf,
       .about = "column spacing at 10 m in millimetres that it was scanned with"},
      {.name = "newest.targets",
       .domain = upTo(1e4),
       .value = [](const D&, const S* s) { return numberFact(s == nullptr ? 0 : foundIn(*s)); },
       .about = "targets found in the newest setup"},
      {.name = "newest.sampled",
       .domain = upTo(1e9),
       .value = [](const D&, const S* s) { return fewestOnTarget(s); },
       .about = "lowest number of points on a target of the newest setup"},
      {.name = "newest.residual",
       .unit = Unit::millimetres,
       .domain = upTo(1e6),
       .value = [](const D&, const S* s) { return worstFit(s); },
       .about = "largest target residual in millimetres"},
      {.name = "newest.plan",
       .unit = Unit::millimetres,
       .domain = upTo(1e9),
       .value = [](const D&, const S* s) { return placeErrorOf(s, &PlaceError::plan_m, 1000); },
       .about = "horizontal error of the place in its file, by the station set-up at that time"},
      {.name = "newest.height",
       .unit = Unit::millimetres,
       .domain = upTo(1e9),
       .value = [](const D&, const S* s) { return placeErrorOf(s, &PlaceError::height_m, 1000); },
       .about = "height error of the place in its file, likewise"},
      {.name = "newest.azimuth",
       .unit = Unit::degrees,
       .domain = upTo(180),
       .value = [](const D&, const S* s) { return placeErrorOf(s, &PlaceError::turn_rad, 1 / kRadPerDeg); },
       .about = "error of the direction in its file, likewise"},
  };
  return rows;
}

std::vector<FactRow> newestFacts() { return newestOf(std::make_index_sequence<kRows>()); }

std::optional<Fact> setupFact(const Device& device, const std::string& name) {
  const auto asked = askedFor(name);
  if (!asked) return std::nullopt;
  const auto* setup = storedAs(device, *asked);
  if (setup == nullptr) return std::nullopt;
  if (asked->what.starts_with(kSetting)) {
    for (const auto& [key, value] : setup->settings)
      if (asked->what.substr(kSetting.size()) == key) return Fact{value, numberIn(value)};
    return std::nullopt;
  }
  const auto* row = setupRowOf(*asked);
  return row == nullptr ? std::nullopt : std::optional(row->value(device, setup));
}

std::optional<FactDomain> setupFactDomain(const Device& device, const std::string& name) {
  const auto asked = askedFor(name);
  if (!asked) return std::nullopt;
  if (asked->what.starts_with(kSetting)) return device.domain(asked->what);
  const auto* row = setupRowOf(*asked);
  return row == nullptr ? std::nullopt : std::optional(row->domain);
}

FactUnit setupFactUnit(const std::string& name) {
  const auto asked = askedFor(name);
  const auto* row = asked ? setupRowOf(*asked) : nullptr;
  return row == nullptr ? FactUnit::none : row->unit;
}

}  // namespace standpoint
