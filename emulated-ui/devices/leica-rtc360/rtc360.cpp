// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include "emulated-ui/device/default_transitions.h"
#include "emulated-ui/device/device.h"
#include "emulated-ui/device/effects.h"
#include "emulated-ui/device/linking.h"

// Leica RTC360 with its touch display and what FIELD 360 adds: off, booting, idle, one or two passes of the laser,
// pictures, storing, and the tracking of the way to the next setup. Transitions: instrument facts, section 2.2.
namespace standpoint::leica_rtc360 {

namespace {

namespace phase {

const PhaseId idle{"idle"}, scanning_pass_1{"scanning_pass_1"}, scanning_pass_2{"scanning_pass_2"},
    photographing{"photographing"}, finishing{"finishing"}, storing{"storing"}, vis_tracking{"vis_tracking"},
    error{"error"};

}  // namespace phase

using Event = EngineEvent;

const Phases kIdle = {phase::idle, phase::vis_tracking};
const Phases kLaser = {phase::scanning_pass_1, phase::scanning_pass_2};
const Phases kWorking = {phase::scanning_pass_1, phase::scanning_pass_2, phase::photographing};
const Phases kHolding = {phase::scanning_pass_1, phase::scanning_pass_2, phase::photographing,
                         phase::finishing,       phase::error,           phase::storing};

// The link follows where the way was tracked and there is a setup to join.
void storeAndFollow(Device& device) {
  const bool tracked = device.state().around.tracking;
  storeScan(device);
  if (tracked) orderLink(device);
  resetTracking(device);
}

void storeWithoutLink(Device& device) {
  storeScan(device);
  resetTracking(device);
}

std::optional<LaidCloud> laidNewest(const Device& device) { return laidCloud(device, device.newestSetup()); }

Result<void> optimise(Device& device, const std::string&) {
  const auto* newest = device.newestSetup();
  if (newest == nullptr || !laidNewest(device)) return failure(ErrorKind::usage, device.word("link_needs_two"));
  orderLaidLink(device, *newest);
  return {};
}

// What the next press of the scan key does.
std::string summary(const Device& device) {
  const bool scans = device.setting("scan") == "on", shoots = device.expected().imaging;
  std::string text = scans ? device.shown("setting.resolution") : "";
  if (scans && device.expected().passes == 2) text += " · " + device.word("double_scan");
  if (shoots) text += (text.empty() ? "" : " · ") + device.word("images");
  return text;
}

const DeviceRoles kRoles = {
    .rest = kIdle,
    .idle = kIdle,
    .working = kWorking,
    .measuring = kWorking,
    .laser = kLaser,
    .camera = {phase::photographing},
    .holding = kHolding,
    .kept = phase::finishing,
    .scans = "setups",
    .tools = "tools",
    .first_questions =
        {
            {.from = kIdle,
             .event = "start",
             .guard = "setting.scan == off and imaging == no",
             .ask = "nothing_chosen"},
        },
    .last_questions =
        {
            {.from = kIdle,
             .event = "start",
             .guard = "setting.scan == off",
             .to = phase::photographing,
             .effect = beginScan,
             .source = "G1"},
        },
    .tilted = "level == out",
    .first = phase::scanning_pass_1,
    .marks =
        {{"G1",
          rowsOf("power_key elapsed shut_down start start/card_absent start/card_full start/battery_critical "
                 "start/temperature_question start/tilt_question tripod_moved blocked temperature/temperature_warning "
                 "battery_low linked/link_joined linked/link_failed delete/delete_question delete_confirmed "
                 "format/format_question format_confirmed adjust")},
         {"S19", rowsOf("targets_measured")},
         {"S35", rowsOf("transferred")}},
};

std::vector<Transition> transitions() {
  return withDefaults(
      {
          // With the scan off the laser stays off.
          {.from = kIdle,
           .event = "start_anyway",
           .guard = "setting.scan == off",
           .to = phase::photographing,
           .effect = beginScan},
          {.from = {phase::scanning_pass_1},
           .event = Event::elapsed,
           .guard = "passes == 2",
           .to = phase::scanning_pass_2,
           .source = "G1"},
          {.from = kLaser, .event = Event::elapsed, .guard = "imaging == yes", .to = phase::photographing},
          {.from = kLaser, .event = Event::elapsed, .guard = "data == yes", .to = phase::storing},
          {.from = {phase::photographing},
           .event = Event::elapsed,
           .guard = "data == yes",
           .to = phase::storing,
           .source = "G1"},
          {.from = {phase::storing},
           .event = Event::elapsed,
           .guard = "value.vis == on",
           .to = phase::vis_tracking,
           .show = "setup",
           .effect = storeAndFollow,
           .source = "G1"},
          {.from = {phase::storing},
           .event = Event::elapsed,
           .to = phase::idle,
           .show = "setup",
           .effect = storeWithoutLink,
           .source = "G1"},
          // Another job was opened meanwhile, and there is nothing in it to be joined.
          {.from = {phase::vis_tracking},
           .event = Event::set_down,
           .guard = "setups == 0",
           .to = phase::idle,
           .show = "home"},
          {.from = {phase::vis_tracking},
           .event = Event::set_down,
           .guard = "value.vis == on and tracking == yes",
           .to = phase::idle,
           .show = "home",
           .ask = "link_proposed",
           .source = "G1"},
          {.from = {phase::vis_tracking},
           .event = Event::set_down,
           .to = phase::idle,
           .show = "home",
           .ask = "link_lost",
           .effect = loseTracking,
           .source = "G1"},
          {.from = {phase::vis_tracking}, .event = Event::tracking_lost, .ask = "tracking_lost", .source = "G1"},
          {.from = {phase::finishing}, .event = Event::elapsed, .guard = "data == yes", .to = phase::storing},
          {.from = kIdle,
           .event = Event::linked,
           .guard = "linked == joined",
           .ask = "link_joined",
           .effect = forgetLaid,
           .source = "G1"},
          {.from = kIdle, .event = "delete_job", .ask = "delete_job_question", .source = "G1"},
          {.from = kIdle, .event = "delete_job_confirmed", .show = "jobs", .effect = deleteOpenProject, .source = "G1"},
      },
      kRoles);
}

std::vector<FactRow> facts() {
  return {
      {.name = "settings.summary",
       .value = [](const Device& d) { return wordFact(summary(d)); },
       .about = "settings of the next scan: resolution, double scan, images"},
  };
}

}  // namespace

const DeviceProgram& program() {
  static const DeviceProgram all = {
      .transitions = transitions(),
      .actions = {{"optimise", optimise}},
      .facts = facts(),
      .laid = laidNewest,
  };
  return all;
}

}  // namespace standpoint::leica_rtc360
