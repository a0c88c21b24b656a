// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/events.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/nearest_name.h"
#include "emulated-ui/menus.h"

namespace standpoint {

namespace {

using Detail = EventDetail;

std::vector<std::string> eventNames(bool also_counted) {
  std::vector<std::string> names;
  for (const auto& row : eventRows())
    if (row.logged || also_counted) names.emplace_back(row.name);
  return names;
}

// "screen/widget"; a key of the body can be pressed on any screen, so it stands with each.
std::vector<std::string> presses(const Device& device) {
  const auto& d = device.type().definition;
  std::vector<std::string> all;
  for (const auto& key : d.keys) all.push_back("/" + key.id);  // of a dark display
  for (const auto& screen : d.screens) {
    for (const auto& key : d.keys) all.push_back(screen.id + "/" + key.id);
    for (const auto& w : screen.widgets) {
      if (w.setting != "*")
        all.push_back(screen.id + "/" + w.id);
      else
        for (const auto& s : device.type().instrument.settings) all.push_back(screen.id + "/setting." + s.key);
    }
  }
  return all;
}

std::vector<std::string> answers(const Device& device) {
  std::vector<std::string> all;
  for (const auto& dialog : device.type().definition.dialogs)
    for (const auto& button : dialog.buttons) all.push_back(dialog.id + "/" + button.id);
  return all;
}

std::optional<std::vector<std::string>> details(Detail detail, const Device& device) {
  const auto& d = device.type().definition;
  switch (detail) {
    case Detail::none: return std::vector<std::string>();
    case Detail::text: return std::nullopt;
    case Detail::screen: return idsOf(d.screens);
    case Detail::phase: return idsOf(d.phases);
    case Detail::dialog: return idsOf(d.dialogs);
    case Detail::answer: return answers(device);
    case Detail::press: return presses(device);
    case Detail::hand: return idsOf(handRows());
    case Detail::trouble: return idsOf(troubleRows());
    case Detail::field_verb: return std::vector<std::string>{"station", "target", "plan", "walk", "clean"};
  }
  return std::nullopt;
}

// Those of one device only are in its program.
std::vector<EventRow> sharedEvents() {
  return {
      {.name = "pressed", .detail = Detail::press, .about = "control or key: screen/widget"},
      {.name = "answered", .detail = Detail::answer, .about = "dialog: dialog/button"},
      {.name = "refused", .detail = Detail::text, .about = "rejected input: the control"},
      {.name = "setting", .detail = Detail::text, .about = "setting changed: its key"},
      {.name = "value", .detail = Detail::text, .about = "device value changed: its id"},
      {.name = "hand", .detail = Detail::hand, .about = "hand action"},
      {.name = "trouble", .detail = Detail::trouble, .about = "trouble occurred"},
      {.name = "phase", .detail = Detail::phase, .about = "phase entered"},
      {.name = "screen", .detail = Detail::screen, .about = "screen opened"},
      {.name = "dialog", .detail = Detail::dialog, .about = "dialog opened"},
      {.name = "event", .detail = Detail::text, .about = "of the device's state machine"},
      {.name = "woken", .about = "dark display touched"},
      {.name = "project_created", .detail = Detail::text, .about = "its name"},
      {.name = "project_opened", .detail = Detail::text, .about = "its name"},
      {.name = "project_renamed", .detail = Detail::text, .about = "its new name"},
      {.name = "project_deleted", .detail = Detail::text, .about = "its name"},
      {.name = "cluster", .detail = Detail::text, .about = "folder for the next scans selected: its name"},
      {.name = "scan_started", .detail = Detail::text, .about = "the setup's name"},
      {.name = "scan_stored", .detail = Detail::text, .about = "the setup's name"},
      {.name = "scan_dropped", .detail = Detail::text, .about = "the setup's name"},
      {.name = "failed", .detail = Detail::text, .about = "request failed: the reason"},
      {.name = "looked_at", .detail = Detail::text, .about = "preview opened: the setup's name"},
      {.name = "measured", .detail = Detail::text, .about = "distance measured in the preview"},
      {.name = "setup_deleted", .detail = Detail::text, .about = "its name"},
      {.name = "targets", .detail = Detail::text, .about = "targets searched: number found"},
      {.name = "picked", .detail = Detail::text, .about = "target fitted under the cross-hair: its name, or nothing"},
      {.name = "sighted", .detail = Detail::text, .about = "target measured: its name (P-series)"},
      {.name = "oriented", .detail = Detail::text, .about = "station set-up accepted: the method (P-series)"},
      {.name = "linked", .detail = Detail::text, .about = "link attempted: joined or refused"},
      {.name = "unlinked", .detail = Detail::text, .about = "link removed: the setup's name"},
      {.name = "laid", .detail = Detail::text, .about = "cloud laid by hand: x, y, turn"},
      {.name = "registration", .detail = Detail::text, .about = "link state (X7, VZ-i)"},
      {.name = "transferred", .detail = Detail::text, .about = "files copied to the office: number"},
      {.name = "card_formatted", .detail = Detail::text, .about = "number of setups lost without a copy"},
      {.name = "walk_started", .about = "recording of a walk began"},
      {.name = "walk_paused", .about = "recording paused"},
      {.name = "walk_ended", .about = "recording ended"},
      {.name = "walk_fixed", .detail = Detail::text, .about = "known point measured on a walk: its name"},
      {.name = "walk_dropped", .about = "recorded walk discarded without processing"},
      {.name = "field", .detail = Detail::field_verb, .about = "action in the environment", .logged = false},
      {.name = "targets_moved", .about = "targets that moved since an earlier scan", .logged = false},
  };
}

}  // namespace

const std::vector<EventRow>& eventRows() {
  static const auto all = [] {
    auto rows = sharedEvents();
    for (const auto& device : emulatedDevices())
      for (const auto& own : device.program().events)
        rows.push_back({.name = own.name, .detail = Detail::text, .about = own.about});
    return rows;
  }();
  return all;
}

std::optional<std::string> wrongCounter(const std::string& name, const Device& device) {
  const auto counter = name.substr(name.find('.') + 1);
  const auto dot = counter.find('.');
  const auto event = counter.substr(0, dot);
  const auto& rows = eventRows();
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const EventRow& r) { return event == r.name; });
  if (row == rows.end())
    return fmt::format("no countable event '{}'; {}", event, knownInstead(event, eventNames(true)));
  if (dot == std::string::npos) return std::nullopt;
  const auto detail = counter.substr(dot + 1);
  const auto known = details(row->detail, device);
  if (!known || std::find(known->begin(), known->end(), detail) != known->end()) return std::nullopt;
  return fmt::format("'{}' never occurs with '{}'; {}", event, detail, knownInstead(detail, *known, 12));
}

std::optional<std::string> wrongEvent(const std::string& name) {
  const auto known = eventNames(false);
  if (std::find(known.begin(), known.end(), name) != known.end()) return std::nullopt;
  return fmt::format("unknown event '{}'; {}", name, knownInstead(name, known));
}

}  // namespace standpoint
