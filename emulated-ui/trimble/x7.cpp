// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/trimble/x7.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "core/units.h"
#include "emulated-ui/device/effects.h"
#include "emulated-ui/device/format.h"
#include "emulated-ui/device/settings.h"
#include "emulated-ui/trimble/links.h"

namespace standpoint {

namespace {

constexpr const char* kRest = "idle disconnected";
constexpr const char* kBefore = "calibrating levelling not_level";   // nothing is measured yet
constexpr const char* kWorking = "scanning imaging";
constexpr const char* kHolding = "scanning imaging downloading interrupted error";
constexpr double kWlan_bytes_per_s = 20e6, kCable_bytes_per_s = 40e6;   // [P]
constexpr double kZenith_deg = 141;          // 282 deg of the vertical turn, from the zenith down [G1]
constexpr double kSurveyGrade_deg = 10;      // what the self-levelling makes up for [G1]
constexpr std::size_t kLatest = 5, kNearest = 3;
constexpr const char* kAnnotation = "annotation.";
const std::array kSteps = {"calibrating", "levelling", "scanning", "imaging", "downloading", "registering"};

std::string entry(const Device& device, const char* id) {
  const auto found = device.state().entries.find(id);
  return found == device.state().entries.end() ? std::string() : found->second;
}

Result<void> shared(Device& device, std::string_view name) {
  for (const auto& action : sharedActions())
    if (name == action.name) return action.act(device, {});
  return failure(ErrorKind::internal, "there is no such action");
}

// --- projects ---

Result<void> proposeNew(Device& device, const std::string&) {
  if (auto ok = shared(device, "propose_project"); !ok) return ok;
  const auto user = device.value("operator");
  device.change().entries["note"] = clockText(device.state().clock_s) + (user.empty() ? "" : ", " + user);
  return {};
}

// An empty name takes the one that is proposed.
Result<void> createNew(Device& device, const std::string&) {
  auto& entries = device.change().entries;
  if (entries["name"].empty()) {
    const auto typed = entries;
    if (auto ok = shared(device, "propose_project"); !ok) return ok;
    entries["first"] = typed.at("first");
    entries["note"] = typed.at("note");
  }
  return shared(device, "create_project");
}

bool startIndexValid(const Device& device) {
  const auto text = entry(device, "first");
  int index = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
  return error == std::errc() && end == text.data() + text.size() && index >= 1 && index <= 999999;
}

// Of the raw scans, those that lie on the scanner's card only: what an interrupted download has left there.
Result<void> importNow(Device& device, const std::string&) {
  if (device.state().phase != "interrupted" || device.value("import_format") != "TZF")
    return failure(ErrorKind::usage, device.word("nothing_to_import"));
  return {};
}

// --- connection ---

bool reachable(const Device& device) { return device.value("connection") == "cable" || device.state().around.wlan; }

bool connected(const Device& device) {
  const auto& phase = device.state().phase;
  return device.on() && phase != "booting" && phase != "disconnected" && phase != "connecting" && phase != "shutting_down" && reachable(device);
}

double downloadSeconds(const Device& device) {
  return device.expectedBytes() / (device.value("connection") == "cable" ? kCable_bytes_per_s : kWlan_bytes_per_s);
}

// --- scan panel ---

std::vector<WidgetOption> modeRows(const Device& device) {
  std::vector<WidgetOption> rows;
  const auto& instrument = device.type().instrument;
  for (const auto& setting : instrument.settings) {
    if (setting.key != "duration") continue;
    for (const auto& choice : setting.choices) {
      const auto mode = resolveSettings(instrument, withSetting(device.state().settings, "duration", choice.value));
      if (!mode) continue;
      const double points = static_cast<double>(mode->columns) * mode->rows;
      const double spacing_mm = (mode->azimuth_to_rad - mode->azimuth_from_rad) / mode->columns * 10000;
      rows.push_back({choice.value,
                      fmt::format("{} | {:.0f} m | {} | {} | {} | {:.1f} mm | {:.0f} k/s", device.shown("setting.mode"), mode->max_range_m, pointsText(points),
                                  bytesText(points * device.type().definition.body.bytes_per_point), clockText(mode->scan_seconds), spacing_mm,
                                  points / mode->scan_seconds / 1000),
                      true, {}});
    }
  }
  return rows;
}

Result<void> chooseMode(Device& device, const std::string& duration) {
  return device.setSettings(withSetting(device.state().settings, "duration", duration));
}

const StoredSetup* parentOfArea(const Device& device) {
  const auto* project = device.project();
  if (project == nullptr) return nullptr;
  for (auto setup = project->setups.rbegin(); setup != project->setups.rend(); ++setup)
    if (setup->station == device.state().around.station) return &*setup;
  return nullptr;
}

// Start and width in degrees, the vertical counted from the zenith [S15].
Result<void> takeArea(Device& device, const std::string&) {
  const auto number = [&](const char* id) { return std::strtod(entry(device, id).c_str(), nullptr); };
  const double start_h = number("start_h"), delta_h = number("delta_h"), start_v = number("start_v"), delta_v = number("delta_v");
  if (start_h >= 360 || !(delta_h > 0 && delta_h <= 360) || !(delta_v > 0 && start_v + delta_v <= kZenith_deg))
    return failure(ErrorKind::usage, device.word("area_wrong"));
  const double end_h = delta_h >= 360 ? start_h : std::fmod(start_h + delta_h, 360);
  auto wanted = withSetting(device.state().settings, "field_of_view", "area");
  wanted = withSetting(wanted, "horizontal_from", fmt::format("{:g}", start_h));
  wanted = withSetting(wanted, "horizontal_to", fmt::format("{:g}", end_h));
  wanted = withSetting(wanted, "vertical_from", fmt::format("{:g}", 90 - start_v - delta_v));
  return device.setSettings(withSetting(wanted, "vertical_to", fmt::format("{:g}", 90 - start_v)));
}

// --- capture ---

bool stepIsOff(const Device& device, std::string_view step) {
  const bool area = device.setting("field_of_view") == "area";
  return (step == "levelling" && device.value("self_levelling") == "off") || (step == "imaging" && !device.expected().imaging) ||
         (step == "registering" && (device.value("auto_registration") == "off" || area));
}

double stepProgress(const Device& device) {
  const double lasts = device.fact("phase.lasts")->number.value_or(0);
  const double share = lasts > 0 ? std::clamp(device.state().elapsed_s / lasts, 0.0, 1.0) : 0;
  const bool simulated = device.state().phase == "scanning" && !device.state().data;
  return simulated ? std::min(share, device.state().engine_share) : share;
}

std::vector<WidgetOption> stepRows(const Device& device) {
  std::vector<WidgetOption> rows;
  bool done = std::find(kSteps.begin(), kSteps.end(), device.state().phase) != kSteps.end();
  for (const char* step : kSteps) {
    const bool now = device.state().phase == step;
    done = done && !now;
    const std::string state = stepIsOff(device, step) ? device.word("off") : now ? fmt::format("{:.0f} %", stepProgress(device) * 100) : done ? "100 %" : "0 %";
    rows.push_back({step, device.word(std::string("phase=") + step) + "  " + state, true, {}});
  }
  return rows;
}

void prepare(const Device& device, ScanOrder& order) {
  order.compensator = device.value("self_levelling") == "on" && device.tilt() <= kSurveyGrade_deg;
  order.name = fmt::format("{} {:03d}", device.setting("field_of_view") == "area" ? "Area" : "Station", order.number);
}

void storeStation(Device& device) {
  storeScan(device);
  if (const auto* newest = device.newestSetup()) device.change().values.erase("registration." + newest->file);
}

void storeAndRegister(Device& device) {
  storeStation(device);
  orderLink(device);
}

// A window of a station stands where that station does.
void storeArea(Device& device) {
  storeStation(device);
  if (const auto* newest = device.newestSetup()) setRegistration(device, *newest, "applied");
}

// --- stations ---

std::vector<WidgetOption> stationRows(const Device& device) {
  std::vector<WidgetOption> rows;
  const auto* project = device.project();
  if (project == nullptr || project->setups.empty()) return rows;
  const auto& setups = project->setups;
  const auto& centre = device.shownSetup() != nullptr ? *device.shownSetup() : setups.back();
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < setups.size(); ++i) order.push_back(i);
  const auto filter = device.value("view_filter");
  if (filter == "latest" && order.size() > kLatest) order.erase(order.begin(), order.end() - kLatest);
  if (filter == "nearest") {
    const auto away = [&](std::size_t i) { return std::hypot(setups[i].plan_x_m - centre.plan_x_m, setups[i].plan_y_m - centre.plan_y_m); };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return away(a) < away(b); });
    order.resize(std::min(order.size(), kNearest));
  }
  for (const auto i : order)
    rows.push_back({std::to_string(i), fmt::format("{}  {}  {}{}", setups[i].name, setups[i].station, device.word("registration=" + registrationOf(device, setups[i])),
                                                   setups[i].moved ? "  !" : setups[i].unlevelled ? "  ∠" : ""), true, {}});
  return rows;
}

