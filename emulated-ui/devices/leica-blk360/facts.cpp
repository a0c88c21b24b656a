// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/settings.h"
#include "emulated-ui/devices/leica-blk360/app.h"
#include "emulated-ui/devices/leica-blk360/phases.h"

namespace standpoint::leica_blk360 {

namespace {

const FactDomain kYesNo{{"yes", "no"}};
const FactDomain kNumber{{}, true, 0, 1e16};

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

ScanSettings buttonSettings(const Device& d) {
  return resolveSettings(d.type().instrument, settingsFromText(button(d))).value_or(ScanSettings{});
}

}  // namespace

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

}  // namespace standpoint::leica_blk360
