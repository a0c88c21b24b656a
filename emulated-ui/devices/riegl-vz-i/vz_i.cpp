// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "emulated-ui/device/default_transitions.h"
#include "emulated-ui/device/device.h"
#include "emulated-ui/device/effects.h"
#include "emulated-ui/device/settings.h"
#include "emulated-ui/devices/riegl-vz-i/positions.h"
#include "emulated-ui/devices/riegl-vz-i/registering.h"

// RIEGL VZ-i (VZ-400i): projects and numbered scan positions, patterns, storage media, reflector search, registration
// after each scan, control points, camera. Transitions: instrument facts, section 2.6.
namespace standpoint::riegl_vz_i {

namespace {

namespace phase {

const PhaseId unavailable{"unavailable"}, waiting{"waiting"}, scanning{"scanning"}, photographing{"photographing"},
    storing{"storing"}, searching{"searching"}, processing{"processing"}, error{"error"};

}  // namespace phase

using Event = EngineEvent;

const Phases kWorking = {phase::scanning, phase::photographing};
const Phases kHolding = {phase::scanning, phase::photographing, phase::storing, phase::error};
const Phases kAfter = {phase::searching, phase::processing};

// Lines are counted from the zenith: 30 to 130 degrees are elevations of 60 to -40.
Result<void> proposePattern(Device& device, const std::string&) {
  const auto angle = [&](const char* key) { return device.number(std::string("setting.") + key); };
  auto& entries = device.change().entries;
  entries["line_start"] = fmt::format("{:g}", 90 - angle("vertical_to"));
  entries["line_stop"] = fmt::format("{:g}", 90 - angle("vertical_from"));
  entries["line_step"] = device.setting("line_step");
  entries["frame_start"] = device.setting("horizontal_from");
  entries["frame_stop"] = device.setting("horizontal_to");
  entries["frame_step"] = device.setting("frame_step");
  return {};
}

Result<void> takePattern(Device& device, const std::string&) {
  const auto number = [&](const char* id) { return device.entryNumber(id); };
  const double line_start = number("line_start"), line_stop = number("line_stop"), frame_start = number("frame_start"),
               frame_stop = number("frame_stop");
  if (!(line_start >= 30 && line_stop <= 130 && line_start < line_stop && frame_start < frame_stop &&
        frame_stop <= 360))
    return failure(ErrorKind::usage, device.word("pattern_wrong"));
  auto wanted = withSetting(device.state().settings, "pattern", "custom");
  wanted = withSetting(wanted, "vertical_from", fmt::format("{:g}", 90 - line_stop));
  wanted = withSetting(wanted, "vertical_to", fmt::format("{:g}", 90 - line_start));
  wanted = withSetting(wanted, "horizontal_from", fmt::format("{:g}", frame_start));
  wanted = withSetting(wanted, "horizontal_to", fmt::format("{:g}", frame_stop));
  wanted = withSetting(wanted, "line_step", device.entry("line_step"));
  return device.setSettings(withSetting(wanted, "frame_step", device.entry("frame_step")));
}

// A pattern with a name has the whole field and its own steps.
Result<void> wholeField(Device& device, const std::string&) {
  if (device.setting("pattern") == "custom") return {};
  auto wanted = device.state().settings;
  for (const auto& setting : device.type().instrument.settings)
    if (setting.choices.empty()) wanted = withSetting(wanted, setting.key, setting.default_value);
  if (auto ok = device.setSettings(wanted); !ok) return ok;
  return proposePattern(device, {});
}

void prepare(const Device& device, ScanOrder& order) { order.name = nextPositionName(device); }

std::string opstate(const Device& device) {
  if (device.in({phase::waiting, phase::error})) return "waiting";
  if (device.in(kWorking)) return "scanning";
  return device.in({phase::storing, phase::searching, phase::processing}) ? "processing" : "unavailable";
}

const FactDomain kYesNo{{"yes", "no"}, false, 0, 0};
FactDomain upTo(double most) { return {{}, true, 0, most}; }

const std::vector<FactRow> kFacts = {
    {.name = "opstate",
     .domain = {{"unavailable", "waiting", "scanning", "processing"}, false, 0, 0},
     .value = [](const Device& d) { return wordFact(opstate(d)); },
     .about = "the four states of the manufacturer's interface [S31]"},
    {.name = "setup.next",
     .domain = upTo(1e6),
     .value = [](const Device& d) { return numberFact(nextPosition(d)); },
     .about = "number of the next scan position"},
    {.name = "position.name",
     .value = [](const Device& d) { return wordFact(nextPositionName(d)); },
     .about = "of the next scan"},
    {.name = "position.taken",
     .domain = kYesNo,
     .value = [](const Device& d) { return yesNo(positionTaken(d)); },
     .about = "the next number is already used"},
    {.name = "positions.double",
     .domain = upTo(1e6),
     .value = [](const Device& d) { return numberFact(doublePositions(d)); },
     .about = "scans with a duplicate number"},
    {.name = "card",
     .domain = {{"present", "absent", "locked"}, false, 0, 0},
     .value = [](const Device& d) { return wordFact(cardState(d)); },
     .about = "the chosen storage medium"},
    {.name = "card.free",
     .unit = FactUnit::bytes,
     .domain = upTo(1e16),
     .value = [](const Device& d) { return numberFact(cardFree(d)); },
     .about = "on the chosen storage medium"},
    {.name = "card.scans_left",
     .domain = upTo(1e9),
     .value = [](const Device& d) { return numberFact(std::floor(cardFree(d) / std::max(1.0, d.expectedBytes()))); },
     .about = "number of scans with these settings that still fit on it"},
    {.name = "registration.seconds",
     .unit = FactUnit::seconds,
     .domain = upTo(1e4),
     .value = [](const Device& d) { return numberFact(registrationSeconds(d)); },
     .about = "time the mode searches for a match"},
    {.name = "registration.result",
     .domain = {{"none", "ok", "fast_failed", "scan_failed"}, false, 0, 0},
     .value = [](const Device& d) { return wordFact(registrationResult(d)); },
     .about = "of the newest registration"},
    {.name = "reflector.reach",
     .unit = FactUnit::metres,
     .domain = upTo(1e6),
     .value = [](const Device& d) { return numberFact(reach(d)); },
     .about = "maximum distance with five points on the chosen reflector"},
    {.name = "searched",
     .domain = kYesNo,
     .value = [](const Device& d) { return yesNo(d.entry("searched") == "yes"); },
     .about = "the reflector search has finished"},
    {.name = "control_points",
     .domain = upTo(1e6),
     .value = [](const Device& d) { return numberFact(static_cast<double>(controlNames(d).size())); },
     .about = "number in the project's list"},
    {.name = "georeferenced",
     .domain = kYesNo,
     .value = [](const Device& d) { return yesNo(isGeoreferenced(d)); },
     .about = "whether the project is georeferenced"},
};

const DeviceRoles kRoles = {
    .off = phase::unavailable,
    .ready = phase::waiting,
    .rest = {phase::waiting},
    .idle = {phase::waiting},
    .working = kWorking,
    .measuring = kWorking,
    .camera = {phase::photographing},
    .holding = kHolding,
    .kept = phase::storing,
    .scans = "positions",
    .start = "scan",
    .start_anyway = "scan_anyway",
    .first_questions =
        {
            {.from = {phase::waiting},
             .event = "scan",
             .guard = "position.taken == yes",
             .ask = "position_question",
             .source = "S32"},
        },
    .tilted = "level == out",
    .card_needed = "value.storage != ssd",
    .marks = {{"S31", rowsOf("power_key scan/no_project scan")}, {"S35", rowsOf("transferred")}},
};

std::vector<Transition> transitions() {
  return withDefaults(
      {
          {.from = {phase::scanning},
           .event = Event::elapsed,
           .guard = "imaging == yes and setting.image_mode == after_scan",
           .to = phase::photographing,
           .source = "S31"},
          {.from = kWorking, .event = Event::elapsed, .to = phase::storing, .source = "S31"},
          {.from = {phase::storing},
           .event = Event::elapsed,
           .guard = "data == yes and value.reflector_search == on",
           .to = phase::searching,
           .effect = storeAndSearch,
           .source = "S31"},
          {.from = {phase::storing},
           .event = Event::elapsed,
           .guard = "data == yes and value.registration == on and setups > 0",
           .to = phase::processing,
           .effect = storeAndRegister,
           .source = "S31"},
          {.from = {phase::storing},
           .event = Event::elapsed,
           .guard = "data == yes",
           .to = phase::waiting,
           .show = "position_view",
           .effect = storePosition,
           .source = "S31"},
          {.from = {phase::searching}, .event = Event::targets_measured, .effect = filterReflectors, .source = "S31"},
          {.from = {phase::searching},
           .event = Event::elapsed,
           .guard = "searched == yes and value.registration == on and setups > 1",
           .to = phase::processing,
           .effect = beginRegistration,
           .source = "S31"},
          {.from = {phase::searching},
           .event = Event::elapsed,
           .guard = "searched == yes",
           .to = phase::waiting,
           .show = "reflectors",
           .source = "S31"},
          {.from = {phase::processing, phase::waiting, phase::unavailable},
           .event = Event::linked,
           .effect = judgeRegistration,
           .source = "S31"},
          {.from = {phase::processing},
           .event = Event::elapsed,
           .guard = "registration.result == ok",
           .to = phase::waiting,
           .show = "position_view",
           .source = "S31"},
          {.from = {phase::processing},
           .event = Event::elapsed,
           .guard = "registration.result == fast_failed",
           .to = phase::waiting,
           .show = "registration",
           .ask = "fast_reg_failed",
           .source = "S31"},
          {.from = {phase::processing},
           .event = Event::elapsed,
           .guard = "registration.result == scan_failed",
           .to = phase::waiting,
           .show = "registration",
           .ask = "scan_reg_failed",
           .source = "S31"},
          {.from = {phase::waiting},
           .event = "register",
           .to = phase::processing,
           .effect = beginRegistration,
           .source = "S31"},
          {.from = kAfter, .event = Event::failed, .to = phase::waiting, .show = "positions"},
          {.from = {phase::waiting},
           .event = Event::targets_measured,
           .show = "reflectors",
           .effect = filterReflectors,
           .source = "S31"},
          {.from = {phase::waiting}, .event = "delete_confirmed", .show = "positions", .effect = deletePosition},
          {.from = {phase::waiting},
           .event = "format_confirmed",
           .guard = "card == present",
           .show = "home",
           .effect = formatMedium},
      },
      kRoles);
}

}  // namespace

const DeviceProgram& program() {
  static const DeviceProgram all = {
      .transitions = transitions(),
      .actions = {{"load_or_create", loadOrCreate},
                  {"open_position_project", openPositionProject},
                  {"propose_position", proposePosition},
                  {"set_base", setBase},
                  {"number_from_here", numberFromHere},
                  {"propose_pattern", proposePattern},
                  {"take_pattern", takePattern},
                  {"whole_field", wholeField},
                  {"choose_reference", chooseReference},
                  {"add_point", addPoint},
                  {"clear_points", clearPoints},
                  {"georeference", georeference}},
      .facts = kFacts,
      .lists = {{"control_points", controlRows}},
      .events =
          {
              {.name = "position_base", .about = "base name of positions set (VZ-i)"},
              {.name = "georeferenced", .about = "number of control points found (VZ-i)"},
              {.name = "control_point", .about = "control point entered: its name (VZ-i)"},
          },
      .prepare = prepare,
  };
  return all;
}

}  // namespace standpoint::riegl_vz_i
