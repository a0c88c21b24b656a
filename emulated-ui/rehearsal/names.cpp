// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/names.h"

#include <fmt/format.h>

#include "core/nearest_name.h"
#include "emulated-ui/menus.h"
#include "emulated-ui/rehearsal/events.h"
#include "emulated-ui/rehearsal/proofs.h"

namespace standpoint {

namespace {

constexpr double kLongestStart_s = 3600;

// Switched on as a student would, with the tripod at a station, until nothing goes on by itself.
NamedStart startOf(const DeviceType& type, std::shared_ptr<const DeviceType> shared) {
  Device device(std::move(shared));
  const auto& key = type.definition.keys.front().id;
  device.change().around.station = "S1";
  (void)device.act(key);
  while (device.busy() && device.state().clock_s < kLongestStart_s) device.tick(1);
  return {key, device.state().clock_s, device.state().screen};
}

NamedDomain domainOf(const std::vector<std::string>& choices, double minimum, double maximum) {
  NamedDomain domain{.choices = choices};
  if (choices.empty()) domain.minimum = minimum, domain.maximum = maximum;
  return domain;
}

NamedDomain anyText() { return {.text = true}; }

NamedDomains settingsOf(const Instrument& instrument) {
  NamedDomains rows;
  for (const auto& s : instrument.settings) {
    std::vector<std::string> choices;
    for (const auto& choice : s.choices) choices.push_back(choice.value);
    auto& row = rows[s.key] = domainOf(choices, s.minimum, s.maximum);
    row.default_value = s.default_value;
  }
  return rows;
}

NamedDomain domainOf(const FactDomain& domain) {
  if (domain.is_number) return domainOf({}, domain.minimum, domain.maximum);
  return domain.words.empty() ? anyText() : domainOf(domain.words, 0, 0);
}

std::string spread(const NamedDomain& domain) {
  if (!domain.choices.empty()) return fmt::format("{}", fmt::join(domain.choices, ", "));
  if (domain.minimum) return fmt::format("{:g} to {:g}", *domain.minimum, *domain.maximum);
  return "a text";
}

NamedDomains factsOf(const Device& device) {
  NamedDomains facts;
  const auto take = [&](const char* name, const FactDomain& domain, const std::string& about) {
    auto& fact = facts[name] = domainOf(domain);
    fact.about = about;
  };
  for (const auto* rows : {&device.type().program.facts, &sharedFacts()})
    for (const auto& row : *rows) take(row.name, row.domain, row.about);
  for (const auto& row : proofRows())
    take(row.name, row.domain, *row.unit == '\0' ? row.about : fmt::format("{}, {}", row.unit, row.about));
  return facts;
}

template <class Rows>
std::vector<std::string> idsIn(const Rows& rows) {
  std::vector<std::string> ids;
  for (const auto& row : rows) ids.emplace_back(row.id);
  return ids;
}

}  // namespace

const AnswerFields<NamedStart>& answerFields(const NamedStart*) {
  using A = NamedStart;
  static const AnswerFields<A> fields = {{"key", &A::key}, {"seconds", &A::seconds}, {"screen", &A::screen}};
  return fields;
}

const AnswerFields<NamedDevice>& answerFields(const NamedDevice*) {
  using A = NamedDevice;
  static const AnswerFields<A> fields = {
      {"id", &A::id}, {"title", &A::title}, {"start", &A::start}, {"instruments", &A::instruments}};
  return fields;
}

const AnswerFields<NamedDevices>& answerFields(const NamedDevices*) {
  static const AnswerFields<NamedDevices> fields = {{"devices", &NamedDevices::devices}};
  return fields;
}

const AnswerFields<NamedDomain>& answerFields(const NamedDomain*) {
  using A = NamedDomain;
  static const AnswerFields<A> fields = {{"choices", &A::choices, kLeftOut},        {"minimum", &A::minimum, kLeftOut},
                                         {"maximum", &A::maximum, kLeftOut},        {"text", &A::text, kLeftOut},
                                         {"standard", &A::default_value, kLeftOut}, {"about", &A::about, kLeftOut}};
  return fields;
}

const AnswerFields<DeviceNames>& answerFields(const DeviceNames*) {
  using A = DeviceNames;
  static const AnswerFields<A> fields = {
      {"device", &A::device}, {"title", &A::title}, {"start", &A::start},     {"settings", &A::settings},
      {"values", &A::values}, {"keys", &A::keys},   {"screens", &A::screens}, {"dialogs", &A::dialogs},
      {"phases", &A::phases}, {"facts", &A::facts}, {"hands", &A::hands},     {"troubles", &A::troubles},
      {"events", &A::events}};
  return fields;
}

Result<NamedDevices> namedDevices() {
  NamedDevices all;
  for (const auto& device : emulatedDevices()) {
    TRY_ASSIGN(const auto type, loadDevice(device));
    all.devices.push_back({device.id, device.title(), startOf(*type, type), type->definition.instruments});
  }
  return all;
}

Result<DeviceNames> namesOf(const std::string& id) {
  const auto* found = findDevice(id);
  if (found == nullptr)
    return failure(ErrorKind::usage,
                   fmt::format("unknown device '{}'; {}", id, knownInstead(id, idsIn(emulatedDevices()))), "--device");
  TRY_ASSIGN(const auto type, loadDevice(*found));
  const auto& d = type->definition;
  DeviceNames names{.device = id, .title = found->title(), .start = startOf(*type, type)};
  for (const auto& instrument : d.instruments) {
    TRY_ASSIGN(const auto driven, loadDevice(*found, instrument == "*" ? std::string() : instrument));
    names.settings[driven->instrument.id] = settingsOf(driven->instrument);
  }
  for (const auto& v : d.values) {
    auto& value = names.values[v.id] =
        v.kind == WidgetKind::text ? anyText() : domainOf(v.choices, v.minimum, v.maximum);
    value.default_value = v.default_value;
  }
  names.keys = idsIn(d.keys);
  for (const auto& screen : d.screens) names.screens[screen.id] = idsIn(screen.widgets);
  for (const auto& dialog : d.dialogs) names.dialogs[dialog.id] = idsIn(dialog.buttons);
  names.phases = idsIn(d.phases);
  names.facts = factsOf(Device(type));
  for (const auto& hand : handRows()) names.hands[hand.id] = hand.value;
  names.troubles = idsIn(troubleRows());
  for (const auto& event : eventRows())
    if (event.logged) names.events[event.name] = event.about;
  return names;
}

std::string textOf(const NamedDevices& all) {
  std::string text;
  for (const auto& d : all.devices)
    text += fmt::format("{:15} {:3.0f} s after '{}': shows '{}'  ({})\n", d.id, d.start.seconds, d.start.key,
                        d.start.screen, fmt::join(d.instruments, ", "));
  return text + "use standpoint rehearse --names --device ID to list all names of a device\n";
}

std::string textOf(const DeviceNames& n) {
  std::string text =
      fmt::format("{}: {:.0f} s after '{}': shows '{}'\n", n.title, n.start.seconds, n.start.key, n.start.screen);
  const auto withDefaults = [&text](const NamedDomains& rows) {
    for (const auto& [id, row] : rows)
      text += fmt::format("  {:20} {}  *{}\n", id, spread(row), row.default_value.value_or(""));
  };
  const auto lists = [&text](const NamedLists& rows) {
    for (const auto& [id, ids] : rows) text += fmt::format("  {:20} {}\n", id, fmt::join(ids, ", "));
  };
  for (const auto& [instrument, rows] : n.settings) {
    text += fmt::format("\nsetting.KEY of {} (* is the default value)\n", instrument);
    withDefaults(rows);
  }
  text += "\nvalue.ID\n";
  withDefaults(n.values);
  text += fmt::format("\nkeys: {}\n\nscreens and their controls\n", fmt::join(n.keys, ", "));
  lists(n.screens);
  text += "\ndialogs and their buttons\n";
  lists(n.dialogs);
  text += fmt::format(
      "\nphases: {}\n\nfacts, beside phase, screen, dialog, setting.KEY, value.ID, time, hints, answer.QUESTION, "
      "count.EVENT\n",
      fmt::join(n.phases, ", "));
  for (const auto& [name, row] : n.facts)
    text += fmt::format("  {:22} {:20} {}\n", name, spread(row), row.about.value_or(""));
  text += "\nhands\n";
  for (const auto& [id, value] : n.hands) text += fmt::format("  {:20} {}\n", id, value);
  text += fmt::format("\ntroubles: {}\n\nevents\n", fmt::join(n.troubles, ", "));
  for (const auto& [name, about] : n.events) text += fmt::format("  {:20} {}\n", name, about);
  return text;
}

}  // namespace standpoint
