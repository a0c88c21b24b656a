// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/default_transitions.h"

#include <algorithm>
#include <sstream>
#include <string_view>

#include "emulated-ui/device/effects.h"

namespace standpoint {

namespace {

using Rows = std::vector<Transition>;

constexpr const char* kCanRun = "battery.state != critical or mains == yes";
constexpr const char* kCannotRun = "battery.state == critical and mains == no";

const char* absent(const DeviceRoles& r) { return r.card_needed == nullptr ? nullptr : "card == absent"; }

Rows power(const DeviceRoles& r) {
  if (r.off == nullptr) return {};
  return {
      {r.off, "power_key", kCanRun, "booting"},
      {"booting", "elapsed", "", r.ready},
      {r.rest, "power_key", "", "", "", "shut_down"},
      {r.rest, "shut_down", "", "shutting_down"},
      {"shutting_down", "elapsed", "", r.off},
      {"*", "battery_critical", "", "", "", "battery_critical"},
      {"*", "battery_empty", "", r.off, "", "", dropScan},
  };
}

Rows refusals(const DeviceRoles& r) {
  return {
      {r.idle, r.start, "project.open == no", "", "", "no_project"},
      {r.idle, r.start, "standing == no", "", "", "no_station"},
      {r.idle, r.start, absent(r), "", "", "card_absent"},
      {r.idle, r.start, "card == locked", "", "", "card_locked"},
      {r.idle, r.start, "card.free < @expected.bytes", "", "", "card_full"},
      {r.idle, r.start, kCannotRun, "", "", "battery_critical"},
  };
}

Rows questions(const DeviceRoles& r) {
  return {
      {r.idle, r.start, "temperature.state != good", "", "", "temperature_question"},
      {r.idle, r.start, "warm == no", "", "", "not_warm_question"},
      {r.idle, r.start, r.tilted, "", "", "tilt_question"},
      {r.idle, r.start, r.near, "", "", "near_question"},
  };
}

Rows beginning(const DeviceRoles& r) {
  return {
      {r.idle, r.start, "", r.first, "", "", r.begin},
      {r.idle, r.start_anyway, "", r.first, "", "", r.begin},
  };
}

Rows troubles(const DeviceRoles& r) {
  return {
      {r.working, "stop", "", "", "", "stop_question"},
      {r.holding, "stop_confirmed", "", r.ready, r.home, "", dropScan},
      {r.working, "tripod_moved", "", "error", "", "tripod_moved", markMoved},
      {r.camera, "set_down", "", "error", "", "tripod_moved", markMoved},
      {r.laser, "blocked", "", "error", "", "blocked"},
      {"error", "keep", "", r.kept},
      {r.holding, "card_removed", r.card_needed, r.ready, r.home, "card_lost", dropScan},
      {r.holding, "failed", "", r.ready, r.home},
      {r.measuring, "tilted", "", "", "", "tilt_warning"},
      {"*", "temperature", "", "", "", "temperature_warning"},
      {"*", "battery_low", "", "", "", "battery_low"},
  };
}

Rows results(const DeviceRoles& r) {
  const char* linked = r.links ? r.idle : nullptr;
  return {
      {linked, "linked", "link == joined", "", "", "link_joined"},
      {linked, "linked", "", "", "", "link_failed"},
      {r.rest, "targets_measured", "", "", r.targets},
      {r.rest, "transferred", "", "", "", "transferred"},
  };
}

Rows card(const DeviceRoles& r) {
  return {
      {r.idle, "delete", "", "", "", "delete_question"},
      {r.idle, "delete_confirmed", "", "", r.scans, "", deleteShownSetup},
      {r.idle, "format", "", "", "", "format_question"},
      {r.idle, "format_confirmed", "card == present", "", r.home, "", formatCard},
      {r.idle, "format_confirmed", absent(r), "", "", "card_absent"},
      {r.idle, "format_confirmed", "", "", "", "card_locked"},
  };
}

Rows adjusting(const DeviceRoles& r) {
  if (r.tools == nullptr) return {};
  return {
      {r.idle, "adjust", "level == good and warm == yes", "adjusting"},
      {r.idle, "adjust", "", "", "", "adjust_refused"},
      {"adjusting", "elapsed", "", r.ready, r.tools, "adjusted"},
      {"adjusting", "tripod_moved", "", r.ready, r.tools, "adjust_refused"},
  };
}

bool whole(const Transition& t) {
  const auto parts = {t.from, t.event, t.guard, t.to, t.show, t.ask};
  return std::none_of(parts.begin(), parts.end(), [](const char* part) { return part == nullptr; });
}

bool hasWord(const char* text, const std::string& word) {
  std::istringstream words(text);
  for (std::string w; words >> w;)
    if (w == word) return true;
  return false;
}

// In all of its phases.
bool isOverridden(const Transition& row, const Rows& own) {
  std::istringstream phases(row.from);
  for (std::string phase; phases >> phase;) {
    const bool taken = std::any_of(own.begin(), own.end(), [&](const Transition& t) {
      const std::string_view guard = t.guard;
      return std::string_view(t.event) == row.event && (guard.empty() || guard == row.guard) && hasWord(t.from, phase);
    });
    if (!taken) return false;
  }
  return true;
}

}  // namespace

std::string rowName(const Transition& row) {
  const std::string event = row.event, ask = row.ask;
  return ask.empty() || ask == event ? event : event + "/" + ask;
}

std::vector<Transition> withDefaults(std::vector<Transition> own, const DeviceRoles& roles) {
  Rows shared;
  for (const auto& rows : {power(roles), refusals(roles), roles.first_questions, questions(roles), roles.last_questions,
                           beginning(roles), troubles(roles), results(roles), card(roles), adjusting(roles)})
    shared.insert(shared.end(), rows.begin(), rows.end());
  std::erase_if(shared, [&](const Transition& row) { return !whole(row) || isOverridden(row, own); });
  for (auto& row : shared)
    for (const auto& mark : roles.marks)
      if (hasWord(mark.rows, rowName(row))) row.source = mark.source;
  own.insert(own.end(), shared.begin(), shared.end());
  return own;
}

}  // namespace standpoint
