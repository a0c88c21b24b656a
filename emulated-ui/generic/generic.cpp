// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/generic/generic.h"

#include <fmt/format.h>

#include "core/units.h"
#include "emulated-ui/device/effects.h"

namespace standpoint {

namespace {

constexpr const char* kWorking = "scanning photographing";
constexpr const char* kHolding = "scanning photographing storing error";

// The data sheet says how far the scanner's own compensator reaches and how near it measures.
double compensatorRange_deg(const Device& device) {
  const auto& compensator = device.type().instrument.compensator;
  const double range = compensator ? compensator->range_rad / kRadPerDeg : 0;
  return range > 0 ? range : device.type().definition.body.tilt_limit_deg;
}

bool levelled(const Device& device) {
  return device.type().instrument.compensator && device.value("compensator") == "on" &&
         device.tilt() <= compensatorRange_deg(device);
}

void prepare(const Device& device, ScanOrder& order) {
  order.compensator = levelled(device);
  const auto* project = device.project();
  order.name =
      fmt::format("{}{:03d}", project == nullptr || project->base.empty() ? "Scan_" : project->base, order.number);
}

void storeAndLink(Device& device) {
  storeScan(device);
  orderLink(device);
}

const FactDomain kYesNo{{"yes", "no"}, false, 0, 0};

const DeviceProgram kProgram = {
    "generic/generic.json",
    {
        {"off", "power_key", "battery.state != critical or mains == yes", "booting", "", "", nullptr, "P"},
        {"booting", "elapsed", "", "idle", "", "", nullptr, "P"},
        {"idle", "power_key", "", "", "", "shut_down", nullptr, "P"},
        {"idle", "shut_down", "", "shutting_down", "", "", nullptr, "P"},
        {"shutting_down", "elapsed", "", "off", "", "", nullptr, "P"},
        {"idle", "start", "project.open == no", "", "", "no_project", nullptr, "P"},
        {"idle", "start", "standing == no", "", "", "no_station", nullptr, "P"},
        {"idle", "start", "card == absent", "", "", "card_absent", nullptr, "G1"},
        {"idle", "start", "card == locked", "", "", "card_locked", nullptr, "P"},
        {"idle", "start", "card.free < @expected.bytes", "", "", "card_full", nullptr, "G1"},
        {"idle", "start", "battery.state == critical and mains == no", "", "", "battery_critical", nullptr, "G1"},
        {"idle", "start", "temperature.state != good", "", "", "temperature_question", nullptr, "G1"},
        {"idle", "start", "warm == no", "", "", "not_warm_question", nullptr, "P"},
        {"idle", "start", "levelled == no and value.compensator == on", "", "", "tilt_question", nullptr, "G1"},
        {"idle", "start", "nearest < @nearest.least", "", "", "near_question", nullptr, "P"},
        {"idle", "start", "", "scanning", "", "", beginScan, "P"},
        {"idle", "start_anyway", "", "scanning", "", "", beginScan, "P"},
        {"scanning", "elapsed", "imaging == yes", "photographing", "", "", nullptr, "P"},
        {kWorking, "elapsed", "", "storing", "", "", nullptr, "P"},
        {"storing", "elapsed", "data == yes and value.auto_link == on", "idle", "scan_view", "", storeAndLink, "P"},
        {"storing", "elapsed", "data == yes", "idle", "scan_view", "", storeScan, "P"},
        {kWorking, "stop", "", "", "", "stop_question", nullptr, "P"},
        {kHolding, "stop_confirmed", "", "idle", "home", "", dropScan, "P"},
        {"scanning", "keep_partial", "", "storing", "", "", keepPartial, "P"},
        {"photographing", "keep_partial", "", "storing", "", "", nullptr, "P"},
        {kWorking, "moved", "", "error", "", "moved", markMoved, "S10"},
        {"photographing", "set_down", "", "error", "", "moved", markMoved, "S10"},
        {"scanning", "blocked", "", "error", "", "blocked", nullptr, "P"},
        {"error", "keep", "", "storing", "", "", nullptr, "P"},
        {kHolding, "card_removed", "", "idle", "home", "card_lost", dropScan, "P"},
        {kHolding, "failed", "", "idle", "home", "", nullptr, "P"},
        {kWorking, "tilted", "", "", "", "tilt_warning", nullptr, "S18"},
        {"*", "temperature", "", "", "", "temperature_warning", nullptr, "P"},
        {"*", "battery_low", "", "", "", "battery_low", nullptr, "P"},
        {"*", "battery_critical", "", "", "", "battery_critical", nullptr, "P"},
        {"*", "battery_empty", "", "off", "", "", dropScan, "P"},
        {"idle", "linked", "link == joined", "", "", "link_joined", nullptr, "P"},
        {"idle", "linked", "", "", "", "link_failed", nullptr, "P"},
        {"idle", "targets_measured", "", "", "targets", "", nullptr, "P"},
        {"idle", "transferred", "", "", "", "transferred", nullptr, "S35"},
        {"idle", "delete", "", "", "", "delete_question", nullptr, "P"},
        {"idle", "delete_confirmed", "", "", "scans", "", deleteShownSetup, "P"},
        {"idle", "format", "", "", "", "format_question", nullptr, "P"},
        {"idle", "format_confirmed", "card == present", "", "home", "", formatCard, "P"},
        {"idle", "format_confirmed", "card == absent", "", "", "card_absent", nullptr, "P"},
        {"idle", "format_confirmed", "", "", "", "card_locked", nullptr, "P"},
    },
    {},
    {{"levelled", FactUnit::none, kYesNo, [](const Device& d) { return yesNo(levelled(d)); },
      "the scanner's compensator is on and its range is enough"},
     {"has_compensator", FactUnit::none, kYesNo,
      [](const Device& d) { return yesNo(d.type().instrument.compensator.has_value()); }, "by its data sheet"},
     {"compensator.range",
      FactUnit::degrees,
      {{}, true, 0, 360},
      [](const Device& d) { return numberFact(compensatorRange_deg(d)); },
      "of the scanner's compensator"},
     {"nearest.least",
      FactUnit::metres,
      {{}, true, 0, 1e6},
      [](const Device& d) { return numberFact(d.type().instrument.min_range_m); },
      "the shortest range of the data sheet"},
     {"scanner",
      FactUnit::none,
      {},
      [](const Device& d) { return wordFact(d.type().instrument.maker + " " + d.type().instrument.model); },
      "maker and model"}},
    {},
    prepare,
};

}  // namespace

const DeviceProgram& genericProgram() { return kProgram; }

}  // namespace standpoint