Result<void> addAnnotation(Device& device, const std::string&) {
  const auto* setup = device.shownSetup();
  const auto text = entry(device, "annotation");
  if (setup == nullptr || text.empty()) return failure(ErrorKind::usage, device.word("annotation_empty"));
  auto& values = device.change().values;
  for (int n = 1; n < 100; ++n)
    if (values.emplace(fmt::format("{}{}.{:02d}", kAnnotation, setup->file, n), text).second) break;
  device.change().entries["annotation"].clear();
  device.note("annotation", text);
  return {};
}

std::vector<WidgetOption> annotationRows(const Device& device) {
  std::vector<WidgetOption> rows;
  if (const auto* setup = device.shownSetup())
    for (const auto& [id, text] : device.state().values)
      if (id.starts_with(kAnnotation + setup->file + ".")) rows.push_back({id, text, true, {}});
  return rows;
}

double unmeasured(const Device& device) {
  const auto* setup = device.shownSetup();
  if (setup == nullptr || !setup->preview || setup->preview->x_m.empty()) return 0;
  const auto& x = setup->preview->x_m;
  return static_cast<double>(std::count_if(x.begin(), x.end(), [](float v) { return !std::isfinite(v); })) / static_cast<double>(x.size());
}

// Type, level, description [S15].
std::vector<WidgetOption> errorRows(const Device& device) {
  struct Row {
    const char *condition, *wrong_unless, *level, *word;
  };
  static constexpr std::array kRows = {Row{"battery.state", "good", "warning", "battery_low_word"}, Row{"card", "present", "error", "card_missing_word"},
                                       Row{"level", "good", "warning", "tilt_word"}, Row{"temperature.state", "good", "warning", "temperature_word"},
                                       Row{"wlan", "yes", "error", "wlan_lost"}};
  std::vector<WidgetOption> rows;
  for (const auto& row : kRows)
    if (device.fact(row.condition)->text != row.wrong_unless)
      rows.push_back({row.word, fmt::format("{} | {}", device.word(std::string("level=") + row.level), device.word(row.word)), true, {}});
  return rows;
}

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

