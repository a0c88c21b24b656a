// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/default_transitions.h"

#include <algorithm>
#include <sstream>

#include "emulated-ui/device/effects.h"

namespace standpoint {

namespace {

using Event = EngineEvent;

// A transition of which a part may be absent.
struct SharedRow {
  Phases from;
  EventId event;
  std::optional<std::string> guard = "";
  std::optional<PhaseId> to = PhaseId{};
  std::optional<std::string> show = "";
  std::string ask = {};
  DeviceEffect effect = nullptr;
};
using SharedRows = std::vector<SharedRow>;

constexpr const char* kCanRun = "battery.state != critical or mains == yes";
constexpr const char* kCannotRun = "battery.state == critical and mains == no";

const PhaseId kBooting{"booting"}, kShuttingDown{"shutting_down"}, kError{"error"}, kAdjusting{"adjusting"};

std::optional<std::string> absent(const DeviceRoles& r) {
  return r.card_needed ? std::optional<std::string>("card == absent") : std::nullopt;
}

SharedRows power(const DeviceRoles& r) {
  if (!r.off) return {};
  return {
      {.from = {*r.off}, .event = "power_key", .guard = kCanRun, .to = kBooting},
      {.from = {kBooting}, .event = Event::elapsed, .to = r.ready},
      {.from = r.rest, .event = "power_key", .ask = "shut_down"},
      {.from = r.rest, .event = "shut_down", .to = kShuttingDown},
      {.from = {*r.off}, .event = "power_held", .guard = kCanRun, .to = kBooting},
      {.from = r.rest, .event = "power_held", .to = kShuttingDown},
      {.from = {kShuttingDown}, .event = Event::elapsed, .to = r.off},
      {.from = {kAnyPhase}, .event = Event::battery_critical, .ask = "battery_critical"},
      {.from = {kAnyPhase}, .event = Event::battery_empty, .to = r.off, .effect = dropScan},
  };
}

SharedRows refusals(const DeviceRoles& r) {
  return {
      {.from = r.idle, .event = r.start, .guard = "project.open == no", .ask = "no_project"},
      {.from = r.idle, .event = r.start, .guard = "standing == no", .ask = "no_station"},
      {.from = r.idle, .event = r.start, .guard = absent(r), .ask = "card_absent"},
      {.from = r.idle, .event = r.start, .guard = "card == locked", .ask = "card_locked"},
      {.from = r.idle, .event = r.start, .guard = "card.free < @expected.bytes", .ask = "card_full"},
      {.from = r.idle, .event = r.start, .guard = kCannotRun, .ask = "battery_critical"},
  };
}

SharedRows questions(const DeviceRoles& r) {
  return {
      {.from = r.idle, .event = r.start, .guard = "temperature.state != good", .ask = "temperature_question"},
      {.from = r.idle, .event = r.start, .guard = "warm == no", .ask = "not_warm_question"},
      {.from = r.idle, .event = r.start, .guard = r.tilted, .ask = "tilt_question"},
      {.from = r.idle, .event = r.start, .guard = r.near, .ask = "near_question"},
  };
}

SharedRows beginning(const DeviceRoles& r) {
  return {
      {.from = r.idle, .event = r.start, .to = r.first, .effect = r.begin},
      {.from = r.idle, .event = r.start_anyway, .to = r.first, .effect = r.begin},
  };
}

SharedRows troubles(const DeviceRoles& r) {
  return {
      {.from = r.working, .event = "stop", .ask = "stop_question"},
      {.from = r.holding, .event = "stop_confirmed", .to = r.ready, .show = r.home, .effect = dropScan},
      {.from = r.working, .event = Event::tripod_moved, .to = kError, .ask = "tripod_moved", .effect = markMoved},
      {.from = r.camera, .event = Event::set_down, .to = kError, .ask = "tripod_moved", .effect = markMoved},
      {.from = r.laser, .event = Event::blocked, .to = kError, .ask = "blocked"},
      {.from = {kError}, .event = "keep", .to = r.kept},
      {.from = r.holding,
       .event = Event::card_removed,
       .guard = r.card_needed,
       .to = r.ready,
       .show = r.home,
       .ask = "card_lost",
       .effect = dropScan},
      {.from = r.holding, .event = Event::failed, .to = r.ready, .show = r.home},
      {.from = r.measuring, .event = Event::tilted, .ask = "tilt_warning"},
      {.from = {kAnyPhase}, .event = Event::temperature, .ask = "temperature_warning"},
      {.from = {kAnyPhase}, .event = Event::battery_low, .ask = "battery_low"},
  };
}

SharedRows results(const DeviceRoles& r) {
  const auto linked = r.links ? r.idle : Phases{};
  return {
      {.from = linked, .event = Event::linked, .guard = "linked == joined", .ask = "link_joined"},
      {.from = linked, .event = Event::linked, .ask = "link_failed"},
      {.from = r.rest, .event = Event::targets_measured, .show = r.targets},
      {.from = r.rest, .event = Event::transferred, .ask = "transferred"},
  };
}

SharedRows card(const DeviceRoles& r) {
  return {
      {.from = r.idle, .event = "delete", .ask = "delete_question"},
      {.from = r.idle, .event = "delete_confirmed", .show = r.scans, .effect = deleteShownSetup},
      {.from = r.idle, .event = "format", .ask = "format_question"},
      {.from = r.idle, .event = "format_confirmed", .guard = "card == present", .show = r.home, .effect = formatCard},
      {.from = r.idle, .event = "format_confirmed", .guard = absent(r), .ask = "card_absent"},
      {.from = r.idle, .event = "format_confirmed", .ask = "card_locked"},
  };
}

SharedRows adjusting(const DeviceRoles& r) {
  if (!r.tools) return {};
  return {
      {.from = r.idle, .event = "adjust", .guard = "level == good and warm == yes", .to = kAdjusting},
      {.from = r.idle, .event = "adjust", .ask = "adjust_refused"},
      {.from = {kAdjusting}, .event = Event::elapsed, .to = r.ready, .show = r.tools, .ask = "adjusted"},
      {.from = {kAdjusting}, .event = Event::tripod_moved, .to = r.ready, .show = r.tools, .ask = "adjust_refused"},
  };
}

template <class T>
bool has(const std::vector<T>& all, const T& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

// In all of its phases.
bool isOverridden(const Transition& row, const std::vector<Transition>& own) {
  return std::all_of(row.from.begin(), row.from.end(), [&](const PhaseId& phase) {
    return std::any_of(own.begin(), own.end(), [&](const Transition& t) {
      return t.event == row.event && (t.guard.empty() || t.guard == row.guard) && has(t.from, phase);
    });
  });
}

void append(std::vector<Transition>& rows, const SharedRows& shared) {
  for (const auto& r : shared)
    if (!r.from.empty() && r.guard && r.to && r.show)
      rows.push_back({.from = r.from,
                      .event = r.event,
                      .guard = *r.guard,
                      .to = *r.to,
                      .show = *r.show,
                      .ask = r.ask,
                      .effect = r.effect});
}

}  // namespace

std::vector<std::string> rowsOf(const char* names) {
  std::istringstream in(names);
  std::vector<std::string> rows;
  for (std::string name; in >> name;) rows.push_back(name);
  return rows;
}

std::string rowName(const Transition& row) {
  return row.ask.empty() || row.ask == row.event.name ? row.event.name : row.event.name + "/" + row.ask;
}

std::vector<Transition> withDefaults(std::vector<Transition> own, const DeviceRoles& roles) {
  std::vector<Transition> shared;
  append(shared, power(roles));
  append(shared, refusals(roles));
  shared.insert(shared.end(), roles.first_questions.begin(), roles.first_questions.end());
  append(shared, questions(roles));
  shared.insert(shared.end(), roles.last_questions.begin(), roles.last_questions.end());
  for (const auto& part : {beginning, troubles, results, card, adjusting}) append(shared, part(roles));
  std::erase_if(shared, [&](const Transition& row) { return isOverridden(row, own); });
  for (auto& row : shared)
    for (const auto& mark : roles.marks)
      if (has(mark.rows, rowName(row))) row.source = mark.source;
  own.insert(own.end(), shared.begin(), shared.end());
  return own;
}

}  // namespace standpoint
