// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/leica/rtc360.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "emulated-ui/labels.h"
#include "emulated-ui/leica/rtc360_state.h"
#include "project/verb.h"

namespace standpoint {

namespace rtc360 {

namespace {

constexpr double kBoot_s = 20;                 // unsourced; the emulator's choice
constexpr double kStore_s = 2;                 // unsourced; the emulator's choice
constexpr double kBattery_s = 4 * 3600;        // two batteries: instrument facts, section 1.6
constexpr double kBatteryWarning = 0.1;
constexpr double kMemory_bytes = 256e9;        // the USB stick
constexpr double kBytesPerPoint = 26;          // of the E57 that is stored
constexpr std::size_t kLongestName = 40;

std::string clock(double seconds) {
  const auto whole = static_cast<int>(std::ceil(std::max(0.0, seconds)));
  return fmt::format("{}:{:02d}", whole / 60, whole % 60);
}

std::string millions(double points) { return fmt::format("{:.1f} M", points / 1e6); }

class Rtc360 : public Menu {
 public:
  Rtc360(const Instrument& instrument, Labels labels) : instrument_(instrument), label_(std::move(labels)) {
    state_.settings = resolveSettings(instrument_, {})->values;
    state_.memory_free_bytes = kMemory_bytes;
  }

  Screen screen() const override;
  Result<void> act(const std::string& widget, const std::string& value) override;
  void tick(double seconds) override;

  void standAt(const std::string& station) override { state_.station = station; }
  void load(const std::vector<StoredScan>& stored) override;

  std::optional<ScanRequest> takeRequest() override { return std::exchange(request_, std::nullopt); }
  bool takeCancel() override { return std::exchange(cancel_, false); }
  void scanMoved(double share) override { state_.engine_share = share; }
  void scanDone(const StoredScan& stored) override {
    if (state_.phase == Phase::scanning || state_.phase == Phase::photographing) state_.finished = stored;
  }
  void scanFailed(const std::string& message) override;
  bool takeStored() override { return std::exchange(stored_, false); }
  std::optional<StoredScan> takeView() override { return std::exchange(view_, std::nullopt); }
  bool busy() const override { return state_.phase != Phase::off && state_.phase != Phase::ready; }

 private:
  ScanSettings expected() const { return *resolveSettings(instrument_, state_.settings); }
  double expectedPoints() const {
    const auto s = expected();
    return static_cast<double>(s.columns) * s.rows;
  }
  const DeviceJob* openJob() const {
    return state_.job >= 0 && state_.job < static_cast<int>(state_.jobs.size()) ? &state_.jobs[state_.job] : nullptr;
  }
  std::string valueOf(const std::string& setting) const {
    for (const auto& [key, value] : state_.settings)
      if (key == setting) return value;
    return {};
  }
  int nextSetup() const;
  std::string whyNoScan() const;
  double phaseSeconds() const;
  void enter(Phase phase);
  void finishStoring();

  Result<void> press(const std::string& id, const std::string& value);
  Result<void> go(const std::string& screen);
  Result<void> typeName(const std::string& value);
  Result<void> createJob();
  Result<void> openJobRow(const std::string& value);
  Result<void> setups(const std::string& value);
  Result<void> stopScan();
  Result<void> choose(const std::string& id, const std::string& value);
  void startScan();

  void addStatusRow(Screen& s) const;
  void addHome(Screen& s) const;
  void addSettings(Screen& s) const;
  void addJobs(Screen& s) const;
  void addSetups(Screen& s) const;
  void addSetup(Screen& s) const;
  void addScanning(Screen& s) const;
  void addStatus(Screen& s) const;

  Widget widget(const std::string& id, WidgetKind kind, std::string value = {}) const {
    return {id, kind, label_(id), std::move(value), {}, true, {}};
  }
  Widget button(const std::string& id, const std::string& why_not = {}) const {
    Widget w = widget(id, WidgetKind::button);
    w.enabled = why_not.empty();
    w.why_not = why_not;
    return w;
  }