std::string stateOnView(const Device& device) {
  const auto* setup = linkedSetup(device);
  return setup == nullptr ? "none" : registrationOf(device, *setup);
}

const FactDomain kYesNo{{"yes", "no"}, false, 0, 0};
const FactDomain kAnyWord{};
FactDomain upTo(double most) { return {{}, true, 0, most}; }

const std::vector<FactRow> kFacts = {
    {"connected", FactUnit::none, kYesNo, [](const Device& d) { return yesNo(connected(d)); }, "the tablet has its scanner"},
    {"reachable", FactUnit::none, kYesNo, [](const Device& d) { return yesNo(reachable(d)); }, "cable, or a wireless link that holds"},
    {"start_index.valid", FactUnit::none, kYesNo, [](const Device& d) { return yesNo(startIndexValid(d)); }, "the typed start index is a whole number from 1 to 999999"},
    {"area.parent", FactUnit::none, kAnyWord, [](const Device& d) { return wordFact(parentOfArea(d) == nullptr ? "" : parentOfArea(d)->name); }, "the station of this place to which an area belongs"},
    {"area.has_parent", FactUnit::none, kYesNo, [](const Device& d) { return yesNo(parentOfArea(d) != nullptr); }, "there is one"},
    {"expected.download", FactUnit::seconds, upTo(1e6), [](const Device& d) { return numberFact(downloadSeconds(d)); }, "from the scanner to the tablet"},
    {"step.progress", FactUnit::share, upTo(1), [](const Device& d) { return numberFact(stepProgress(d)); }, "of the step that runs"},
    {"link.pair", FactUnit::none, kAnyWord, [](const Device& d) { return wordFact(pairOnView(d)); }, "the two stations of the link on view"},
    {"pair.error", FactUnit::millimetres, upTo(1e6), ofLink<errorOf>, "r.m.s. of the link on view"},
    {"pair.overlap", FactUnit::share, upTo(1), ofLink<overlapOf>, "of the link on view"},
    {"consistency", FactUnit::none, upTo(100), ofLink<wholeConsistency>, "percent, from the error"},
    {"confidence", FactUnit::none, upTo(100), ofLink<wholeConfidence>, "percent, from consistency and overlap; limits 73 and 91"},
    {"tilt.difference", FactUnit::degrees, upTo(180), [](const Device& d) { return numberFact(differenceOnView(d)); }, "between the two clouds of the link on view"},
    {"registration", FactUnit::none, {{"none", "registered", "check", "failed", "applied", "rejected"}, false, 0, 0}, [](const Device& d) { return wordFact(stateOnView(d)); }, "of the link on view"},
    {"link.judged", FactUnit::none, kYesNo, [](const Device& d) { return yesNo(judgedNow(d)); }, "the link that was ordered last has its result"},
    {"links.left", FactUnit::none, upTo(1e6), [](const Device& d) { return numberFact(linksLeft(d)); }, "still to refine"},
    {"links.worst", FactUnit::millimetres, upTo(1e6), [](const Device& d) { return numberFact(worstLink(d)); }, "largest error of the project's links"},
    {"stations.registered", FactUnit::none, upTo(1e6), [](const Device& d) { return numberFact(registeredStations(d)); }, "joined to the first, which is always"},
    {"shown.unmeasured", FactUnit::share, upTo(1), [](const Device& d) { return numberFact(unmeasured(d)); }, "of the picture of the station on view"},
};

