// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/leica/rtc360.h"

#include <string>

#include "emulated-ui/device/default_transitions.h"
#include "emulated-ui/device/effects.h"

namespace standpoint {

namespace {

constexpr const char* kIdle = "idle vis_tracking";
constexpr const char* kLaser = "scanning_pass_1 scanning_pass_2";
constexpr const char* kWorking = "scanning_pass_1 scanning_pass_2 photographing";
constexpr const char* kHolding = "scanning_pass_1 scanning_pass_2 photographing finishing error storing";

// The link follows where the way was tracked and there is a setup to join.
void storeAndLink(Device& device) {
  const bool tracked = device.state().around.tracking;
  storeScan(device);
  if (tracked) orderLink(device);
  resetTracking(device);
}

void storeWithoutLink(Device& device) {
  storeScan(device);
  resetTracking(device);
}

// What the next press of the scan key does.
std::string summary(const Device& device) {
  const bool scans = device.setting("scan") == "on", shoots = device.expected().imaging;
  std::string text = scans ? device.shown("setting.resolution") : "";
  if (scans && device.expected().passes == 2) text += " · " + device.word("double_scan");
  if (shoots) text += (text.empty() ? "" : " · ") + device.word("images");
  return text;
}

void prepare(const Device& device, ScanOrder& order) {
  order.compensator = order.compensator && device.value("tilt_sensor") == "on";
}

const DeviceRoles kRoles = {
    .rest = kIdle,
    .idle = kIdle,
    .working = kWorking,
    .measuring = kWorking,
    .laser = kLaser,
    .camera = "photographing",
    .holding = kHolding,
    .kept = "finishing",
    .scans = "setups",
    .tools = "tools",
    .first_questions = {{kIdle, "start", "setting.scan == off and imaging == no", "", "", "nothing_chosen", nullptr,
                         "P"}},
    .last_questions = {{kIdle, "start", "setting.scan == off", "photographing", "", "", beginScan, "G1"}},
    .tilted = "level == out",
    .first = "scanning_pass_1",
    .begin = beginScan,
    .marks = {{"G1",
               "power_key elapsed shut_down start start/card_absent start/card_full start/battery_critical "
               "start/temperature_question start/tilt_question tripod_moved blocked temperature/temperature_warning "
               "battery_low linked/link_joined linked/link_failed delete/delete_question delete_confirmed "
               "format/format_question format_confirmed adjust"},
              {"S19", "targets_measured"},
              {"S35", "transferred"}},
};

const DeviceProgram kProgram = {
    "leica/rtc360.json",
    withDefaults(
        {
            // With the scan off the laser stays off.
            {kIdle, "start_anyway", "setting.scan == off", "photographing", "", "", beginScan, "P"},
            {"scanning_pass_1", "elapsed", "passes == 2", "scanning_pass_2", "", "", nullptr, "G1"},
            {kLaser, "elapsed", "imaging == yes", "photographing", "", "", nullptr, "P"},
            {kLaser, "elapsed", "data == yes", "storing", "", "", nullptr, "P"},
            {"photographing", "elapsed", "data == yes", "storing", "", "", nullptr, "G1"},
            {"storing", "elapsed", "value.vis == on", "vis_tracking", "setup", "", storeAndLink, "G1"},
            {"storing", "elapsed", "", "idle", "setup", "", storeWithoutLink, "G1"},
            {"vis_tracking", "set_down", "value.vis == on and tracking == yes", "idle", "home", "link_proposed",
             nullptr, "G1"},
            {"vis_tracking", "set_down", "", "idle", "home", "link_lost", loseTracking, "G1"},
            {"vis_tracking", "tracking_lost", "", "", "", "tracking_lost", nullptr, "G1"},
            {"finishing", "elapsed", "data == yes", "storing", "", "", nullptr, "P"},
            {kIdle, "delete_job", "", "", "", "delete_job_question", nullptr, "G1"},
            {kIdle, "delete_job_confirmed", "", "", "jobs", "", deleteOpenProject, "G1"},
        },
        kRoles),
    {},
    {{"settings.summary",
      FactUnit::none,
      {},
      [](const Device& d) { return wordFact(summary(d)); },
      "settings of the next scan: resolution, double scan, images"}},
    {},
    prepare,
};

}  // namespace

const DeviceProgram& rtc360Program() { return kProgram; }

}  // namespace standpoint
