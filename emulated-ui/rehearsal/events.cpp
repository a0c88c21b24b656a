// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/events.h"

#include <algorithm>

#include <fmt/format.h>

#include "emulated-ui/device/nearest.h"

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
    case Detail::field_verb: return std::vector<std::string>{"station", "target", "plan", "walk"};
  }
  return std::nullopt;
}

}  // namespace

const std::vector<EventRow>& eventRows() {
  static const std::vector<EventRow> rows = {
      {"pressed", Detail::press, "control or key: screen/widget"},
      {"answered", Detail::answer, "dialog: dialog/button"},
      {"refused", Detail::text, "rejected input: the control"},
      {"setting", Detail::text, "setting changed: its key"},
      {"value", Detail::text, "device value changed: its id"},
      {"hand", Detail::hand, "hand action"},
      {"trouble", Detail::trouble, "trouble occurred"},
      {"phase", Detail::phase, "phase entered"},
      {"screen", Detail::screen, "screen opened"},
      {"dialog", Detail::dialog, "dialog opened"},
      {"event", Detail::text, "of the device's state machine"},
      {"woken", Detail::none, "dark display touched"},
      {"project_created", Detail::text, "its name"},
      {"project_opened", Detail::text, "its name"},
      {"project_renamed", Detail::text, "its new name"},
      {"project_deleted", Detail::text, "its name"},
      {"cluster", Detail::text, "folder for the next scans selected: its name"},
      {"position_base", Detail::text, "base name of positions set (VZ-i)"},
      {"profile_saved", Detail::text, "its name (Focus)"},
      {"profile_deleted", Detail::text, "its name (Focus)"},
      {"scan_started", Detail::text, "the setup's name"},
      {"scan_stored", Detail::text, "the setup's name"},
      {"scan_dropped", Detail::text, "the setup's name"},
      {"unlevelled", Detail::text, "scan started without compensator: the setup's name (P-series)"},
      {"failed", Detail::text, "request failed: the reason"},
      {"error", Detail::text, "device stopped with an error (BLK360)"},
      {"looked_at", Detail::text, "preview opened: the setup's name"},
      {"measured", Detail::text, "distance measured in the preview"},
      {"setup_deleted", Detail::text, "its name"},
      {"targets", Detail::text, "targets searched: number found"},
      {"sighted", Detail::text, "target measured: its name (P-series)"},
      {"target_used", Detail::text, "target included in or excluded from the set-up: its id (P-series)"},
      {"station_solved", Detail::text, "the method (P-series)"},
      {"station_id", Detail::text, "entered name (P-series)"},
      {"oriented", Detail::text, "station set-up accepted: the method (P-series)"},
      {"import", Detail::text, "how unlevelled setups were imported (P-series)"},
      {"linked", Detail::text, "link attempted: joined or refused"},
      {"registration", Detail::text, "link state (X7, VZ-i)"},
      {"optimised", Detail::text, "links optimised: number of setups (BLK360)"},
      {"georeferenced", Detail::text, "number of control points found (VZ-i)"},
      {"control_point", Detail::text, "control point entered: its name (VZ-i)"},
      {"annotation", Detail::text, "its text (X7)"},
      {"pointed", Detail::text, "laser pointer aimed (X7)"},
      {"tagged", Detail::text, "its text (BLK360)"},
      {"button_stored", Detail::text, "device button configured (BLK360)"},
      {"standalone", Detail::text, "scan without the tablet (BLK360)"},
      {"transferred", Detail::text, "files copied to the office: number"},
      {"card_formatted", Detail::text, "number of setups lost without a copy"},
      {"field", Detail::field_verb, "action in the environment", false},
      {"targets_moved", Detail::none, "targets that moved since an earlier scan", false},
  };
  return rows;
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