  Instrument instrument_;
  Labels label_;
  State state_;
  std::optional<ScanRequest> request_;
  std::optional<StoredScan> view_;
  bool cancel_ = false;
  bool stored_ = false;
};

int Rtc360::nextSetup() const {
  const auto* job = openJob();
  if (job == nullptr || job->setups.empty()) return 1;
  return 1 + std::max_element(job->setups.begin(), job->setups.end(),
                              [](const StoredScan& a, const StoredScan& b) { return a.setup < b.setup; })->setup;
}

// The guards of the transition idle → scanning.
std::string Rtc360::whyNoScan() const {
  if (openJob() == nullptr) return "Create or open a job first.";
  if (state_.station.empty()) return "The tripod stands nowhere: add a station and choose it.";
  if (!state_.usb_present) return "No USB memory: insert the stick.";
  if (expectedPoints() * kBytesPerPoint > state_.memory_free_bytes) return "The USB memory is too small for this scan.";
  if (state_.battery_share <= 0) return "The battery is empty.";
  return {};
}

double Rtc360::phaseSeconds() const {
  switch (state_.phase) {
    case Phase::booting: return kBoot_s;
    case Phase::scanning: return expected().scan_seconds;
    case Phase::photographing: return expected().imaging_seconds;
    case Phase::storing: return kStore_s;
    default: return 0;
  }
}

void Rtc360::enter(Phase phase) {
  state_.phase = phase;
  state_.elapsed_s = 0;
}

void Rtc360::finishStoring() {
  auto& job = state_.jobs[state_.job];
  job.setups.push_back(*state_.finished);
  state_.memory_free_bytes -= static_cast<double>(state_.finished->points) * kBytesPerPoint;
  state_.setup = static_cast<int>(job.setups.size()) - 1;
  state_.finished.reset();
  stored_ = true;
  state_.screen = "setup";
  enter(Phase::ready);
}

// The instrument's clock and the simulation behind it run side by side: a phase ends when its time is over, and storing
// begins only when the simulation is done, too.
void Rtc360::tick(double seconds) {
  if (state_.phase == Phase::off) return;
  state_.battery_share = std::max(0.0, state_.battery_share - seconds / kBattery_s);
  state_.elapsed_s += seconds;
  while (busy() && state_.elapsed_s >= phaseSeconds()) {
    const double over = state_.elapsed_s - phaseSeconds();
    if (state_.phase == Phase::booting) {
      enter(Phase::ready);
      state_.screen = "home";
    } else if (state_.phase == Phase::scanning && expected().imaging) {
      enter(Phase::photographing);
    } else if (state_.phase == Phase::storing) {
      finishStoring();
    } else if (state_.finished) {
      enter(Phase::storing);
    } else {
      state_.elapsed_s = phaseSeconds();
      return;
    }
    state_.elapsed_s = over;
  }
}

void Rtc360::scanFailed(const std::string& message) {
  if (state_.phase == Phase::ready || state_.phase == Phase::off) return;
  enter(Phase::ready);
  state_.screen = "home";
  state_.stopping = false;
  state_.finished.reset();
  state_.message = label_("scan_failed") + " " + message;
}

void Rtc360::load(const std::vector<StoredScan>& stored) {
  state_.jobs.clear();
  state_.job = -1;
  for (const auto& scan : stored) {
    auto job = std::find_if(state_.jobs.begin(), state_.jobs.end(), [&](const DeviceJob& j) { return j.name == scan.job; });
    if (job == state_.jobs.end()) job = state_.jobs.insert(job, DeviceJob{scan.job, {}});
    job->setups.push_back(scan);
    state_.memory_free_bytes -= static_cast<double>(scan.points) * kBytesPerPoint;
  }
}

void Rtc360::addStatusRow(Screen& s) const {
  Widget battery = widget("battery", WidgetKind::status, fmt::format("{:.0f} %", state_.battery_share * 100));
  if (state_.battery_share < kBatteryWarning) battery.why_not = "Battery low.";
  s.widgets.push_back(std::move(battery));
  s.widgets.push_back(widget("memory", WidgetKind::status,
                             state_.usb_present ? fmt::format("{:.1f} GB", state_.memory_free_bytes / 1e9) : "–"));
}

void Rtc360::addHome(Screen& s) const {
  const auto* job = openJob();
  Widget jobs = widget("job", WidgetKind::button, job == nullptr ? label_("no_job") : job->name);
  s.widgets.push_back(std::move(jobs));
  s.widgets.push_back(widget("next_setup", WidgetKind::readout, std::to_string(nextSetup())));
  s.widgets.push_back(widget("station", WidgetKind::readout, state_.station.empty() ? "–" : state_.station));
  std::vector<std::string> words;
  for (const auto& setting : instrument_.settings)
    if (const auto value = valueOf(setting.key); !setting.choices.empty() && value != "off" && value != "full_dome")
      words.push_back(value == "on" ? label_(setting.key) : value == "target_area" ? label_(value) : value);
  s.widgets.push_back(widget("settings", WidgetKind::button, fmt::format("{}", fmt::join(words, ", "))));
  const auto e = expected();
  s.widgets.push_back(widget("expected_time", WidgetKind::readout, clock(e.scan_seconds + e.imaging_seconds)));
  s.widgets.push_back(widget("expected_points", WidgetKind::readout, millions(expectedPoints())));
  Widget key = widget("scan", WidgetKind::key);
  key.why_not = whyNoScan();  // enabled all the same: the instrument answers with a dialogue
  s.widgets.push_back(std::move(key));
  s.widgets.push_back(button("setups", job == nullptr || job->setups.empty() ? "Nothing is stored in this job yet." : ""));
  s.widgets.push_back(button("status"));
}

void Rtc360::addSettings(Screen& s) const {
  for (const auto& setting : instrument_.settings) {
    const auto value = valueOf(setting.key);
    if (setting.choices.empty() && valueOf("field_of_view") != "target_area") continue;  // limits of the area
    Widget w = widget(setting.key, setting.choices.empty() ? WidgetKind::number : WidgetKind::choice, setting.choices.empty() ? value : "");
    if (w.label == setting.key) w.label = setting.label;
    for (const auto& choice : setting.choices)
      if (choice.value == value) w.value = choice.label;
    for (const auto& choice : setting.choices) w.options.push_back(choice.label);
    s.widgets.push_back(std::move(w));
  }
  const auto e = expected();
  s.widgets.push_back(widget("expected_time", WidgetKind::readout, clock(e.scan_seconds + e.imaging_seconds)));
  s.widgets.push_back(widget("expected_points", WidgetKind::readout,
                             fmt::format("{} ({} × {})", millions(expectedPoints()), e.columns, e.rows)));
  s.widgets.push_back(widget("expected_size", WidgetKind::readout, fmt::format("{:.2f} GB", expectedPoints() * kBytesPerPoint / 1e9)));
  s.widgets.push_back(button("back"));
}

void Rtc360::addJobs(Screen& s) const {
  Widget list = widget("jobs", WidgetKind::list);
  for (const auto& job : state_.jobs) list.options.push_back(fmt::format("{}  ({})", job.name, job.setups.size()));
  s.widgets.push_back(std::move(list));
  s.widgets.push_back(button("new_job"));
  s.widgets.push_back(button("back"));
}

void Rtc360::addSetups(Screen& s) const {
  Widget list = widget("setups", WidgetKind::list);
  for (const auto& setup : openJob()->setups)
    list.options.push_back(fmt::format("{} {}  {}  {}", label_("setup"), setup.setup, setup.station, millions(static_cast<double>(setup.points))));
  s.widgets.push_back(std::move(list));
  s.widgets.push_back(button("back"));
}

void Rtc360::addSetup(Screen& s) const {
  const auto& setup = openJob()->setups[state_.setup];
  s.widgets.push_back(widget("station", WidgetKind::readout, setup.station));
  s.widgets.push_back(widget("points", WidgetKind::readout, fmt::format("{}", setup.points)));
  s.widgets.push_back(widget("time", WidgetKind::readout, clock(setup.instrument_seconds)));
  s.widgets.push_back(widget("file", WidgetKind::readout, setup.file.substr(setup.file.find_last_of('/') + 1)));
  s.widgets.push_back(button("view"));
  s.widgets.push_back(button("back"));
}

void Rtc360::addScanning(Screen& s) const {
  const auto e = expected();
  const double whole = e.scan_seconds + e.imaging_seconds;
  double gone = state_.phase == Phase::storing ? whole : state_.elapsed_s;
  if (state_.phase == Phase::photographing) gone += e.scan_seconds;
  const bool second_pass = state_.phase == Phase::scanning && e.passes == 2 && state_.elapsed_s > e.scan_seconds / 2;
  const char* doing = state_.phase == Phase::photographing ? "photographing" : state_.phase == Phase::storing ? "storing" : second_pass ? "pass_2" : "pass_1";
  s.widgets.push_back({"doing", WidgetKind::readout, label_(doing), "", {}, true, {}});
  // Never further than the simulation is: what the bar shows as done is done.
  const double share = state_.finished ? gone / whole : std::min(gone / whole, state_.engine_share);
  s.widgets.push_back(widget("progress", WidgetKind::progress, fmt::format("{:.0f}", 100 * std::clamp(share, 0.0, 1.0))));
  s.widgets.push_back(widget("remaining", WidgetKind::readout, clock(whole - gone)));
  Widget stop = widget("stop", WidgetKind::key);
  stop.enabled = state_.phase != Phase::storing;
  if (!stop.enabled) stop.why_not = "The scan is being stored.";
  s.widgets.push_back(std::move(stop));
}

void Rtc360::addStatus(Screen& s) const {
  s.widgets.push_back(widget("battery", WidgetKind::readout, fmt::format("{:.0f} %", state_.battery_share * 100)));
  s.widgets.push_back(widget("memory", WidgetKind::readout, fmt::format("{:.1f} of {:.0f} GB", state_.memory_free_bytes / 1e9, kMemory_bytes / 1e9)));
  Widget usb = widget("usb", WidgetKind::choice, state_.usb_present ? "on" : "off");
  usb.options = {"on", "off"};
  s.widgets.push_back(std::move(usb));
  s.widgets.push_back(widget("serial", WidgetKind::readout, "simulated"));
  s.widgets.push_back(button("shut_down"));
  s.widgets.push_back(button("back"));
}

Screen Rtc360::screen() const {
  Screen s{state_.screen, label_(state_.screen), {}};
  if (state_.phase == Phase::off) {
    s.widgets.push_back(widget("power", WidgetKind::key));
    return s;
  }
  addStatusRow(s);
  if (state_.phase == Phase::booting) {
    s.widgets.push_back(widget("progress", WidgetKind::progress, fmt::format("{:.0f}", 100 * std::min(1.0, state_.elapsed_s / kBoot_s))));
    return s;
  }
  if (!state_.message.empty()) {
    s.widgets.push_back({"message", WidgetKind::message, state_.message, "", {}, true, {}});
    s.widgets.push_back(button("ok"));
    return s;
  }
  if (state_.stopping) {
    s.widgets.push_back({"message", WidgetKind::message, label_("stop_question"), "", {}, true, {}});
    s.widgets.push_back(button("yes"));
    s.widgets.push_back(button("no"));
    return s;
  }
  if (state_.screen == "home") addHome(s);
  if (state_.screen == "settings") addSettings(s);
  if (state_.screen == "jobs") addJobs(s);
  if (state_.screen == "setups") addSetups(s);
  if (state_.screen == "setup") addSetup(s);
  if (state_.screen == "scanning") addScanning(s);
  if (state_.screen == "status") addStatus(s);
  if (state_.screen == "new_job") {
    s.widgets.push_back(widget("name", WidgetKind::text, state_.new_name));
    s.widgets.push_back(button("create", state_.new_name.empty() ? "Type a name first." : ""));
    s.widgets.push_back(button("back"));
  }
  if (state_.screen == "setup") s.title = fmt::format("{} {}", label_("setup"), openJob()->setups[state_.setup].setup);
  return s;
}

void Rtc360::startScan() {
  if (const auto why = whyNoScan(); !why.empty()) {
    state_.message = why;
    return;
  }
  request_ = ScanRequest{instrument_.id, openJob()->name, nextSetup(), state_.station, state_.settings};
  state_.engine_share = 0;
  state_.finished.reset();
  state_.screen = "scanning";
  enter(Phase::scanning);
}

// The number of a list's row, or what is wrong with it.
Result<int> rowOf(const std::string& value, std::size_t count) {
  char* end = nullptr;
  const long n = std::strtol(value.c_str(), &end, 10);
  if (value.empty() || *end != 0 || n < 0 || n >= static_cast<long>(count))
    return failure(ErrorKind::usage, fmt::format("there is no row '{}'", value));
  return static_cast<int>(n);
}

Result<void> Rtc360::typeName(const std::string& value) {
  if (value.size() > kLongestName || value.find_first_of("/\\") != std::string::npos)
    return failure(ErrorKind::usage, fmt::format("a name has at most {} letters and no slash", kLongestName), "name");
  state_.new_name = value;
  return {};
}

Result<void> Rtc360::createJob() {
  const auto same = [&](const DeviceJob& job) { return job.name == state_.new_name; };
  if (std::any_of(state_.jobs.begin(), state_.jobs.end(), same)) {
    state_.message = fmt::format("There is a job '{}' already.", state_.new_name);
    return {};
  }
  state_.jobs.push_back({state_.new_name, {}});
  state_.job = static_cast<int>(state_.jobs.size()) - 1;
  state_.screen = "home";
  return {};
}

Result<void> Rtc360::openJobRow(const std::string& value) {
  auto row = rowOf(value, state_.jobs.size());
  if (!row) return failure(row.error());
  state_.job = *row;
  state_.screen = "home";
  return {};
}

Result<void> Rtc360::setups(const std::string& value) {
  if (state_.screen != "setups") {
    state_.screen = "setups";
    return {};
  }
  auto row = rowOf(value, openJob()->setups.size());
  if (!row) return failure(row.error());
  state_.setup = *row;
  state_.screen = "setup";
  return {};
}

// The question was answered with yes: the setup is discarded, whether the simulation behind it is done or not.
Result<void> Rtc360::stopScan() {
  state_.stopping = false;
  cancel_ = true;
  request_.reset();
  state_.finished.reset();
  enter(Phase::ready);
  state_.screen = "home";
  return {};
}

Result<void> Rtc360::choose(const std::string& id, const std::string& value) {
  SettingValues wanted = state_.settings;
  for (const auto& setting : instrument_.settings) {
    if (setting.key != id) continue;
    std::string chosen = value;
    for (const auto& choice : setting.choices)
      if (choice.label == value) chosen = choice.value;
    for (auto& [key, current] : wanted)
      if (key == id) current = chosen;
  }
  auto resolved = resolveSettings(instrument_, wanted);
  if (resolved) state_.settings = resolved->values;
  else state_.message = resolved.error().message;
  return {};
}

Result<void> Rtc360::go(const std::string& screen) {
  state_.screen = screen;
  return {};
}

Result<void> Rtc360::press(const std::string& id, const std::string& value) {
  using Handler = Result<void> (*)(Rtc360&, const std::string&);
  static const std::map<std::string, Handler> handlers = {
      {"power", [](Rtc360& d, const std::string&) { d.enter(Phase::booting); return d.go("booting"); }},
      {"shut_down", [](Rtc360& d, const std::string&) { d.enter(Phase::off); return d.go("off"); }},
      {"ok", [](Rtc360& d, const std::string&) { d.state_.message.clear(); return Result<void>(); }},
      {"yes", [](Rtc360& d, const std::string&) { return d.stopScan(); }},
      {"no", [](Rtc360& d, const std::string&) { d.state_.stopping = false; return Result<void>(); }},
      {"stop", [](Rtc360& d, const std::string&) { d.state_.stopping = true; return Result<void>(); }},
      {"scan", [](Rtc360& d, const std::string&) { d.startScan(); return Result<void>(); }},
      {"job", [](Rtc360& d, const std::string&) { return d.go("jobs"); }},
      {"new_job", [](Rtc360& d, const std::string&) {
         d.state_.new_name = fmt::format("Job {}", d.state_.jobs.size() + 1);
         return d.go("new_job");
       }},
      {"name", [](Rtc360& d, const std::string& text) { return d.typeName(text); }},
      {"create", [](Rtc360& d, const std::string&) { return d.createJob(); }},
      {"jobs", [](Rtc360& d, const std::string& row) { return d.openJobRow(row); }},
      {"setups", [](Rtc360& d, const std::string& row) { return d.setups(row); }},
      {"view", [](Rtc360& d, const std::string&) { d.view_ = d.openJob()->setups[d.state_.setup]; return Result<void>(); }},
      {"usb", [](Rtc360& d, const std::string& state) { d.state_.usb_present = state == "on"; return Result<void>(); }},
      {"settings", [](Rtc360& d, const std::string&) { return d.go("settings"); }},
      {"status", [](Rtc360& d, const std::string&) { return d.go("status"); }},
      {"back", [](Rtc360& d, const std::string&) {
         return d.go(d.state_.screen == "new_job" ? "jobs" : d.state_.screen == "setup" ? "setups" : "home");
       }},
  };
  const auto found = handlers.find(id);
  return found != handlers.end() ? found->second(*this, value) : choose(id, value);
}

Result<void> Rtc360::act(const std::string& id, const std::string& value) {
  const Screen now = screen();
  const Widget* w = findWidget(now, id);
  const bool pressable = w != nullptr && w->kind != WidgetKind::readout && w->kind != WidgetKind::status &&
                         w->kind != WidgetKind::progress && w->kind != WidgetKind::message;
  if (!pressable) return failure(ErrorKind::usage, fmt::format("screen '{}' has no '{}' to press", now.id, id), now.id);
  if (!w->enabled) return failure(ErrorKind::usage, w->why_not, id);
  if (w->kind == WidgetKind::choice && std::find(w->options.begin(), w->options.end(), value) == w->options.end()) {
    // A setting may be named by its value ("12mm") as well as by the label on the screen.
    const auto setting = std::find_if(instrument_.settings.begin(), instrument_.settings.end(), [&](const auto& s) { return s.key == id; });
    const bool by_value = setting != instrument_.settings.end() &&
                          std::any_of(setting->choices.begin(), setting->choices.end(), [&](const auto& c) { return c.value == value; });
    if (!by_value)
      return failure(ErrorKind::usage, fmt::format("'{}' is not one of {}", value, fmt::join(w->options, ", ")), id);
  }
  return press(id, value);
}

}  // namespace

}  // namespace rtc360

Result<std::unique_ptr<Menu>> makeRtc360(const Instrument& instrument) {
  auto labels = Labels::read(dataFolder() / "emulated-ui" / "leica" / "rtc360.json");
  if (!labels) return failure(labels.error());
  if (auto standard = resolveSettings(instrument, {}); !standard) return failure(standard.error());
  return std::make_unique<rtc360::Rtc360>(instrument, *std::move(labels));
}

}  // namespace standpoint
