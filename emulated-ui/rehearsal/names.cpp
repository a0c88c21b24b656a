// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/names.h"

#include <fmt/format.h>

#include "core/nearest_name.h"
#include "emulated-ui/menus.h"
#include "emulated-ui/rehearsal/events.h"
#include "emulated-ui/rehearsal/proofs.h"

namespace standpoint {

namespace {

using nlohmann::json;

constexpr double kLongestStart_s = 3600;

// Switched on as a student would, with the tripod at a station, until nothing goes on by itself.
json startOf(const DeviceType& type, std::shared_ptr<const DeviceType> shared) {
  Device device(std::move(shared));
  const auto& key = type.definition.keys.front().id;
  device.change().around.station = "S1";
  (void)device.act(key);
  while (device.busy() && device.state().clock_s < kLongestStart_s) device.tick(1);
  return {{"key", key}, {"seconds", device.state().clock_s}, {"screen", device.state().screen}};
}

json choicesOf(const std::vector<std::string>& choices, double minimum, double maximum) {
  if (!choices.empty()) return {{"choices", choices}};
  return {{"minimum", minimum}, {"maximum", maximum}};
}

json settingsOf(const Instrument& instrument) {
  json rows = json::object();
  for (const auto& s : instrument.settings) {
    std::vector<std::string> choices;
    for (const auto& choice : s.choices) choices.push_back(choice.value);
    rows[s.key] = choicesOf(choices, s.minimum, s.maximum);
    rows[s.key]["standard"] = s.default_value;
  }
  return rows;
}

json domainOf(const FactDomain& domain) {
  if (domain.is_number) return {{"minimum", domain.minimum}, {"maximum", domain.maximum}};
  return domain.words.empty() ? json{{"text", true}} : json{{"choices", domain.words}};
}

std::string spread(const json& row) {
  if (row.contains("choices")) {
    std::vector<std::string> words;
    for (const auto& word : row["choices"]) words.push_back(word.get<std::string>());
    return fmt::format("{}", fmt::join(words, ", "));
  }
  if (row.contains("minimum"))
    return fmt::format("{:g} to {:g}", row["minimum"].get<double>(), row["maximum"].get<double>());
  return "a text";
}

std::string listed(const json& names) {
  std::vector<std::string> words;
  for (const auto& name : names) words.push_back(name.get<std::string>());
  return fmt::format("{}", fmt::join(words, ", "));
}

json factsOf(const Device& device) {
  json facts = json::object();
  const auto take = [&](const char* name, const FactDomain& domain, const std::string& about) {
    facts[name] = domainOf(domain);
    facts[name]["about"] = about;
  };
  for (const auto* rows : {&device.type().program.facts, &sharedFacts()})
    for (const auto& row : *rows) take(row.name, row.domain, row.about);
  for (const auto& row : proofRows())
    take(row.name, row.domain, *row.unit == '\0' ? row.about : fmt::format("{}, {}", row.unit, row.about));
  return facts;
}

}  // namespace

Result<json> deviceNames() {
  json rows = json::array();
  for (const auto& device : emulatedDevices()) {
    TRY_ASSIGN(const auto type, loadDevice(device));
    rows.push_back({{"id", device.id},
                    {"title", device.title()},
                    {"start", startOf(*type, type)},
                    {"instruments", type->definition.instruments}});
  }
  return rows;
}

Result<json> namesOf(const std::string& id) {
  const auto* found = findDevice(id);
  if (found == nullptr) {
    std::vector<std::string> ids;
    for (const auto& device : emulatedDevices()) ids.emplace_back(device.id);
    return failure(ErrorKind::usage, fmt::format("unknown device '{}'; {}", id, knownInstead(id, ids)), "--device");
  }
  TRY_ASSIGN(const auto type, loadDevice(*found));
  const Device device(type);
  const auto& d = type->definition;
  json settings = json::object();
  for (const auto& instrument : d.instruments) {
    TRY_ASSIGN(const auto driven, loadDevice(*found, instrument == "*" ? std::string() : instrument));
    settings[driven->instrument.id] = settingsOf(driven->instrument);
  }
  json values = json::object(), screens = json::object(), dialogs = json::object(), phases = json::array();
  for (const auto& v : d.values) {
    values[v.id] = v.kind == WidgetKind::text ? json{{"text", true}} : choicesOf(v.choices, v.minimum, v.maximum);
    values[v.id]["standard"] = v.default_value;
  }
  for (const auto& screen : d.screens) {
    screens[screen.id] = json::array();
    for (const auto& w : screen.widgets) screens[screen.id].push_back(w.id);
  }
  for (const auto& dialog : d.dialogs) {
    dialogs[dialog.id] = json::array();
    for (const auto& button : dialog.buttons) dialogs[dialog.id].push_back(button.id);
  }
  for (const auto& phase : d.phases) phases.push_back(phase.id);
  json keys = json::array(), hands = json::object(), troubles = json::array(), events = json::object();
  for (const auto& key : d.keys) keys.push_back(key.id);
  for (const auto& hand : handRows()) hands[hand.id] = hand.value;
  for (const auto& trouble : troubleRows()) troubles.push_back(trouble.id);
  for (const auto& event : eventRows())
    if (event.logged) events[event.name] = event.about;
  return json{{"device", id},
              {"title", found->title()},
              {"start", startOf(*type, type)},
              {"settings", settings},
              {"values", values},
              {"keys", keys},
              {"screens", screens},
              {"dialogs", dialogs},
              {"phases", phases},
              {"facts", factsOf(device)},
              {"hands", hands},
              {"troubles", troubles},
              {"events", events}};
}

std::string deviceNamesText(const json& devices) {
  std::string text;
  for (const auto& row : devices)
    text += fmt::format("{:15} {:3.0f} s after '{}': shows '{}'  ({})\n", row["id"].get<std::string>(),
                        row["start"]["seconds"].get<double>(), row["start"]["key"].get<std::string>(),
                        row["start"]["screen"].get<std::string>(), listed(row["instruments"]));
  return text + "use standpoint rehearse --names --device ID to list all names of a device\n";
}

std::string namesText(const json& n) {
  std::string text = fmt::format("{}: {:.0f} s after '{}': shows '{}'\n", n["title"].get<std::string>(),
                                 n["start"]["seconds"].get<double>(), n["start"]["key"].get<std::string>(),
                                 n["start"]["screen"].get<std::string>());
  for (const auto& [instrument, rows] : n["settings"].items()) {
    text += fmt::format("\nsetting.KEY of {} (* is the default value)\n", instrument);
    for (const auto& [key, row] : rows.items())
      text += fmt::format("  {:20} {}  *{}\n", key, spread(row), row["standard"].get<std::string>());
  }
  text += "\nvalue.ID\n";
  for (const auto& [id, row] : n["values"].items())
    text += fmt::format("  {:20} {}  *{}\n", id, spread(row), row["standard"].get<std::string>());
  text += fmt::format("\nkeys: {}\n\nscreens and their controls\n", listed(n["keys"]));
  for (const auto& [id, widgets] : n["screens"].items()) text += fmt::format("  {:20} {}\n", id, listed(widgets));
  text += "\ndialogs and their buttons\n";
  for (const auto& [id, buttons] : n["dialogs"].items()) text += fmt::format("  {:20} {}\n", id, listed(buttons));
  text += fmt::format(
      "\nphases: {}\n\nfacts, beside phase, screen, dialog, setting.KEY, value.ID, time, hints, answer.QUESTION, "
      "count.EVENT\n",
      listed(n["phases"]));
  for (const auto& [name, row] : n["facts"].items())
    text += fmt::format("  {:22} {:20} {}\n", name, spread(row), row["about"].get<std::string>());
  text += "\nhands\n";
  for (const auto& [id, value] : n["hands"].items()) text += fmt::format("  {:20} {}\n", id, value.get<std::string>());
  text += fmt::format("\ntroubles: {}\n\nevents\n", listed(n["troubles"]));
  for (const auto& [name, about] : n["events"].items())
    text += fmt::format("  {:20} {}\n", name, about.get<std::string>());
  return text;
}

}  // namespace standpoint
