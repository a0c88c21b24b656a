// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/trimble/x7.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/units.h"
#include "emulated-ui/device/default_transitions.h"
#include "emulated-ui/device/effects.h"
#include "emulated-ui/trimble/links.h"
#include "emulated-ui/trimble/tablet.h"

namespace standpoint {

namespace {

using namespace trimble;

constexpr const char* kRest = "idle disconnected";
constexpr const char* kBefore = "calibrating levelling not_level";  // nothing is measured yet
constexpr const char* kWorking = "scanning imaging";
constexpr const char* kHolding = "scanning imaging downloading interrupted error";

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
  return setup == nullptr ? 0 : tiltDifference_deg(*setup, *setupBefore(device, *setup));
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
  return setup == nullptr ? "" : setupBefore(device, *setup)->name + " – " + setup->name;
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
    {"connected", FactUnit::none, kYesNo, [](const Device& d) { return yesNo(connected(d)); },
     "the tablet is connected to its scanner"},
    {"reachable", FactUnit::none, kYesNo, [](const Device& d) { return yesNo(reachable(d)); },
     "by cable or a working wireless link"},
    {"start_index.valid", FactUnit::none, kYesNo, [](const Device& d) { return yesNo(startIndexValid(d)); },
     "the entered start index is a whole number from 1 to 999999"},
    {"area.parent", FactUnit::none, kAnyWord,
     [](const Device& d) { return wordFact(parentOfArea(d) == nullptr ? "" : parentOfArea(d)->name); },
     "parent station of an area scan at this place"},
    {"area.has_parent", FactUnit::none, kYesNo, [](const Device& d) { return yesNo(parentOfArea(d) != nullptr); },
     "whether one exists"},
    {"expected.download", FactUnit::seconds, upTo(1e6), [](const Device& d) { return numberFact(downloadSeconds(d)); },
     "from the scanner to the tablet"},
    {"step.progress", FactUnit::fraction, upTo(1), [](const Device& d) { return numberFact(stepProgress(d)); },
     "progress of the current step"},
    {"link.pair", FactUnit::none, kAnyWord, [](const Device& d) { return wordFact(pairOnView(d)); },
     "the two stations of the displayed link"},
    {"pair.error", FactUnit::millimetres, upTo(1e6), ofLink<errorOf>, "RMS of the displayed link"},
    {"pair.overlap", FactUnit::fraction, upTo(1), ofLink<overlapOf>, "of the displayed link"},
    {"consistency", FactUnit::none, upTo(100), ofLink<wholeConsistency>, "percent, from the error"},
    {"confidence", FactUnit::none, upTo(100), ofLink<wholeConfidence>,
     "percent, from consistency and overlap; limits 73 and 91"},
    {"tilt.difference", FactUnit::degrees, upTo(180), [](const Device& d) { return numberFact(differenceOnView(d)); },
     "between the two clouds of the displayed link"},
    {"registration",
     FactUnit::none,
     {{"none", "registered", "check", "failed", "applied", "rejected"}, false, 0, 0},
     [](const Device& d) { return wordFact(stateOnView(d)); },
     "of the displayed link"},
    {"link.judged", FactUnit::none, kYesNo, [](const Device& d) { return yesNo(judgedNow(d)); },
     "the last requested link has a result"},
    {"links.left", FactUnit::none, upTo(1e6), [](const Device& d) { return numberFact(linksLeft(d)); },
     "links still to refine"},
    {"links.worst", FactUnit::millimetres, upTo(1e6), [](const Device& d) { return numberFact(worstLink(d)); },
     "largest error of the project's links"},
    {"stations.registered", FactUnit::none, upTo(1e6),
     [](const Device& d) { return numberFact(registeredStations(d)); }, "stations joined to the first"},
    {"pointer.range", FactUnit::metres, upTo(1e6),
     [](const Device& d) { return numberFact(pointerSpot(d).value_or(Eigen::Vector3d::Zero()).norm()); },
     "distance to the laser-pointer spot; 0: pointer not aimed"},
    {"pointer.angles", FactUnit::none, kAnyWord, [](const Device& d) { return wordFact(pointerAngles(d)); },
     "angles of the laser pointer: horizontal and from the zenith"},
    {"shown.unmeasured", FactUnit::fraction, upTo(1), [](const Device& d) { return numberFact(unmeasured(d)); },
     "of the image of the displayed station"},
};

const DeviceRoles kRoles = {
    .rest = kRest,
    .working = kWorking,
    .measuring = kWorking,
    .camera = "imaging",
    .holding = kHolding,
    .kept = "downloading",
    .home = "map_view",
    .scans = "map_view",
    .first_questions = {{"idle", "start", "setting.field_of_view == area and area.has_parent == no", "", "",
                         "area_needs_parent", nullptr, "S12"}},
    .first = "calibrating",  // the scan begins later
    .marks = {{"G1", "power_key"},
              {"S16", "start start/card_absent start/card_full start/battery_critical start/temperature_question"},
              {"S35", "transferred"}},
};

const DeviceProgram kProgram = {
    "trimble/x7.json",
    withDefaults(
        {
            {"booting", "elapsed", "", "disconnected", "", "", nullptr, "P"},
            // The connection of tablet and scanner.
            {kRest, "connect", "reachable == yes", "connecting", "", "", nullptr, "S12"},
            {kRest, "connect", "", "", "", "no_connection", nullptr, "P"},
            {"connecting", "elapsed", "reachable == yes", "idle", "", "", nullptr, "S12"},
            {"connecting", "elapsed", "", "disconnected", "", "no_connection", nullptr, "P"},
            {"idle", "disconnect", "", "disconnected", "", "", nullptr, "P"},
            {"idle", "wlan_lost", "value.connection == wlan", "disconnected", "", "connection_lost", nullptr, "S15"},
            {"scanning imaging", "wlan_lost", "value.connection == wlan", "", "", "connection_lost", nullptr, "P"},
            {"downloading", "wlan_lost", "value.connection == wlan", "interrupted", "", "download_interrupted", nullptr,
             "P"},
            {"interrupted", "resume_download", "reachable == yes", "downloading", "", "", nullptr, "P"},
            {"interrupted", "resume_download", "", "", "", "no_connection", nullptr, "P"},
            // The steps of a capture.
            {"calibrating", "elapsed", "value.self_levelling == on", "levelling", "", "", nullptr, "P"},
            {"calibrating", "elapsed", "", "scanning", "", "", beginScan, "P"},
            {"levelling", "elapsed", "tilt <= 10", "scanning", "", "", beginScan, "G1"},
            {"levelling", "elapsed", "tilt <= 45", "not_level", "", "not_level_question", nullptr, "G1"},
            {"levelling", "elapsed", "", "idle", "map_view", "tilt_refused", nullptr, "G1"},
            {"not_level", "scan_unlevelled", "", "scanning", "", "", beginScan, "G1"},
            {kBefore, "stop_confirmed", "", "idle", "map_view", "", nullptr, "P"},
            {kBefore, "tripod_moved", "", "idle", "map_view", "moved_early", nullptr, "P"},
            {kBefore, "set_down", "", "idle", "map_view", "moved_early", nullptr, "P"},
            {"scanning imaging calibrating levelling not_level interrupted", "stop", "", "", "", "stop_question",
             nullptr, "P"},
            {"scanning", "elapsed", "imaging == yes", "imaging", "", "", nullptr, "G1"},
            {kWorking, "elapsed", "reachable == yes", "downloading", "", "", nullptr, "S13"},
            {kWorking, "elapsed", "", "interrupted", "", "download_interrupted", nullptr, "P"},
            {"downloading", "elapsed", "data == yes and setting.field_of_view == area", "idle", "station_view", "",
             storeArea, "S12"},
            {"downloading", "elapsed", "data == yes and setups > 0 and value.auto_registration == on", "registering",
             "", "", storeAndRegister, "S13"},
            {"downloading", "elapsed", "data == yes", "idle", "station_view", "", storeStation, "S13"},
            {"downloading interrupted", "battery_empty", "data == yes", "off", "", "", storeStation, "P"},
            // The limits of the confidence.
            {"registering idle disconnected off", "linked", "", "", "", "", judgeLink, "S14"},
            {"registering", "elapsed", "link.judged == yes and registration == registered", "idle", "map_view", "",
             nullptr, "S14"},
            {"registering refining", "elapsed", "link.judged == yes and registration == check and links.left == 0",
             "idle", "registration", "check_by_eye", nullptr, "S14"},
            {"registering refining", "elapsed",
             "link.judged == yes and registration == failed and tilt.difference >= 5 and links.left == 0", "idle",
             "registration", "tilt_difference", nullptr, "S14"},
            {"registering refining", "elapsed", "link.judged == yes and registration == failed and links.left == 0",
             "idle", "registration", "not_registered", nullptr, "S14"},
            {"refining", "elapsed", "link.judged == yes and registration == registered and links.left == 0", "idle",
             "registration", "", nullptr, "S14"},
            {"idle", "refine", "", "refining", "", "", refineShown, "S14"},
            {"idle", "refine_all", "", "refining", "", "", refineFirst, "G1"},
            {"refining", "linked", "links.left > 0", "", "", "", judgeAndRefineNext, "G1"},
            {"refining", "linked", "", "", "", "", judgeLink, "S14"},
            {"registering refining", "failed", "", "idle", "registration", "", nullptr, "P"},
            {"idle", "format_confirmed", "card == present", "", "start", "", formatCard, "P"},
        },
        kRoles),
    {{"propose_new", proposeNew},
     {"create_new", createNew},
     {"import_now", importNow},
     {"choose_mode", chooseMode},
     {"propose_area", proposeArea},
     {"take_area", takeArea},
     {"choose_link", chooseLink},
     {"apply_link", applyLink},
     {"reject_link", rejectLink},
     {"switch_pointer", switchPointer},
     {"measure_or_point", measureOrPoint},
     {"add_annotation", addAnnotation}},
    kFacts,
    {{"modes", modeRows},
     {"steps", stepRows},
     {"stations", stationRows},
     {"links", linkRows},
     {"annotations", annotationRows},
     {"errors", errorRows}},
    prepareScan,
};

}  // namespace

const DeviceProgram& x7Program() { return kProgram; }

}  // namespace standpoint
