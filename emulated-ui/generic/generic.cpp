// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/generic/generic.h"

#include <fmt/format.h>

#include "core/units.h"
#include "emulated-ui/device/default_transitions.h"
#include "emulated-ui/device/effects.h"

namespace standpoint {

namespace {

constexpr const char* kWorking = "scanning photographing";
constexpr const char* kHolding = "scanning photographing storing error";

// The data sheet says how far the scanner's own compensator reaches.
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

const DeviceRoles kRoles = {
    .working = kWorking,
    .measuring = kWorking,
    .camera = "photographing",
    .holding = kHolding,
    .kept = "storing",
    .scans = "scans",
    .tilted = "levelled == no and value.compensator == on",
    .begin = beginScan,
    .marks = {{"G1",
               "start/card_absent start/card_full start/battery_critical start/temperature_question "
               "start/tilt_question"},
              {"S10", "tripod_moved set_down/tripod_moved"},
              {"S18", "tilted/tilt_warning"},
              {"S35", "transferred"}},
};

const DeviceProgram kProgram = {
    "generic/generic.json",
    withDefaults(
        {
            {"scanning", "elapsed", "imaging == yes", "photographing", "", "", nullptr, "P"},
            {kWorking, "elapsed", "", "storing", "", "", nullptr, "P"},
            {"storing", "elapsed", "data == yes and value.auto_link == on", "idle", "scan_view", "", storeAndLink, "P"},
            {"storing", "elapsed", "data == yes", "idle", "scan_view", "", storeScan, "P"},
            {"scanning", "keep_partial", "", "storing", "", "", keepPartial, "P"},
            {"photographing", "keep_partial", "", "storing", "", "", nullptr, "P"},
        },
        kRoles),
    {},
    {{"levelled", FactUnit::none, kYesNo, [](const Device& d) { return yesNo(levelled(d)); },
      "the compensator is on and within its range"},
     {"has_compensator", FactUnit::none, kYesNo,
      [](const Device& d) { return yesNo(d.type().instrument.compensator.has_value()); },
      "according to its data sheet"},
     {"compensator.range",
      FactUnit::degrees,
      {{}, true, 0, 360},
      [](const Device& d) { return numberFact(compensatorRange_deg(d)); },
      "range of the scanner's compensator"},
     {"scanner",
      FactUnit::none,
      {},
      [](const Device& d) { return wordFact(d.type().instrument.maker + " " + d.type().instrument.model); },
      "manufacturer and model"}},
    {},
    prepare,
};

}  // namespace

const DeviceProgram& genericProgram() { return kProgram; }

}  // namespace standpoint
