// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "emulated-ui/device/default_transitions.h"
#include "emulated-ui/device/device.h"
#include "emulated-ui/device/effects.h"
#include "emulated-ui/device/settings.h"
#include "emulated-ui/devices/leica-blk360/app.h"
#include "emulated-ui/devices/leica-blk360/phases.h"

// Leica BLK360, both generations: one key, a ring of light, and an app on a tablet that may be connected or not. The
// key scans with a stored configuration after a self-timer; what the generations call their states and errors stands in
// facts. Transitions: instrument facts, section 2.3.
namespace standpoint::leica_blk360 {

namespace {

const Phases kIdle = {phase::ready, phase::connected};
const Phases kMeasuring = {phase::shooting, phase::scanning};
const Phases kBusy = {phase::self_timer, phase::shooting, phase::scanning};
const Phases kHolding = {phase::self_timer, phase::shooting, phase::scanning,
                         phase::finishing,  phase::storing,  phase::error};
constexpr const char* kStandaloneJob = "Standalone";  // where scans without the app go [P]
constexpr double kOperatorGone_s = 5;                 // who presses the key needs so long to get out of sight [P]

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

// Who presses the key and stays is in the scan. The first generation keeps the way from the setup before in its data.
void prepare(const Device& d, ScanOrder& order) {
  if (isG1(d) && d.value("tracking") == "on" && d.state().around.tracking && d.newestSetup() != nullptr)
    order.notes.emplace_back("way", d.newestSetup()->name);
  if (d.entry("by") == "key" && d.number("value.self_timer") < kOperatorGone_s) order.operator_in_view = true;
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
      {.from = {phase::off},
       .event = "key_held",
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
       .event = "key_held",
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
       .event = "key_held",
       .guard = "value.connection == OK",
       .to = phase::connected,
       .effect = cancelled},
      {.from = kBusy, .event = "key_held", .to = phase::ready, .effect = cancelled},
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
      {.from = {phase::transferring}, .event = "key_held", .to = phase::ready, .effect = loseTransfer},
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
