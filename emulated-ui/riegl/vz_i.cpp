// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/riegl/vz_i.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "emulated-ui/device/default_transitions.h"
#include "emulated-ui/device/effects.h"
#include "emulated-ui/device/settings.h"
#include "emulated-ui/riegl/positions.h"
#include "emulated-ui/riegl/registering.h"

namespace standpoint {

namespace {

using namespace riegl;

constexpr const char* kWorking = "scanning photographing";
constexpr const char* kHolding = "scanning photographing storing error";
constexpr const char* kAfter = "searching processing";

// Lines are counted from the zenith: 30 to 130 degrees are elevations of 60 to -40.
Result<void> proposePattern(Device& device, const std::string&) {
  const auto angle = [&](const char* key) { return std::strtod(device.setting(key).c_str(), nullptr); };
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
  const auto number = [&](const char* id) { return std::strtod(device.entry(id).c_str(), nullptr); };
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
  const auto& phase = device.state().phase;
  if (phase == "waiting" || phase == "error") return "waiting";
  if (phase == "scanning" || phase == "photographing") return "scanning";
  return phase == "storing" || phase == "searching" || phase == "processing" ? "processing" : "unavailable";
}

const FactDomain kYesNo{{"yes", "no"}, false, 0, 0};
FactDomain upTo(double most) { return {{}, true, 0, most}; }

const std::vector<FactRow> kFacts = {
    {"opstate",
     FactUnit::none,
     {{"unavailable", "waiting", "scanning", "processing"}, false, 0, 0},
     [](const Device& d) { return wordFact(opstate(d)); },
     "the four states of the manufacturer's interface [S31]"},
    {"setup.next", FactUnit::none, upTo(1e6), [](const Device& d) { return numberFact(nextPosition(d)); },
     "number of the next scan position"},
    {"position.name",
     FactUnit::none,
     {},
     [](const Device& d) { return wordFact(nextPositionName(d)); },
     "of the next scan"},
    {"position.taken", FactUnit::none, kYesNo, [](const Device& d) { return yesNo(positionTaken(d)); },
     "the next number is already used"},
    {"positions.double", FactUnit::none, upTo(1e6), [](const Device& d) { return numberFact(doublePositions(d)); },
     "scans with a duplicate number"},
    {"card",
     FactUnit::none,
     {{"present", "absent", "locked"}, false, 0, 0},
     [](const Device& d) { return wordFact(cardState(d)); },
     "the chosen storage medium"},
    {"card.free", FactUnit::bytes, upTo(1e16), [](const Device& d) { return numberFact(cardFree(d)); },
     "on the chosen storage medium"},
    {"card.scans_left", FactUnit::none, upTo(1e9),
     [](const Device& d) { return numberFact(std::floor(cardFree(d) / std::max(1.0, d.expectedBytes()))); },
     "number of scans with these settings that still fit on it"},
    {"registration.seconds", FactUnit::seconds, upTo(1e4),
     [](const Device& d) { return numberFact(registrationSeconds(d)); }, "time the mode searches for a match"},
    {"registration.result",
     FactUnit::none,
     {{"none", "ok", "fast_failed", "scan_failed"}, false, 0, 0},
     [](const Device& d) { return wordFact(registrationResult(d)); },
     "of the newest registration"},
    {"reflector.reach", FactUnit::metres, upTo(1e6), [](const Device& d) { return numberFact(reach(d)); },
     "maximum distance with five points on the chosen reflector"},
    {"searched", FactUnit::none, kYesNo, [](const Device& d) { return yesNo(d.entry("searched") == "yes"); },
     "the reflector search has finished"},
    {"control_points", FactUnit::none, upTo(1e6),
     [](const Device& d) { return numberFact(static_cast<double>(controlNames(d).size())); },
     "number in the project's list"},
    {"georeferenced", FactUnit::none, kYesNo, [](const Device& d) { return yesNo(isGeoreferenced(d)); },
     "whether the project is georeferenced"},
};

const DeviceRoles kRoles = {
    .off = "unavailable",
    .ready = "waiting",
    .rest = "waiting",
    .idle = "waiting",
    .working = kWorking,
    .measuring = kWorking,
    .camera = "photographing",
    .holding = kHolding,
    .kept = "storing",
    .scans = "positions",
    .start = "scan",
    .start_anyway = "scan_anyway",
    .first_questions = {{"waiting", "scan", "position.taken == yes", "", "", "position_question", nullptr, "S32"}},
    .tilted = "level == out",
    .begin = beginScan,
    .card_needed = "value.storage != ssd",
    .marks = {{"S31", "power_key scan/no_project scan"}, {"S35", "transferred"}},
};

const DeviceProgram kProgram = {
    "riegl/vz_i.json",
    withDefaults(
        {
            {"scanning", "elapsed", "imaging == yes and setting.image_mode == after_scan", "photographing", "", "",
             nullptr, "S31"},
            {kWorking, "elapsed", "", "storing", "", "", nullptr, "S31"},
            {"storing", "elapsed", "data == yes and value.reflector_search == on", "searching", "", "", storeAndSearch,
             "S31"},
            {"storing", "elapsed", "data == yes and value.registration == on and setups > 0", "processing", "", "",
             storeAndRegister, "S31"},
            {"storing", "elapsed", "data == yes", "waiting", "position_view", "", storePosition, "S31"},
            {"searching", "targets_measured", "", "", "", "", filterReflectors, "S31"},
            {"searching", "elapsed", "searched == yes and value.registration == on and setups > 1", "processing", "",
             "", beginRegistration, "S31"},
            {"searching", "elapsed", "searched == yes", "waiting", "reflectors", "", nullptr, "S31"},
            {"processing waiting unavailable", "linked", "", "", "", "", judgeRegistration, "S31"},
            {"processing", "elapsed", "registration.result == ok", "waiting", "position_view", "", nullptr, "S31"},
            {"processing", "elapsed", "registration.result == fast_failed", "waiting", "registration",
             "fast_reg_failed", nullptr, "S31"},
            {"processing", "elapsed", "registration.result == scan_failed", "waiting", "registration",
             "scan_reg_failed", nullptr, "S31"},
            {"waiting", "register", "", "processing", "", "", beginRegistration, "S31"},
            {kAfter, "failed", "", "waiting", "positions", "", nullptr, "P"},
            {"waiting", "targets_measured", "", "", "reflectors", "", filterReflectors, "S31"},
            {"waiting", "delete_confirmed", "", "", "positions", "", deletePosition, "P"},
            {"waiting", "format_confirmed", "card == present", "", "home", "", formatMedium, "P"},
        },
        kRoles),
    {{"load_or_create", loadOrCreate},
     {"open_position_project", openPositionProject},
     {"propose_position", proposePosition},
     {"set_base", setBase},
     {"number_from_here", numberFromHere},
     {"propose_pattern", proposePattern},
     {"take_pattern", takePattern},
     {"whole_field", wholeField},
     {"add_point", addPoint},
     {"clear_points", clearPoints},
     {"georeference", georeference}},
    kFacts,
    {{"control_points", controlRows}},
    prepare,
};

}  // namespace

const DeviceProgram& vzIProgram() { return kProgram; }

}  // namespace standpoint
