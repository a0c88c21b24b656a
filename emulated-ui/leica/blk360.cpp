// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/leica/blk360.h"

#include <algorithm>

#include <fmt/format.h>

#include "emulated-ui/device/default_transitions.h"
#include "emulated-ui/device/effects.h"
#include "emulated-ui/device/settings.h"

namespace standpoint {

namespace {

constexpr const char* kIdle = "ready connected";
constexpr const char* kMeasuring = "shooting scanning";
constexpr const char* kBusy = "self_timer shooting scanning";
constexpr const char* kHolding = "self_timer shooting scanning finishing storing error";
constexpr const char* kStandaloneJob = "Standalone";  // where scans without the app go [P]
constexpr double kOperatorGone_s = 5;                 // who presses the key needs so long to get out of sight [P]
constexpr double kFatal_c = 10;                       // beyond the limits: critical [P]

bool isG1(const Device& d) { return d.type().instrument.id == "leica-blk360-g1"; }

std::string entry(const Device& d, const char* id) {
  const auto found = d.state().entries.find(id);
  return found == d.state().entries.end() ? std::string() : found->second;
}

std::string standardButton(const Device& d) { return settingsText(resolveSettings(d.type().instrument, {})->values); }
std::string button(const Device& d) {
  const auto stored = entry(d, "button");
  return stored.empty() ? standardButton(d) : stored;
}

// --- errors and results, in the words of the generation ---

void fail(Device& d, const char* g1, const char* g2) {
  d.change().entries["error"] = isG1(d) ? g1 : g2;
  d.note("error", entry(d, "error"));
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
  d.note("standalone", entry(d, "button"));
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
  const auto text = entry(d, "tag");
  if (setup == nullptr) return failure(ErrorKind::usage, d.word("no_setup"));
  if (text.empty()) return failure(ErrorKind::usage, d.word("tag_empty"));
  const auto at = entry(d, "measured_from");
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
  if (entry(d, "by") == "key" && d.number("value.self_timer") < kOperatorGone_s) order.operator_in_view = true;
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
  const auto& phase = d.state().phase;
  if (phase == "ready" || phase == "connected" || phase == "standby") return "Idle";
  if (phase == "error") return "Error";
  if (phase == "fatal") return "FatalError";
  if (phase == "shutting_down") return "ShuttingDown";
  return phase == "off" ? "Invalid" : "Busy";
}

std::string operation(const Device& d) {
  const auto& phase = d.state().phase;
  const bool busy =
      phase == "self_timer" || phase == "shooting" || phase == "scanning" || phase == "finishing" || phase == "storing";
  if (phase == "formatting") return "FormattingStorage";
  if (busy && entry(d, "by") == "key") return "Standalone";
  if (phase == "shooting") return "PanoramaShoot";
  return phase == "scanning" ? "PointCloudScan" : "None";
}

std::string storageState(const Device& d) {
  const double left = d.number("card.scans_left");
  return left < 1 ? "Crit" : left < 5 ? "Low" : "OK";
}

// What the app tells to do about an error.
std::string errorAction(const Device& d) {
  const auto error = entry(d, "error");
  if (error.empty()) return "none";
  if (error == "CritHigh" || error == "Temp_Critical") return "Reboot";
  return "Acknowledge";
}

Fact entryFact(const Device& d, const char* id, const char* none) {
  const auto text = entry(d, id);
  return wordFact(text.empty() ? none : text);
}

void addStart(std::vector<Transition>& rows, const char* event, void (*by)(Device&), const char* mark) {
  const auto ask = [&](const char* guard, const char* dialog, const char* source) {
    rows.push_back({kIdle, event, guard, "", "", dialog, by, source});
  };
  const auto error = [&](const char* guard, void (*effect)(Device&), const char* phase = "error") {
    rows.push_back({kIdle, event, guard, phase, "", "", effect, "S10 S11"});
  };
  ask("standing == no", "no_station", "P");
  if (std::string(event) == "start") ask("project.open == no", "no_project", "P");
  error(std::string(event) == "key" ? "button.bytes > @card.free" : "card.free < @expected.bytes", storageError);
  error("battery.state == critical and mains == no", batteryError);
  error("battery.state == low and mains == no and generation == g1", batteryError);
  error("temperature.critical == yes", temperatureError, "fatal");
  error("temperature.state != good and generation == g1", temperatureError);
  ask("temperature.state != good", "temperature_question", "S11");
  ask("dust == yes and generation == g2", "dust_question", "S11");
  ask("warm == no", "not_warm_question", "P");
  ask("level == out", "tilt_question", "P");
  ask("nearest < @nearest.least", "near_question", "P");
  if (std::string(event) == "key") {
    rows.push_back({kIdle, event, "value.self_timer > 0", "self_timer", "", "", armTimer, mark});
    rows.push_back({kIdle, event, "button.imaging == yes", "shooting", "", "", beginByKey, mark});
    rows.push_back({kIdle, event, "", "scanning", "", "", beginByKey, mark});
  } else {
    rows.push_back({kIdle, event, "imaging == yes", "shooting", "", "", beginByApp, mark});
    rows.push_back({kIdle, event, "", "scanning", "", "", beginByApp, mark});
  }
}

// Power, start and errors are its own: an error is a phase, and the generations call it by other names.
const DeviceRoles kRoles = {
    .off = nullptr,
    .rest = nullptr,
    .idle = "connected",
    .measuring = kMeasuring,
    .laser = nullptr,
    .scans = "setups",
    .targets = nullptr,
    .card_needed = nullptr,
    .marks = {{"S10", "format/format_question"},
              {"S11", "battery_low temperature/temperature_warning linked/link_joined linked/link_failed"}},
};

std::vector<Transition> transitions() {
  std::vector<Transition> rows = {
      {"off", "key", "battery.state != critical or mains == yes", "starting", "", "", nullptr, "P"},
      {"starting", "elapsed", "entry.sudden == yes", "error", "", "", suddenError, "S11"},
      {"starting", "elapsed", "", "ready", "", "", nullptr, "G2"},
      {"ready connected standby error fatal", "key_long", "", "shutting_down", "", "", powerOff, "S10"},
      {"shutting_down", "elapsed", "", "off", "", "", nullptr, "S10"},
      {kIdle, "elapsed", "value.standby == on", "standby", "", "", disconnect, "S10"},
      {"standby", "key", "", "ready", "", "", nullptr, "S10"},
      {"ready", "connect", "wlan == yes", "connected", "", "", connect, "S10"},
      {"self_timer shooting scanning finishing storing error fatal", "connect", "wlan == yes", "", "", "", connect,
       "S10"},
      {"*", "connect", "", "", "", "wlan_lost", lose, "S10"},
      {"connected", "disconnect", "", "ready", "", "", disconnect, "S10"},
      {"connected", "wlan_lost", "", "ready", "", "wlan_lost", lose, "S10"},
      {"transferring", "wlan_lost", "", "ready", "", "wlan_lost", loseTransfer, "S10"},
      {"*", "wlan_lost", "value.connection == OK", "", "", "wlan_lost_scanning", lose, "S10"},
  };
  addStart(rows, "key", byKey, "S10");
  addStart(rows, "start", byApp, "P");
  const std::vector<Transition> more = {
      {kIdle, "start_anyway", "entry.by == key and value.self_timer > 0", "self_timer", "", "", armTimer, "P"},
      {kIdle, "start_anyway", "entry.by == key and button.imaging == yes", "shooting", "", "", beginByKey, "P"},
      {kIdle, "start_anyway", "entry.by == key", "scanning", "", "", beginByKey, "P"},
      {kIdle, "start_anyway", "imaging == yes", "shooting", "", "", beginByApp, "P"},
      {kIdle, "start_anyway", "", "scanning", "", "", beginByApp, "P"},
      {"self_timer", "elapsed", "imaging == yes", "shooting", "", "", begin, "S10"},
      {"self_timer", "elapsed", "", "scanning", "", "", begin, "S10"},
      {"shooting", "elapsed", "", "scanning", "", "", nullptr, "P"},
      {"scanning", "elapsed", "data == yes", "storing", "", "", nullptr, "S10 S11"},
      {"storing", "elapsed", "value.connection == OK", "connected", "setup", "", store, "S10 S11"},
      {"storing", "elapsed", "", "ready", "", "", store, "S10 S11"},
      {kBusy, "stop", "", "", "", "stop_question", nullptr, "S11"},
      {kBusy, "stop_confirmed", "value.connection == OK", "connected", "", "", cancelled, "S11"},
      {kBusy, "stop_confirmed", "", "ready", "", "", cancelled, "S11"},
      {kBusy, "key_long", "value.connection == OK", "connected", "", "", cancelled, "P"},
      {kBusy, "key_long", "", "ready", "", "", cancelled, "P"},
      {kMeasuring, "tripod_moved", "", "error", "", "", movedError, "S10"},
      {"shooting", "set_down", "", "error", "", "", movedError, "P"},
      {kMeasuring, "blocked", "", "error", "", "", blockedError, "S10"},
      {kMeasuring, "battery_low", "generation == g1", "error", "", "", batteryAborts, "S10"},
      {"ready connected self_timer", "battery_low", "generation == g1", "error", "", "", batteryError, "S10"},
      {kMeasuring, "battery_critical", "", "error", "", "", batteryAborts, "S11"},
      {"ready connected self_timer", "battery_critical", "", "error", "", "", batteryError, "S10 S11"},
      {"*", "battery_empty", "", "off", "", "", emptied, "S11"},
      {kMeasuring, "temperature", "temperature.critical == yes", "fatal", "", "", temperatureAborts, "S10"},
      {kMeasuring, "temperature", "generation == g1", "error", "", "", temperatureAborts, "S10"},
      {"ready connected standby self_timer", "temperature", "temperature.critical == yes", "fatal", "", "",
       temperatureError, "S10"},
      {"ready connected standby self_timer", "temperature", "generation == g1", "error", "", "", temperatureError,
       "S10"},
      {"error", "acknowledge", "partial == yes", "finishing", "", "", acknowledge, "P"},
      {"error", "acknowledge", "value.connection == OK", "connected", "", "", acknowledgeAndDrop, "P"},
      {"error", "acknowledge", "", "ready", "", "", acknowledgeAndDrop, "P"},
      {"error", "key", "partial == yes", "finishing", "", "", acknowledge, "P"},
      {"error", "key", "", "ready", "", "", acknowledgeAndDrop, "P"},
      {"fatal", "reboot", "", "starting", "", "", acknowledgeAndDrop, "S11"},
      {"finishing", "elapsed", "data == yes", "storing", "", "", nullptr, "P"},
      {kHolding, "failed", "value.connection == OK", "connected", "", "", noScan, "P"},
      {kHolding, "failed", "", "ready", "", "", noScan, "P"},
      {kIdle, "set_down", "value.tracking == on and tracking == yes and setups > 0 and generation == g2", "", "",
       "link_proposed", nullptr, "S11"},
      {kIdle, "set_down", "setups > 0 and generation == g2", "", "", "link_lost", loseTracking, "S11"},
      {kIdle, "tracking_lost", "value.tracking == on and generation == g2", "", "", "tracking_lost", nullptr, "S11"},
      {"connected", "send", "", "transferring", "", "", nullptr, "S11"},
      {"transferring", "transferred", "", "connected", "", "transferred", nullptr, "S11"},
      {"transferring", "failed", "", "connected", "", "", nullptr, "P"},
      {"transferring", "key_long", "", "ready", "", "", loseTransfer, "P"},
      {"connected", "format_confirmed", "", "formatting", "", "", formatCard, "S10"},
      {"formatting", "elapsed", "", "connected", "", "", nullptr, "S10"},
  };
  rows.insert(rows.end(), more.begin(), more.end());
  return withDefaults(std::move(rows), kRoles);
}

const FactDomain kYesNo{{"yes", "no"}};
const FactDomain kNumber{{}, true, 0, 1e16};

ScanSettings buttonSettings(const Device& d) {
  return resolveSettings(d.type().instrument, settingsFromText(button(d))).value_or(ScanSettings{});
}

const DeviceProgram kProgram = {
    "leica/blk360.json",
    transitions(),
    {{"store_button", storeButton}, {"add_tag", addTag}, {"optimise", optimise}, {"send", send}},
    {{"generation",
      FactUnit::none,
      {{"g1", "g2"}},
      [](const Device& d) { return wordFact(isG1(d) ? "g1" : "g2"); },
      "of the BLK360"},
     {"device.state",
      FactUnit::none,
      {{"Invalid", "Idle", "Busy", "Error", "FatalError", "ShuttingDown"}},
      [](const Device& d) { return wordFact(deviceState(d)); },
      "name in the manufacturer's programming interface [S10]"},
     {"operation",
      FactUnit::none,
      {{"None", "Standalone", "PanoramaShoot", "PointCloudScan", "FormattingStorage"}},
      [](const Device& d) { return wordFact(operation(d)); },
      "name in the manufacturer's programming interface [S10]"},
     {"data.state",
      FactUnit::none,
      {{"none", "InProgress", "Partial", "Complete"}},
      [](const Device& d) { return entryFact(d, "data", "none"); },
      "of the newest scan [S10]"},
     {"capture",
      FactUnit::none,
      {{"none", "InProgress", "Completed", "Cancelled", "Aborted"}},
      [](const Device& d) { return entryFact(d, "capture", "none"); },
      "of the newest scan [S11]"},
     {"error",
      FactUnit::none,
      {},
      [](const Device& d) { return entryFact(d, "error", "none"); },
      "displayed error, by the manufacturer's name"},
     {"error.action",
      FactUnit::none,
      {{"none", "Acknowledge", "Reboot", "SoftwareUpdate", "Service"}},
      [](const Device& d) { return wordFact(errorAction(d)); },
      "remedy [S11]"},
     {"temperature.level",
      FactUnit::none,
      {{"Ok", "Temp_Low", "Temp_High", "Temp_Critical", "WarnLow", "WarnHigh", "ErrHigh", "CritHigh"}},
      [](const Device& d) { return wordFact(temperatureLevel(d)); },
      "by the generation's names"},
     {"temperature.critical", FactUnit::none, kYesNo,
      [](const Device& d) {
        return yesNo(d.state().around.temperature_c > d.type().definition.body.hottest_c + kFatal_c);
      },
      "far above the limit"},
     {"storage.state",
      FactUnit::none,
      {{"OK", "Low", "Crit"}},
      [](const Device& d) { return wordFact(storageState(d)); },
      "Crit: the next scan does not fit [S11]"},
     {"partial", FactUnit::none, kYesNo, [](const Device& d) { return yesNo(d.state().running.has_value()); },
      "part of the scan is waiting to be stored"},
     {"vis.accuracy",
      FactUnit::none,
      {{"Unset", "Inaccurate", "Accurate"}},
      [](const Device& d) { return wordFact(d.newestSetup() == nullptr ? "Unset" : accuracyOf(*d.newestSetup())); },
      "of the newest link [S11]"},
     {"vis.quality",
      FactUnit::fraction,
      {{}, true, 0, 1},
      [](const Device& d) {
        return numberFact(d.newestSetup() != nullptr && d.newestSetup()->link && d.newestSetup()->link->joined
                              ? d.newestSetup()->link->overlap
                              : 0);
      },
      "of the newest link [S11]"},
     {"button.bytes", FactUnit::bytes, kNumber,
      [](const Device& d) {
        const auto s = buttonSettings(d);
        return numberFact(static_cast<double>(s.columns) * s.rows * d.type().definition.body.bytes_per_point);
      },
      "scan started by the key"},
     {"button.seconds", FactUnit::seconds, kNumber,
      [](const Device& d) {
        const auto s = buttonSettings(d);
        return numberFact(s.scan_seconds + s.imaging_seconds);
      },
      "scan started by the key"},
     {"button.imaging", FactUnit::none, kYesNo, [](const Device& d) { return yesNo(buttonSettings(d).imaging); },
      "whether a scan started by the key takes images"},
     {"bundle", FactUnit::none, kYesNo,
      [](const Device& d) { return yesNo(d.project() != nullptr && entry(d, "bundle") == d.project()->name); },
      "whether the links of the job are optimised"}},
    {{"tags", tagRows}, {"links", linkRows}},
    prepare,
};

}  // namespace

const DeviceProgram& blk360Program() { return kProgram; }

}  // namespace standpoint
