// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/units.h"
#include "emulated-ui/device/default_transitions.h"
#include "emulated-ui/device/device.h"
#include "emulated-ui/device/effects.h"
#include "emulated-ui/devices/trimble-x7/links.h"
#include "emulated-ui/devices/trimble-x7/phases.h"
#include "emulated-ui/devices/trimble-x7/tablet.h"

// Trimble X7 and X9 with the software of their tablet: projects, scan panel, capture step by step, registration with
// its two limits, stations, export. Transitions: instrument facts, section 2.5.
namespace standpoint::trimble_x7 {

namespace {

const Phases kRest = {phase::idle, phase::disconnected};
const Phases kBefore = {phase::calibrating, phase::levelling, phase::not_level};  // nothing is measured yet
const Phases kWorking = {phase::scanning, phase::imaging};
const Phases kHolding = {phase::scanning, phase::imaging, phase::downloading, phase::interrupted, phase::error};

// --- facts of the link on view ---

const LinkResult* linkOnView(const Device& device) {
  const auto* setup = linkedSetup(device);
  return setup != nullptr && setup->link ? &*setup->link : nullptr;
}
template <double (*Of)(const LinkResult&)>
Fact ofLink(const Device& device) {
  const auto* link = linkOnView(device);
  return numberFact(link == nullptr ? 0 : Of(*link));
}
double errorOf(const LinkResult& link) { return link.error_m * 1000; }
double overlapOf(const LinkResult& link) { return link.overlap; }
double wholeConfidence(const LinkResult& link) { return std::floor(confidenceOf(link) * 10) / 10; }
double wholeConsistency(const LinkResult& link) { return std::floor(consistencyOf(link) * 10) / 10; }

double differenceOnView(const Device& device) {
  const auto* setup = linkedSetup(device);
  return setup == nullptr ? 0 : tiltDifference_deg(*setup, *partnerOf(device, *setup));
}

bool judgedNow(const Device& device) {
  const auto* setup = setupOfFile(device, device.state().linking);
  return setup != nullptr && registrationOf(device, *setup) != "none";
}

double registeredStations(const Device& device) {
  double n = 0;
  if (const auto* project = device.project())
    for (const auto& setup : project->setups) {
      const auto state = registrationOf(device, setup);
      n += state == "registered" || state == "applied" || &setup == &project->setups.front() ? 1 : 0;
    }
  return n;
}

double worstLink(const Device& device) {
  double worst = 0;
  if (const auto* project = device.project())
    for (const auto& setup : project->setups)
      if (setup.link) worst = std::max(worst, errorOf(*setup.link));
  return worst;
}

std::string pairOnView(const Device& device) {
  const auto* setup = linkedSetup(device);
  return setup == nullptr ? "" : partnerOf(device, *setup)->name + " – " + setup->name;
}

std::string pointerAngles(const Device& device) {
  const auto spot = pointerSpot(device);
  if (!spot) return "";
  const double azimuth = -std::atan2(spot->y(), spot->x()) / kRadPerDeg,
               zenith = std::acos(spot->z() / spot->norm()) / kRadPerDeg;
  return fmt::format("H {:.1f}°  V {:.1f}°", azimuth < 0 ? azimuth + 360 : azimuth, zenith);
}

std::string stateOnView(const Device& device) {
  const auto* setup = linkedSetup(device);
  return setup == nullptr ? "none" : registrationOf(device, *setup);
}

const FactDomain kYesNo{{"yes", "no"}, false, 0, 0};
const FactDomain kAnyWord{};
FactDomain upTo(double most) { return {{}, true, 0, most}; }

const std::vector<FactRow> kFacts = {
    {.name = "connected",
     .domain = kYesNo,
     .value = [](const Device& d) { return yesNo(connected(d)); },
     .about = "the tablet is connected to its scanner"},
    {.name = "reachable",
     .domain = kYesNo,
     .value = [](const Device& d) { return yesNo(reachable(d)); },
     .about = "by cable or a working wireless link"},
    {.name = "start_index.valid",
     .domain = kYesNo,
     .value = [](const Device& d) { return yesNo(startIndexValid(d)); },
     .about = "the entered start index is a whole number from 1 to 999999"},
    {.name = "area.parent",
     .value = [](const Device& d) { return wordFact(parentOfArea(d) == nullptr ? "" : parentOfArea(d)->name); },
     .about = "parent station of an area scan at this place"},
    {.name = "area.has_parent",
     .domain = kYesNo,
     .value = [](const Device& d) { return yesNo(parentOfArea(d) != nullptr); },
     .about = "whether one exists"},
    {.name = "expected.download",
     .unit = FactUnit::seconds,
     .domain = upTo(1e6),
     .value = [](const Device& d) { return numberFact(downloadSeconds(d)); },
     .about = "from the scanner to the tablet"},
    {.name = "step.progress",
     .unit = FactUnit::fraction,
     .domain = upTo(1),
     .value = [](const Device& d) { return numberFact(stepProgress(d)); },
     .about = "progress of the current step"},
    {.name = "link.pair",
     .value = [](const Device& d) { return wordFact(pairOnView(d)); },
     .about = "the two stations of the displayed link"},
    {.name = "pair.error",
     .unit = FactUnit::millimetres,
     .domain = upTo(1e6),
     .value = ofLink<errorOf>,
     .about = "RMS of the displayed link"},
    {.name = "pair.overlap",
     .unit = FactUnit::fraction,
     .domain = upTo(1),
     .value = ofLink<overlapOf>,
     .about = "of the displayed link"},
    {.name = "consistency", .domain = upTo(100), .value = ofLink<wholeConsistency>, .about = "percent, from the error"},
    {.name = "confidence",
     .domain = upTo(100),
     .value = ofLink<wholeConfidence>,
     .about = "percent, from consistency and overlap; limits 73 and 91"},
    {.name = "tilt.difference",
     .unit = FactUnit::degrees,
     .domain = upTo(180),
     .value = [](const Device& d) { return numberFact(differenceOnView(d)); },
     .about = "between the two clouds of the displayed link"},
    {.name = "registration",
     .domain = {{"none", "registered", "check", "failed", "applied", "rejected"}, false, 0, 0},
     .value = [](const Device& d) { return wordFact(stateOnView(d)); },
     .about = "of the displayed link"},
    {.name = "link.judged",
     .domain = kYesNo,
     .value = [](const Device& d) { return yesNo(judgedNow(d)); },
     .about = "the last requested link has a result"},
    {.name = "links.left",
     .domain = upTo(1e6),
     .value = [](const Device& d) { return numberFact(linksLeft(d)); },
     .about = "links still to refine"},
    {.name = "links.worst",
     .unit = FactUnit::millimetres,
     .domain = upTo(1e6),
     .value = [](const Device& d) { return numberFact(worstLink(d)); },
     .about = "largest error of the project's links"},
    {.name = "stations.registered",
     .domain = upTo(1e6),
     .value = [](const Device& d) { return numberFact(registeredStations(d)); },
     .about = "stations joined to the first"},
    {.name = "pointer.range",
     .unit = FactUnit::metres,
     .domain = upTo(1e6),
     .value = [](const Device& d) { return numberFact(pointerSpot(d).value_or(Eigen::Vector3d::Zero()).norm()); },
     .about = "distance to the laser-pointer spot; 0: pointer not aimed"},
    {.name = "pointer.angles",
     .value = [](const Device& d) { return wordFact(pointerAngles(d)); },
     .about = "angles of the laser pointer: horizontal and from the zenith"},
    {.name = "shown.unmeasured",
     .unit = FactUnit::fraction,
     .domain = upTo(1),
     .value = [](const Device& d) { return numberFact(unmeasured(d)); },
     .about = "of the image of the displayed station"},
};

const DeviceRoles kRoles = {
    .rest = kRest,
    .working = kWorking,
    .measuring = kWorking,
    .camera = {phase::imaging},
    .holding = kHolding,
    .kept = phase::downloading,
    .home = "map_view",
    .scans = "map_view",
    .first_questions =
        {
            {.from = {phase::idle},
             .event = "start",
             .guard = "setting.field_of_view == area and area.has_parent == no",
             .ask = "area_needs_parent",
             .source = "S12"},
        },
    .first = phase::calibrating,  // the scan begins later
    .begin = nullptr,
    .marks = {{"G1", rowsOf("power_key")},
              {"S16",
               rowsOf("start start/card_absent start/card_full start/battery_critical start/temperature_question")},
              {"S35", rowsOf("transferred")}},
};

std::vector<Transition> transitions() {
  return withDefaults(
      {
          {.from = {phase::booting}, .event = Event::elapsed, .to = phase::disconnected},
          // The connection of tablet and scanner.
          {.from = kRest, .event = "connect", .guard = "reachable == yes", .to = phase::connecting, .source = "S12"},
          {.from = kRest, .event = "connect", .ask = "no_connection"},
          {.from = {phase::connecting},
           .event = Event::elapsed,
           .guard = "reachable == yes",
           .to = phase::idle,
           .source = "S12"},
          {.from = {phase::connecting}, .event = Event::elapsed, .to = phase::disconnected, .ask = "no_connection"},
          {.from = {phase::idle}, .event = "disconnect", .to = phase::disconnected},
          {.from = {phase::idle},
           .event = Event::wlan_lost,
           .guard = "value.connection == wlan",
           .to = phase::disconnected,
           .ask = "connection_lost",
           .source = "S15"},
          {.from = {phase::scanning, phase::imaging},
           .event = Event::wlan_lost,
           .guard = "value.connection == wlan",
           .ask = "connection_lost"},
          {.from = {phase::downloading},
           .event = Event::wlan_lost,
           .guard = "value.connection == wlan",
           .to = phase::interrupted,
           .ask = "download_interrupted"},
          {.from = {phase::interrupted},
           .event = "resume_download",
           .guard = "reachable == yes",
           .to = phase::downloading},
          {.from = {phase::interrupted}, .event = "resume_download", .ask = "no_connection"},
          // The steps of a capture.
          {.from = {phase::calibrating},
           .event = Event::elapsed,
           .guard = "value.self_levelling == on",
           .to = phase::levelling},
          {.from = {phase::calibrating}, .event = Event::elapsed, .to = phase::scanning, .effect = beginScan},
          {.from = {phase::levelling},
           .event = Event::elapsed,
           .guard = "tilt <= 10",
           .to = phase::scanning,
           .effect = beginScan,
           .source = "G1"},
          {.from = {phase::levelling},
           .event = Event::elapsed,
           .guard = "tilt <= 45",
           .to = phase::not_level,
           .ask = "not_level_question",
           .source = "G1"},
          {.from = {phase::levelling},
           .event = Event::elapsed,
           .to = phase::idle,
           .show = "map_view",
           .ask = "tilt_refused",
           .source = "G1"},
          {.from = {phase::not_level},
           .event = "scan_unlevelled",
           .to = phase::scanning,
           .effect = beginScan,
           .source = "G1"},
          {.from = kBefore, .event = "stop_confirmed", .to = phase::idle, .show = "map_view"},
          {.from = kBefore, .event = Event::tripod_moved, .to = phase::idle, .show = "map_view", .ask = "moved_early"},
          {.from = kBefore, .event = Event::set_down, .to = phase::idle, .show = "map_view", .ask = "moved_early"},
          {.from = {phase::scanning, phase::imaging, phase::calibrating, phase::levelling, phase::not_level,
                    phase::interrupted},
           .event = "stop",
           .ask = "stop_question"},
          {.from = {phase::scanning},
           .event = Event::elapsed,
           .guard = "imaging == yes",
           .to = phase::imaging,
           .source = "G1"},
          {.from = kWorking,
           .event = Event::elapsed,
           .guard = "reachable == yes",
           .to = phase::downloading,
           .source = "S13"},
          {.from = kWorking, .event = Event::elapsed, .to = phase::interrupted, .ask = "download_interrupted"},
          {.from = {phase::downloading},
           .event = Event::elapsed,
           .guard = "data == yes and setting.field_of_view == area",
           .to = phase::idle,
           .show = "station_view",
           .effect = storeArea,
           .source = "S12"},
          {.from = {phase::downloading},
           .event = Event::elapsed,
           .guard = "data == yes and setups > 0 and value.auto_registration == on",
           .to = phase::registering,
           .effect = storeAndRegister,
           .source = "S13"},
          {.from = {phase::downloading},
           .event = Event::elapsed,
           .guard = "data == yes",
           .to = phase::idle,
           .show = "station_view",
           .effect = storeStation,
           .source = "S13"},
          {.from = {phase::downloading, phase::interrupted},
           .event = Event::battery_empty,
           .guard = "data == yes",
           .to = phase::off,
           .effect = storeStation},
          // The limits of the confidence.
          {.from = {phase::registering, phase::idle, phase::disconnected, phase::off},
           .event = Event::linked,
           .effect = judgeLink,
           .source = "S14"},
          {.from = {phase::registering},
           .event = Event::elapsed,
           .guard = "link.judged == yes and registration == registered",
           .to = phase::idle,
           .show = "map_view",
           .source = "S14"},
          {.from = {phase::registering, phase::refining},
           .event = Event::elapsed,
           .guard = "link.judged == yes and registration == check and links.left == 0",
           .to = phase::idle,
           .show = "registration",
           .ask = "check_by_eye",
           .source = "S14"},
          {.from = {phase::registering, phase::refining},
           .event = Event::elapsed,
           .guard = "link.judged == yes and registration == failed and tilt.difference >= 5 and links.left == 0",
           .to = phase::idle,
           .show = "registration",
           .ask = "tilt_difference",
           .source = "S14"},
          {.from = {phase::registering, phase::refining},
           .event = Event::elapsed,
           .guard = "link.judged == yes and registration == failed and links.left == 0",
           .to = phase::idle,
           .show = "registration",
           .ask = "not_registered",
           .source = "S14"},
          {.from = {phase::refining},
           .event = Event::elapsed,
           .guard = "link.judged == yes and registration == registered and links.left == 0",
           .to = phase::idle,
           .show = "registration",
           .source = "S14"},
          {.from = {phase::idle}, .event = "refine", .to = phase::refining, .effect = refineShown, .source = "S14"},
          {.from = kRest, .event = "unlink_confirmed", .effect = forgetLink},
          {.from = {phase::idle}, .event = "refine_all", .to = phase::refining, .effect = refineFirst, .source = "G1"},
          {.from = {phase::refining},
           .event = Event::linked,
           .guard = "links.left > 0",
           .effect = judgeAndRefineNext,
           .source = "G1"},
          {.from = {phase::refining}, .event = Event::linked, .effect = judgeLink, .source = "S14"},
          {.from = {phase::registering, phase::refining},
           .event = Event::failed,
           .to = phase::idle,
           .show = "registration"},
          {.from = {phase::idle},
           .event = "format_confirmed",
           .guard = "card == present",
           .show = "start",
           .effect = formatCard},
      },
      kRoles);
}

}  // namespace

const DeviceProgram& program() {
  static const DeviceProgram all = {
      .transitions = transitions(),
      .actions = {{"propose_new", proposeNew},
                  {"create_new", createNew},
                  {"import_now", importNow},
                  {"choose_mode", chooseMode},
                  {"propose_area", proposeArea},
                  {"take_area", takeArea},
                  {"choose_link", chooseLink},
                  {"choose_pair", choosePair},
                  {"apply_link", applyLink},
                  {"reject_link", rejectLink},
                  {"switch_pointer", switchPointer},
                  {"measure_or_point", measureOrPoint},
                  {"add_annotation", addAnnotation}},
      .facts = kFacts,
      .lists = {{"modes", modeRows},
                {"steps", stepRows},
                {"stations", stationRows},
                {"links", linkRows},
                {"annotations", annotationRows},
                {"errors", errorRows}},
      .events =
          {
              {.name = "annotation", .about = "its text (X7)"},
              {.name = "pointed", .about = "laser pointer aimed (X7)"},
          },
      .laid = [](const Device& d) { return laidCloud(d, linkedSetup(d)); },
      .prepare = prepareScan,
  };
  return all;
}

}  // namespace standpoint::trimble_x7
