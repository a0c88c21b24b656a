// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <fmt/format.h>

#include "emulated-ui/device/default_transitions.h"
#include "emulated-ui/device/device.h"
#include "emulated-ui/device/effects.h"
#include "emulated-ui/device/settings.h"

// Leica BLK360, both generations: one key, a ring of light, and an app on a tablet that may be connected or not. The
// key scans with a stored configuration after a self-timer; what the generations call their states and errors stands in
// facts. Transitions: instrument facts, section 2.3.
namespace standpoint::leica_blk360 {

namespace {

namespace phase {

const PhaseId off{"off"}, starting{"starting"}, ready{"ready"}, connected{"connected"}, standby{"standby"},
    self_timer{"self_timer"}, shooting{"shooting"}, scanning{"scanning"}, finishing{"finishing"}, storing{"storing"},
    error{"error"}, fatal{"fatal"}, formatting{"formatting"}, transferring{"transferring"},
    shutting_down{"shutting_down"};

}  // namespace phase

using Event = EngineEvent;

const Phases kIdle = {phase::ready, phase::connected};
const Phases kMeasuring = {phase::shooting, phase::scanning};
const Phases kBusy = {phase::self_timer, phase::shooting, phase::scanning};
const Phases kHolding = {phase::self_timer, phase::shooting, phase::scanning,
                         phase::finishing,  phase::storing,  phase::error};
constexpr const char* kStandaloneJob = "Standalone";  // where scans without the app go [P]
constexpr double kOperatorGone_s = 5;                 // who presses the key needs so long to get out of sight [P]
constexpr double kFatal_c = 10;                       // beyond the limits: critical [P]

bool isG1(const Device& d) { return d.type().instrument.id == "leica-blk360-g1"; }

std::string standardButton(const Device& d) { return settingsText(resolveSettings(d.type().instrument, {})->values); }
std::string button(const Device& d) {
  const auto stored = d.entry("button");
  return stored.empty() ? standardButton(d) : stored;
}

// --- errors and results, in the words of the generation ---

void fail(Device& d, const char* g1, const char* g2) {
  d.change().entries["error"] = isG1(d) ? g1 : g2;
  d.note("error", d.entry("error"));
}
void storageError(Device& d) { fail(d, "Storage_Exceeded", "StorageNoSpace"); }
void batteryError(Device& d) { fail(d, "Low_Battery", "BatteryCrit"); }
void suddenError(Device& d) {
  d.change().entries.erase("sudden");
  fail(d, "Internal", "SystemSuddenShutdown");
}
void temperatureError(Device& d) {
  const auto& body = d.type().definition.body;
  const double t = d.state().around.temperature_c;
  if (t < body.coldest_c)
    fail(d, "Temp_Low", "WarnLow");
  else if (t > body.hottest_c + kFatal_c)
    fail(d, "Temp_Critical", "CritHigh");
  else
    fail(d, "Temp_High", "ErrHigh");
}

void result(Device& d, const char* capture, const char* data) {
  d.change().entries["capture"] = capture;
  d.change().entries["data"] = data;
}

// What the laser has measured so far is kept by the first generation; the second throws the capture away.
void interrupted(Device& d) {
  if (isG1(d) && d.state().laser_s > 0) {
    keepPartial(d);
    result(d, "Aborted", "Partial");
  } else {
    dropScan(d);
    result(d, "Aborted", "none");
  }
}
void movedError(Device& d) {
  fail(d, "Device_Moved", "DeviceMoved");
  interrupted(d);
  d.change().moved = true;
}
void blockedError(Device& d) {
  fail(d, "Device_Blocked", "MotorizationAzTimeout");
  interrupted(d);
}
void batteryAborts(Device& d) {
  batteryError(d);
  interrupted(d);
}
void temperatureAborts(Device& d) {
  temperatureError(d);
  interrupted(d);
}
void acknowledge(Device& d) { d.change().entries.erase("error"); }
void acknowledgeAndDrop(Device& d) {
  acknowledge(d);
  dropScan(d);
}

// --- the scan ---

void byKey(Device& d) { d.change().entries["by"] = "key"; }
void byApp(Device& d) { d.change().entries["by"] = "app"; }

// The key knows no job: its scans go into one of their own unless the app has a job open.
void useStandaloneJob(Device& d) {
  auto& s = d.change();
  if (d.value("connection") == "OK" && d.project() != nullptr) return;
  const auto found = std::find_if(s.projects.begin(), s.projects.end(),
                                  [](const DeviceProject& p) { return p.name == kStandaloneJob; });
  s.project = static_cast<int>(found - s.projects.begin());
  s.shown = -1;
  if (found == s.projects.end()) s.projects.push_back({.name = kStandaloneJob});
}
void armTimer(Device& d) {
  byKey(d);
  useStandaloneJob(d);
  (void)d.setSettings(settingsFromText(button(d)));
  d.note("standalone", d.entry("button"));
}
void begin(Device& d) {
  result(d, "InProgress", "InProgress");
  beginScan(d);
}
void beginByKey(Device& d) {
  armTimer(d);
  begin(d);
}
void beginByApp(Device& d) {
  byApp(d);
  begin(d);
}

void store(Device& d) {
  const bool tracked = d.value("tracking") == "on" && d.state().around.tracking;
  const bool partial = d.state().running && d.state().running->until_fraction < 1;
  if (d.state().data) d.change().data->tracked = tracked;
  storeScan(d);
  result(d, partial ? "Aborted" : "Completed", partial ? "Partial" : "Complete");
  if (tracked && !isG1(d)) orderLink(d);
  resetTracking(d);
}
void cancelled(Device& d) {
  dropScan(d);
  result(d, "Cancelled", "none");
}
void noScan(Device& d) { result(d, "Aborted", "none"); }

// --- the app ---

void connect(Device& d) { d.change().values["connection"] = "OK"; }
void lose(Device& d) { d.change().values["connection"] = "Lost"; }
void loseTransfer(Device& d) {
  lose(d);
  d.takeBack();
}
void disconnect(Device& d) { d.change().values["connection"] = "Disconnected"; }
void forceDisconnect(Device& d) {
  if (d.value("connection") == "OK") d.change().values["connection"] = "ForceDisconnected";
}
void powerOff(Device& d) {
  forceDisconnect(d);
  acknowledgeAndDrop(d);
}
void emptied(Device& d) {
  forceDisconnect(d);
  if (d.state().running) d.change().entries["sudden"] = "yes";
  dropScan(d);
  d.takeBack();  // a transfer, too
  result(d, "Aborted", "none");
}

Result<void> storeButton(Device& d, const std::string&) {
  d.change().entries["button"] = settingsText(d.state().settings);
  d.change().values["self_timer"] = d.value("timer");
  d.note("button_stored", d.value("timer"));
  return {};
}

Result<void> addTag(Device& d, const std::string&) {
  const auto* setup = d.shownSetup();
  const auto text = d.entry("tag");
  if (setup == nullptr) return failure(ErrorKind::usage, d.word("no_setup"));
  if (text.empty()) return failure(ErrorKind::usage, d.word("tag_empty"));
  const auto at = d.entry("measured_from");
  d.change().values["tag." + d.project()->name + "/" + setup->name + "." + text] = at;
  d.note("tagged", text);
  return {};
}

std::vector<WidgetOption> tagRows(const Device& d) {
  std::vector<WidgetOption> rows;
  const auto* setup = d.shownSetup();
  if (setup == nullptr) return rows;
  const auto stem = "tag." + d.project()->name + "/" + setup->name + ".";
  for (const auto& [id, at] : d.state().values)
    if (id.starts_with(stem))
      rows.push_back({id.substr(stem.size()), id.substr(stem.size()) + (at.empty() ? "" : "  (" + at + ")"), true, {}});
  return rows;
}

std::string accuracyOf(const StoredSetup& s) {
  if (!s.link) return "Unset";
  return s.link->joined && s.link->error_m < 0.01 ? "Accurate" : "Inaccurate";
}

std::vector<WidgetOption> linkRows(const Device& d) {
  std::vector<WidgetOption> rows;
  if (const auto* p = d.project())
    for (std::size_t i = 1; i < p->setups.size(); ++i) {
      const auto& s = p->setups[i];
      const double quality = s.link && s.link->joined ? s.link->overlap * 100 : 0;
      rows.push_back({std::to_string(i),
                      fmt::format("{} – {}  {}  {:.0f} %", p->setups[i - 1].name, s.name, accuracyOf(s), quality),
                      true,
                      {}});
    }
  return rows;
}

// Everything hangs together when each setup but the first has its link.
Result<void> optimise(Device& d, const std::string&) {
  const auto* p = d.project();
  if (p == nullptr || p->setups.size() < 2) return failure(ErrorKind::usage, d.word("link_needs_two"));
  for (std::size_t i = 1; i < p->setups.size(); ++i)
    if (!p->setups[i].link || !p->setups[i].link->joined)
      return failure(ErrorKind::usage, p->setups[i].name + ": " + d.word("link_missing"));
  d.change().entries["bundle"] = p->name;
  d.note("optimised", std::to_string(p->setups.size()));
  return {};
}

Result<void> send(Device& d, const std::string&) {
  if (d.value("server").empty()) return failure(ErrorKind::usage, d.word("no_server"));
  for (const char* id : {"server", "port"})  // the office's listens where the file says
    if (d.value(id) != findValue(d.type().definition, id)->default_value)
      return failure(ErrorKind::usage, d.word("no_answer"));
  if (!d.state().around.wlan) return failure(ErrorKind::usage, d.word("wlan_lost"));
  TransferOrder order{{}, "wlan"};
  for (const auto& p : d.state().projects)
    for (const auto& s : p.setups)
      if (!s.transferred) order.files.push_back(s.file);
  if (order.files.empty()) return failure(ErrorKind::usage, d.word("nothing_to_transfer"));
  d.give(std::move(order));
  return {};
}

// Who presses the key and stays is in the scan. The first generation keeps the way from the setup before in its data.
void prepare(const Device& d, ScanOrder& order) {
  if (isG1(d) && d.value("tracking") == "on" && d.state().around.tracking && d.newestSetup() != nullptr)
    order.notes.emplace_back("way", d.newestSetup()->name);
  if (d.entry("by") == "key" && d.number("value.self_timer") < kOperatorGone_s) order.operator_in_view = true;
}

// --- facts ---

std::string temperatureLevel(const Device& d) {
  const auto& body = d.type().definition.body;
  const double t = d.state().around.temperature_c;
  if (t > body.hottest_c + kFatal_c) return isG1(d) ? "Temp_Critical" : "CritHigh";
  if (t > body.hottest_c) return isG1(d) ? "Temp_High" : "ErrHigh";
  if (t > body.hottest_c - 3) return isG1(d) ? "Ok" : "WarnHigh";
  if (t < body.coldest_c) return isG1(d) ? "Temp_Low" : "WarnLow";
  return "Ok";
}

std::string deviceState(const Device& d) {
  if (d.in({phase::ready, phase::connected, phase::standby})) return "Idle";
  if (d.in(phase::error)) return "Error";
  if (d.in(phase::fatal)) return "FatalError";
  if (d.in(phase::shutting_down)) return "ShuttingDown";
  return d.in(phase::off) ? "Invalid" : "Busy";
}

std::string operation(const Device& d) {
  const bool busy = d.in({phase::self_timer, phase::shooting, phase::scanning, phase::finishing, phase::storing});
  if (d.in(phase::formatting)) return "FormattingStorage";
  if (busy && d.entry("by") == "key") return "Standalone";
  if (d.in(phase::shooting)) return "PanoramaShoot";
  return d.in(phase::scanning) ? "PointCloudScan" : "None";
}

std::string storageState(const Device& d) {
  const double left = d.number("card.scans_left");
  return left < 1 ? "Crit" : left < 5 ? "Low" : "OK";
}

// What the app tells to do about an error.
std::string errorAction(const Device& d) {
  const auto error = d.entry("error");
  if (error.empty()) return "none";
  if (error == "CritHigh" || error == "Temp_Critical") return "Reboot";
  return "Acknowledge";
}

Fact entryFact(const Device& d, const char* id, const char* none) {
  const auto text = d.entry(id);
  return wordFact(text.empty() ? none : text);
}

void addStart(std::vector<Transition>& rows, const EventId& event, DeviceEffect by, const char* mark) {
  const bool by_key = event == "key";
  const auto ask = [&](const char* guard, const char* dialog, const char* source) {
    rows.push_back({.from = kIdle, .event = event, .guard = guard, .ask = dialog, .effect = by, .source = source});
  };
  const auto error = [&](const char* guard, DeviceEffect effect, const PhaseId& to = phase::error) {
    rows.push_back({.from = kIdle, .event = event, .guard = guard, .to = to, .effect = effect, .source = "S10 S11"});
  };
  ask("standing == no", "no_station", "P");
  if (!by_key) ask("project.open == no", "no_project", "P");
  error(by_key ? "button.bytes > @card.free" : "card.free < @expected.bytes", storageError);
  error("battery.state == critical and mains == no", batteryError);
  error("battery.state == low and mains == no and generation == g1", batteryError);
  error("temperature.critical == yes", temperatureError, phase::fatal);
  error("temperature.state != good and generation == g1", temperatureError);
  ask("temperature.state != good", "temperature_question", "S11");
  ask("dust == yes and generation == g2", "dust_question", "S11");
  ask("warm == no", "not_warm_question", "P");
  ask("level == out", "tilt_question", "P");
  ask("nearest < @nearest.least", "near_question", "P");
  if (by_key) {
    rows.push_back({.from = kIdle,
                    .event = event,
                    .guard = "value.self_timer > 0",
                    .to = phase::self_timer,
                    .effect = armTimer,
                    .source = mark});
    rows.push_back({.from = kIdle,
                    .event = event,
                    .guard = "button.imaging == yes",
                    .to = phase::shooting,
                    .effect = beginByKey,
                    .source = mark});
    rows.push_back({.from = kIdle, .event = event, .to = phase::scanning, .effect = beginByKey, .source = mark});
  } else {
    rows.push_back({.from = kIdle,
                    .event = event,
                    .guard = "imaging == yes",
                    .to = phase::shooting,
                    .effect = beginByApp,
                    .source = mark});
    rows.push_back({.from = kIdle, .event = event, .to = phase::scanning, .effect = beginByApp, .source = mark});
  }
}

// Power, start and errors are its own: an error is a phase, and the generations call it by other names.
const DeviceRoles kRoles = {
    .off = std::nullopt,
    .rest = {},
    .idle = {phase::connected},
    .measuring = kMeasuring,
    .laser = {},
    .scans = "setups",
    .targets = std::nullopt,
    .card_needed = std::nullopt,
    .marks = {{"S10", rowsOf("format/format_question")},
              {"S11", rowsOf("battery_low temperature/temperature_warning linked/link_joined linked/link_failed")}},
};

std::vector<Transition> powerAndApp() {
  return {
      {.from = {phase::off},
       .event = "key",
       .guard = "battery.state != critical or mains == yes",
       .to = phase::starting},
      {.from = {phase::starting},
       .event = Event::elapsed,
       .guard = "entry.sudden == yes",
       .to = phase::error,
       .effect = suddenError,
       .source = "S11"},
      {.from = {phase::starting}, .event = Event::elapsed, .to = phase::ready, .source = "G2"},
      {.from = {phase::ready, phase::connected, phase::standby, phase::error, phase::fatal},
       .event = "key_long",
       .to = phase::shutting_down,
       .effect = powerOff,
       .source = "S10"},
      {.from = {phase::shutting_down}, .event = Event::elapsed, .to = phase::off, .source = "S10"},
      {.from = kIdle,
       .event = Event::elapsed,
       .guard = "value.standby == on",
       .to = phase::standby,
       .effect = disconnect,
       .source = "S10"},
      {.from = {phase::standby}, .event = "key", .to = phase::ready, .source = "S10"},
      {.from = {phase::ready},
       .event = "connect",
       .guard = "wlan == yes",
       .to = phase::connected,
       .effect = connect,
       .source = "S10"},
      {.from = {phase::self_timer, phase::shooting, phase::scanning, phase::finishing, phase::storing, phase::error,
                phase::fatal},
       .event = "connect",
       .guard = "wlan == yes",
       .effect = connect,
       .source = "S10"},
      {.from = {kAnyPhase}, .event = "connect", .ask = "wlan_lost", .effect = lose, .source = "S10"},
      {.from = {phase::connected}, .event = "disconnect", .to = phase::ready, .effect = disconnect, .source = "S10"},
      {.from = {phase::connected},
       .event = Event::wlan_lost,
       .to = phase::ready,
       .ask = "wlan_lost",
       .effect = lose,
       .source = "S10"},
      {.from = {phase::transferring},
       .event = Event::wlan_lost,
       .to = phase::ready,
       .ask = "wlan_lost",
       .effect = loseTransfer,
       .source = "S10"},
      {.from = {kAnyPhase},
       .event = Event::wlan_lost,
       .guard = "value.connection == OK",
       .ask = "wlan_lost_scanning",
       .effect = lose,
       .source = "S10"},
  };
}

std::vector<Transition> capture() {
  return {
      {.from = kIdle,
       .event = "start_anyway",
       .guard = "entry.by == key and value.self_timer > 0",
       .to = phase::self_timer,
       .effect = armTimer},
      {.from = kIdle,
       .event = "start_anyway",
       .guard = "entry.by == key and button.imaging == yes",
       .to = phase::shooting,
       .effect = beginByKey},
      {.from = kIdle, .event = "start_anyway", .guard = "entry.by == key", .to = phase::scanning, .effect = beginByKey},
      {.from = kIdle, .event = "start_anyway", .guard = "imaging == yes", .to = phase::shooting, .effect = beginByApp},
      {.from = kIdle, .event = "start_anyway", .to = phase::scanning, .effect = beginByApp},
      {.from = {phase::self_timer},
       .event = Event::elapsed,
       .guard = "imaging == yes",
       .to = phase::shooting,
       .effect = begin,
       .source = "S10"},
      {.from = {phase::self_timer}, .event = Event::elapsed, .to = phase::scanning, .effect = begin, .source = "S10"},
      {.from = {phase::shooting}, .event = Event::elapsed, .to = phase::scanning},
      {.from = {phase::scanning},
       .event = Event::elapsed,
       .guard = "data == yes",
       .to = phase::storing,
       .source = "S10 S11"},
      {.from = {phase::storing},
       .event = Event::elapsed,
       .guard = "value.connection == OK",
       .to = phase::connected,
       .show = "setup",
       .effect = store,
       .source = "S10 S11"},
      {.from = {phase::storing}, .event = Event::elapsed, .to = phase::ready, .effect = store, .source = "S10 S11"},
      {.from = kBusy, .event = "stop", .ask = "stop_question", .source = "S11"},
      {.from = kBusy,
       .event = "stop_confirmed",
       .guard = "value.connection == OK",
       .to = phase::connected,
       .effect = cancelled,
       .source = "S11"},
      {.from = kBusy, .event = "stop_confirmed", .to = phase::ready, .effect = cancelled, .source = "S11"},
      {.from = kBusy,
       .event = "key_long",
       .guard = "value.connection == OK",
       .to = phase::connected,
       .effect = cancelled},
      {.from = kBusy, .event = "key_long", .to = phase::ready, .effect = cancelled},
  };
}

std::vector<Transition> troubles() {
  return {
      {.from = kMeasuring, .event = Event::tripod_moved, .to = phase::error, .effect = movedError, .source = "S10"},
      {.from = {phase::shooting}, .event = Event::set_down, .to = phase::error, .effect = movedError},
      {.from = kMeasuring, .event = Event::blocked, .to = phase::error, .effect = blockedError, .source = "S10"},
      {.from = kMeasuring,
       .event = Event::battery_low,
       .guard = "generation == g1",
       .to = phase::error,
       .effect = batteryAborts,
       .source = "S10"},
      {.from = {phase::ready, phase::connected, phase::self_timer},
       .event = Event::battery_low,
       .guard = "generation == g1",
       .to = phase::error,
       .effect = batteryError,
       .source = "S10"},
      {.from = kMeasuring,
       .event = Event::battery_critical,
       .to = phase::error,
       .effect = batteryAborts,
       .source = "S11"},
      {.from = {phase::ready, phase::connected, phase::self_timer},
       .event = Event::battery_critical,
       .to = phase::error,
       .effect = batteryError,
       .source = "S10 S11"},
      {.from = {kAnyPhase}, .event = Event::battery_empty, .to = phase::off, .effect = emptied, .source = "S11"},
      {.from = kMeasuring,
       .event = Event::temperature,
       .guard = "temperature.critical == yes",
       .to = phase::fatal,
       .effect = temperatureAborts,
       .source = "S10"},
      {.from = kMeasuring,
       .event = Event::temperature,
       .guard = "generation == g1",
       .to = phase::error,
       .effect = temperatureAborts,
       .source = "S10"},
      {.from = {phase::ready, phase::connected, phase::standby, phase::self_timer},
       .event = Event::temperature,
       .guard = "temperature.critical == yes",
       .to = phase::fatal,
       .effect = temperatureError,
       .source = "S10"},
      {.from = {phase::ready, phase::connected, phase::standby, phase::self_timer},
       .event = Event::temperature,
       .guard = "generation == g1",
       .to = phase::error,
       .effect = temperatureError,
       .source = "S10"},
  };
}

std::vector<Transition> errors() {
  return {
      {.from = {phase::error},
       .event = "acknowledge",
       .guard = "partial == yes",
       .to = phase::finishing,
       .effect = acknowledge},
      {.from = {phase::error},
       .event = "acknowledge",
       .guard = "value.connection == OK",
       .to = phase::connected,
       .effect = acknowledgeAndDrop},
      {.from = {phase::error}, .event = "acknowledge", .to = phase::ready, .effect = acknowledgeAndDrop},
      {.from = {phase::error},
       .event = "key",
       .guard = "partial == yes",
       .to = phase::finishing,
       .effect = acknowledge},
      {.from = {phase::error}, .event = "key", .to = phase::ready, .effect = acknowledgeAndDrop},
      {.from = {phase::fatal}, .event = "reboot", .to = phase::starting, .effect = acknowledgeAndDrop, .source = "S11"},
      {.from = {phase::finishing}, .event = Event::elapsed, .guard = "data == yes", .to = phase::storing},
      {.from = kHolding,
       .event = Event::failed,
       .guard = "value.connection == OK",
       .to = phase::connected,
       .effect = noScan},
      {.from = kHolding, .event = Event::failed, .to = phase::ready, .effect = noScan},
  };
}

std::vector<Transition> linksAndFiles() {
  return {
      {.from = kIdle,
       .event = Event::set_down,
       .guard = "value.tracking == on and tracking == yes and setups > 0 and generation == g2",
       .ask = "link_proposed",
       .source = "S11"},
      {.from = kIdle,
       .event = Event::set_down,
       .guard = "setups > 0 and generation == g2",
       .ask = "link_lost",
       .effect = loseTracking,
       .source = "S11"},
      {.from = kIdle,
       .event = Event::tracking_lost,
       .guard = "value.tracking == on and generation == g2",
       .ask = "tracking_lost",
       .source = "S11"},
      {.from = {phase::connected}, .event = "send", .to = phase::transferring, .source = "S11"},
      {.from = {phase::transferring},
       .event = Event::transferred,
       .to = phase::connected,
       .ask = "transferred",
       .source = "S11"},
      {.from = {phase::transferring}, .event = Event::failed, .to = phase::connected},
      {.from = {phase::transferring}, .event = "key_long", .to = phase::ready, .effect = loseTransfer},
      {.from = {phase::connected},
       .event = "format_confirmed",
       .to = phase::formatting,
       .effect = formatCard,
       .source = "S10"},
      {.from = {phase::formatting}, .event = Event::elapsed, .to = phase::connected, .source = "S10"},
  };
}

std::vector<Transition> transitions() {
  auto rows = powerAndApp();
  addStart(rows, "key", byKey, "S10");
  addStart(rows, "start", byApp, "P");
  for (const auto& part : {capture(), troubles(), errors(), linksAndFiles()})
    rows.insert(rows.end(), part.begin(), part.end());
  return withDefaults(std::move(rows), kRoles);
}

const FactDomain kYesNo{{"yes", "no"}};
const FactDomain kNumber{{}, true, 0, 1e16};

ScanSettings buttonSettings(const Device& d) {
  return resolveSettings(d.type().instrument, settingsFromText(button(d))).value_or(ScanSettings{});
}

std::vector<FactRow> facts() {
  return {
      {.name = "generation",
       .domain = {{"g1", "g2"}},
       .value = [](const Device& d) { return wordFact(isG1(d) ? "g1" : "g2"); },
       .about = "of the BLK360"},
      {.name = "device.state",
       .domain = {{"Invalid", "Idle", "Busy", "Error", "FatalError", "ShuttingDown"}},
       .value = [](const Device& d) { return wordFact(deviceState(d)); },
       .about = "name in the manufacturer's programming interface [S10]"},
      {.name = "operation",
       .domain = {{"None", "Standalone", "PanoramaShoot", "PointCloudScan", "FormattingStorage"}},
       .value = [](const Device& d) { return wordFact(operation(d)); },
       .about = "name in the manufacturer's programming interface [S10]"},
      {.name = "data.state",
       .domain = {{"none", "InProgress", "Partial", "Complete"}},
       .value = [](const Device& d) { return entryFact(d, "data", "none"); },
       .about = "of the newest scan [S10]"},
      {.name = "capture",
       .domain = {{"none", "InProgress", "Completed", "Cancelled", "Aborted"}},
       .value = [](const Device& d) { return entryFact(d, "capture", "none"); },
       .about = "of the newest scan [S11]"},
      {.name = "error",
       .value = [](const Device& d) { return entryFact(d, "error", "none"); },
       .about = "displayed error, by the manufacturer's name"},
      {.name = "error.action",
       .domain = {{"none", "Acknowledge", "Reboot", "SoftwareUpdate", "Service"}},
       .value = [](const Device& d) { return wordFact(errorAction(d)); },
       .about = "remedy [S11]"},
      {.name = "temperature.level",
       .domain = {{"Ok", "Temp_Low", "Temp_High", "Temp_Critical", "WarnLow", "WarnHigh", "ErrHigh", "CritHigh"}},
       .value = [](const Device& d) { return wordFact(temperatureLevel(d)); },
       .about = "by the generation's names"},
      {.name = "temperature.critical",
       .domain = kYesNo,
       .value =
           [](const Device& d) {
             return yesNo(d.state().around.temperature_c > d.type().definition.body.hottest_c + kFatal_c);
           },
       .about = "far above the limit"},
      {.name = "storage.state",
       .domain = {{"OK", "Low", "Crit"}},
       .value = [](const Device& d) { return wordFact(storageState(d)); },
       .about = "Crit: the next scan does not fit [S11]"},
      {.name = "partial",
       .domain = kYesNo,
       .value = [](const Device& d) { return yesNo(d.state().running.has_value()); },
       .about = "part of the scan is waiting to be stored"},
      {.name = "vis.accuracy",
       .domain = {{"Unset", "Inaccurate", "Accurate"}},
       .value =
           [](const Device& d) {
             return wordFact(d.newestSetup() == nullptr ? "Unset" : accuracyOf(*d.newestSetup()));
           },
       .about = "of the newest link [S11]"},
      {.name = "vis.quality",
       .unit = FactUnit::fraction,
       .domain = {{}, true, 0, 1},
       .value =
           [](const Device& d) {
             return numberFact(d.newestSetup() != nullptr && d.newestSetup()->link && d.newestSetup()->link->joined
                                   ? d.newestSetup()->link->overlap
                                   : 0);
           },
       .about = "of the newest link [S11]"},
      {.name = "button.bytes",
       .unit = FactUnit::bytes,
       .domain = kNumber,
       .value =
           [](const Device& d) {
             const auto s = buttonSettings(d);
             return numberFact(static_cast<double>(s.columns) * s.rows * d.type().definition.body.bytes_per_point);
           },
       .about = "scan started by the key"},
      {.name = "button.seconds",
       .unit = FactUnit::seconds,
       .domain = kNumber,
       .value =
           [](const Device& d) {
             const auto s = buttonSettings(d);
             return numberFact(s.scan_seconds + s.imaging_seconds);
           },
       .about = "scan started by the key"},
      {.name = "button.imaging",
       .domain = kYesNo,
       .value = [](const Device& d) { return yesNo(buttonSettings(d).imaging); },
       .about = "whether a scan started by the key takes images"},
      {.name = "bundle",
       .domain = kYesNo,
       .value = [](const Device& d) { return yesNo(d.project() != nullptr && d.entry("bundle") == d.project()->name); },
       .about = "whether the links of the job are optimised"},
  };
}

}  // namespace

const DeviceProgram& program() {
  static const DeviceProgram all = {
      .transitions = transitions(),
      .actions = {{"store_button", storeButton}, {"add_tag", addTag}, {"optimise", optimise}, {"send", send}},
      .facts = facts(),
      .lists = {{"tags", tagRows}, {"links", linkRows}},
      .events =
          {
              {.name = "error", .about = "device stopped with an error (BLK360)"},
              {.name = "optimised", .about = "links optimised: number of setups (BLK360)"},
              {.name = "tagged", .about = "its text (BLK360)"},
              {.name = "button_stored", .about = "device button configured (BLK360)"},
              {.name = "standalone", .about = "scan without the tablet (BLK360)"},
          },
      .prepare = prepare,
  };
  return all;
}

}  // namespace standpoint::leica_blk360