const DeviceProgram kProgram = {
    "trimble/x7.json",
    {
        {"off", "power_key", "battery.state != critical or mains == yes", "booting", "", "", nullptr, "G1"},
        {"booting", "elapsed", "", "disconnected", "", "", nullptr, "P"},
        {kRest, "power_key", "", "", "", "shut_down", nullptr, "P"},
        {kRest, "shut_down", "", "shutting_down", "", "", nullptr, "P"},
        {"shutting_down", "elapsed", "", "off", "", "", nullptr, "P"},
        // The connection of tablet and scanner.
        {kRest, "connect", "reachable == yes", "connecting", "", "", nullptr, "S12"},
        {kRest, "connect", "", "", "", "no_connection", nullptr, "P"},
        {"connecting", "elapsed", "reachable == yes", "idle", "", "", nullptr, "S12"},
        {"connecting", "elapsed", "", "disconnected", "", "no_connection", nullptr, "P"},
        {"idle", "disconnect", "", "disconnected", "", "", nullptr, "P"},
        {"idle", "wlan_lost", "value.connection == wlan", "disconnected", "", "connection_lost", nullptr, "S15"},
        {"scanning imaging", "wlan_lost", "value.connection == wlan", "", "", "connection_lost", nullptr, "P"},
        {"downloading", "wlan_lost", "value.connection == wlan", "interrupted", "", "download_interrupted", nullptr, "P"},
        {"interrupted", "resume_download", "reachable == yes", "downloading", "", "", nullptr, "P"},
        {"interrupted", "resume_download", "", "", "", "no_connection", nullptr, "P"},
        // What the start refuses, then what it asks.
        {"idle", "start", "project.open == no", "", "", "no_project", nullptr, "P"},
        {"idle", "start", "standing == no", "", "", "no_station", nullptr, "P"},
        {"idle", "start", "card == absent", "", "", "card_absent", nullptr, "S16"},
        {"idle", "start", "card == locked", "", "", "card_locked", nullptr, "P"},
        {"idle", "start", "card.free < @expected.bytes", "", "", "card_full", nullptr, "S16"},
        {"idle", "start", "battery.state == critical and mains == no", "", "", "battery_critical", nullptr, "S16"},
        {"idle", "start", "setting.field_of_view == area and area.has_parent == no", "", "", "area_needs_parent", nullptr, "S12"},
        {"idle", "start", "temperature.state != good", "", "", "temperature_question", nullptr, "S16"},
        {"idle", "start", "warm == no", "", "", "not_warm_question", nullptr, "P"},
        {"idle", "start", "nearest < 0.6", "", "", "near_question", nullptr, "P"},
        {"idle", "start", "", "calibrating", "", "", nullptr, "S16"},
        {"idle", "start_anyway", "", "calibrating", "", "", nullptr, "P"},
        {"calibrating", "elapsed", "value.self_levelling == on", "levelling", "", "", nullptr, "P"},
        {"calibrating", "elapsed", "", "scanning", "", "", beginScan, "P"},
        {"levelling", "elapsed", "tilt <= 10", "scanning", "", "", beginScan, "G1"},
        {"levelling", "elapsed", "tilt <= 45", "not_level", "", "not_level_question", nullptr, "G1"},
        {"levelling", "elapsed", "", "idle", "map_view", "tilt_refused", nullptr, "G1"},
        {"not_level", "scan_unlevelled", "", "scanning", "", "", beginScan, "G1"},
        {kBefore, "stop_confirmed", "", "idle", "map_view", "", nullptr, "P"},
        {kBefore, "moved", "", "idle", "map_view", "moved_early", nullptr, "P"},
        {kBefore, "set_down", "", "idle", "map_view", "moved_early", nullptr, "P"},
        {"scanning", "elapsed", "imaging == yes", "imaging", "", "", nullptr, "G1"},
        {kWorking, "elapsed", "reachable == yes", "downloading", "", "", nullptr, "S13"},
        {kWorking, "elapsed", "", "interrupted", "", "download_interrupted", nullptr, "P"},
        {"downloading", "elapsed", "data == yes and setting.field_of_view == area", "idle", "station_view", "", storeArea, "S12"},
        {"downloading", "elapsed", "data == yes and setups > 0 and value.auto_registration == on", "registering", "", "", storeAndRegister, "S13"},
        {"downloading", "elapsed", "data == yes", "idle", "station_view", "", storeStation, "S13"},
        // The limits of the confidence.
        {"registering idle disconnected off", "linked", "", "", "", "", judgeLink, "S14"},
        {"registering", "elapsed", "link.judged == yes and registration == registered", "idle", "map_view", "", nullptr, "S14"},
        {"registering refining", "elapsed", "link.judged == yes and registration == check and links.left == 0", "idle", "registration", "check_by_eye", nullptr, "S14"},
        {"registering refining", "elapsed", "link.judged == yes and registration == failed and tilt.difference >= 5 and links.left == 0", "idle", "registration", "tilt_difference", nullptr, "S14"},
        {"registering refining", "elapsed", "link.judged == yes and registration == failed and links.left == 0", "idle", "registration", "not_registered", nullptr, "S14"},
        {"refining", "elapsed", "link.judged == yes and registration == registered and links.left == 0", "idle", "registration", "", nullptr, "S14"},
        {"idle", "refine", "", "refining", "", "", refineShown, "S14"},
        {"idle", "refine_all", "", "refining", "", "", refineFirst, "G1"},
        {"refining", "linked", "links.left > 0", "", "", "", judgeAndRefineNext, "G1"},
        {"refining", "linked", "", "", "", "", judgeLink, "S14"},
        {"registering refining", "failed", "", "idle", "registration", "", nullptr, "P"},
        // Troubles.
        {"scanning imaging calibrating levelling not_level interrupted", "stop", "", "", "", "stop_question", nullptr, "P"},
        {kHolding, "stop_confirmed", "", "idle", "map_view", "", dropScan, "P"},
        {kWorking, "moved", "", "error", "", "moved", markMoved, "P"},
        {"imaging", "set_down", "", "error", "", "moved", markMoved, "P"},
        {"scanning", "blocked", "", "error", "", "blocked", nullptr, "P"},
        {"error", "keep", "", "downloading", "", "", nullptr, "P"},
        {kHolding, "card_removed", "", "idle", "map_view", "card_lost", dropScan, "P"},
        {kHolding, "failed", "", "idle", "map_view", "", nullptr, "P"},
        {kWorking, "tilted", "", "", "", "tilt_warning", nullptr, "P"},
        {"*", "temperature", "", "", "", "temperature_warning", nullptr, "P"},
        {"*", "battery_low", "", "", "", "battery_low", nullptr, "P"},
        {"*", "battery_critical", "", "", "", "battery_critical", nullptr, "P"},
        {"downloading interrupted", "battery_empty", "data == yes", "off", "", "", storeStation, "P"},
        {"*", "battery_empty", "", "off", "", "", dropScan, "P"},
        {kRest, "targets_measured", "", "", "targets", "", nullptr, "P"},
        {kRest, "transferred", "", "", "", "transferred", nullptr, "S35"},
        {"idle", "delete", "", "", "", "delete_question", nullptr, "P"},
        {"idle", "delete_confirmed", "", "", "map_view", "", deleteShownSetup, "P"},
        {"idle", "format", "", "", "", "format_question", nullptr, "P"},
        {"idle", "format_confirmed", "card == present", "", "start", "", formatCard, "P"},
        {"idle", "format_confirmed", "card == absent", "", "", "card_absent", nullptr, "P"},
        {"idle", "format_confirmed", "", "", "", "card_locked", nullptr, "P"},
    },
    {{"propose_new", proposeNew}, {"create_new", createNew}, {"import_now", importNow}, {"choose_mode", chooseMode}, {"take_area", takeArea},
     {"choose_link", chooseLink}, {"apply_link", applyLink}, {"reject_link", rejectLink}, {"add_annotation", addAnnotation}},
    kFacts,
    {{"modes", modeRows}, {"steps", stepRows}, {"stations", stationRows}, {"links", linkRows}, {"annotations", annotationRows}, {"errors", errorRows}},
    prepare,
};

}  // namespace

const DeviceProgram& x7Program() { return kProgram; }

}  // namespace standpoint
