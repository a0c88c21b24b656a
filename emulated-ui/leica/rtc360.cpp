// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/leica/rtc360.h"

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

void prepare(const Device& device, ScanOrder& order) {
  order.compensator = order.compensator && device.value("tilt_sensor") == "on";
}

const DeviceProgram kProgram = {
    "leica/rtc360.json",
    {
        {"off", "power_key", "battery.state != critical or mains == yes", "booting", "", "", nullptr, "G1"},
        {"booting", "elapsed", "", "idle", "", "", nullptr, "G1"},
        {kIdle, "power_key", "", "", "", "shut_down", nullptr, "P"},
        {kIdle, "shut_down", "", "shutting_down", "", "", nullptr, "G1"},
        {"shutting_down", "elapsed", "", "off", "", "", nullptr, "G1"},
        // What the start refuses, then what it asks.
        {kIdle, "start", "project.open == no", "", "", "no_project", nullptr, "P"},
        {kIdle, "start", "standing == no", "", "", "no_station", nullptr, "P"},
        {kIdle, "start", "card == absent", "", "", "card_absent", nullptr, "G1"},
        {kIdle, "start", "card == locked", "", "", "card_locked", nullptr, "P"},
        {kIdle, "start", "card.free < @expected.bytes", "", "", "card_full", nullptr, "G1"},
        {kIdle, "start", "battery.state == critical and mains == no", "", "", "battery_critical", nullptr, "G1"},
        {kIdle, "start", "temperature.state != good", "", "", "temperature_question", nullptr, "G1"},
        {kIdle, "start", "warm == no", "", "", "not_warm_question", nullptr, "P"},
        {kIdle, "start", "level == out", "", "", "tilt_question", nullptr, "G1"},
        {kIdle, "start", "nearest < 0.5", "", "", "near_question", nullptr, "P"},
        {kIdle, "start", "", "scanning_pass_1", "", "", beginScan, "G1"},
        {kIdle, "start_anyway", "", "scanning_pass_1", "", "", beginScan, "P"},
        {"scanning_pass_1", "elapsed", "passes == 2", "scanning_pass_2", "", "", nullptr, "G1"},
        {kLaser, "elapsed", "imaging == yes", "photographing", "", "", nullptr, "P"},
        {kLaser, "elapsed", "data == yes", "storing", "", "", nullptr, "P"},
        {"photographing", "elapsed", "data == yes", "storing", "", "", nullptr, "G1"},
        {"storing", "elapsed", "value.vis == on", "vis_tracking", "setup", "", storeAndLink, "G1"},
        {"storing", "elapsed", "", "idle", "setup", "", storeWithoutLink, "G1"},
        {"vis_tracking", "set_down", "value.vis == on and tracking == yes", "idle", "home", "link_proposed", nullptr, "G1"},
        {"vis_tracking", "set_down", "", "idle", "home", "link_lost", loseTracking, "G1"},
        {"vis_tracking", "tracking_lost", "", "", "", "tracking_lost", nullptr, "G1"},
        {kWorking, "stop", "", "", "", "stop_question", nullptr, "P"},
        {kHolding, "stop_confirmed", "", "idle", "home", "", dropScan, "P"},
        {kWorking, "moved", "", "error", "", "moved", markMoved, "G1"},
        {"photographing", "set_down", "", "error", "", "moved", markMoved, "P"},
        {kLaser, "blocked", "", "error", "", "blocked", nullptr, "G1"},
        {"error", "keep", "", "finishing", "", "", nullptr, "P"},
        {"finishing", "elapsed", "data == yes", "storing", "", "", nullptr, "P"},
        {kHolding, "card_removed", "", "idle", "home", "card_lost", dropScan, "P"},
        {kHolding, "failed", "", "idle", "home", "", nullptr, "P"},
        {kWorking, "tilted", "", "", "", "tilt_warning", nullptr, "P"},
        {"*", "temperature", "", "", "", "temperature_warning", nullptr, "G1"},
        {"*", "battery_low", "", "", "", "battery_low", nullptr, "G1"},
        {"*", "battery_critical", "", "", "", "battery_critical", nullptr, "P"},
        {"*", "battery_empty", "", "off", "", "", dropScan, "P"},
        {kIdle, "linked", "link == joined", "", "", "link_joined", nullptr, "G1"},
        {kIdle, "linked", "", "", "", "link_failed", nullptr, "G1"},
        {kIdle, "targets_measured", "", "", "targets", "", nullptr, "S19"},
        {kIdle, "transferred", "", "", "", "transferred", nullptr, "S35"},
        {kIdle, "delete", "", "", "", "delete_question", nullptr, "G1"},
        {kIdle, "delete_confirmed", "", "", "setups", "", deleteShownSetup, "G1"},
        {kIdle, "format", "", "", "", "format_question", nullptr, "G1"},
        {kIdle, "format_confirmed", "card == present", "", "home", "", formatCard, "G1"},
        {kIdle, "format_confirmed", "card == absent", "", "", "card_absent", nullptr, "P"},
        {kIdle, "format_confirmed", "", "", "", "card_locked", nullptr, "P"},
        {kIdle, "adjust", "level == good and warm == yes", "adjusting", "", "", nullptr, "G1"},
        {kIdle, "adjust", "", "", "", "adjust_refused", nullptr, "P"},
        {"adjusting", "elapsed", "", "idle", "tools", "adjusted", nullptr, "P"},
        {"adjusting", "moved", "", "idle", "tools", "adjust_refused", nullptr, "P"},
    },
    {},
    {},
    {},
    prepare,
};

}  // namespace

const DeviceProgram& rtc360Program() { return kProgram; }

}  // namespace standpoint
