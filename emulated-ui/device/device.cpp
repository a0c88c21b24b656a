// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/device.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "core/units.h"
#include "emulated-ui/device/numbers.h"

namespace standpoint {

namespace {

constexpr std::size_t kLongestLog = 20000;
constexpr double kAsleepDrain = 0.5;  // [P] what a device uses while its display is dark

using Event = EngineEvent;

bool namesPhase(const Phases& from, const std::string& phase, bool on) {
  return std::any_of(from.begin(), from.end(),
                     [&](const PhaseId& id) { return id.name == phase || (on && id == kAnyPhase); });
}

// The file's own come first, then the code's; behind them, if the file says what they are called on this device, those
// that all devices share, but for events that nothing on it sends.
std::vector<Transition> allTransitions(const DeviceDefinition& definition, const DeviceProgram& program) {
  auto all = definition.transitions;
  all.insert(all.end(), program.transitions.begin(), program.transitions.end());
  if (!definition.roles) return all;
  const auto own = static_cast<std::ptrdiff_t>(all.size());
  const auto sent = eventsSent(definition);
  all = withDefaults(std::move(all), *definition.roles);
  const auto unsent = [&](const Transition& t) { return !t.event.isOfEngine() && !sent.contains(t.event.name); };
  all.erase(std::remove_if(all.begin() + own, all.end(), unsent), all.end());
  return all;
}

// A widget of the setting "*" stands for all settings of the scanner: what a device for any scanner has.
void spellOutSettings(std::vector<WidgetRow>& widgets, const Instrument& instrument) {
  const auto star = std::find_if(widgets.begin(), widgets.end(), [](const WidgetRow& w) { return w.setting == "*"; });
  if (star == widgets.end()) return;
  const WidgetRow pattern = *star;
  std::vector<WidgetRow> rows;
  for (const auto& setting : instrument.settings) {
    WidgetRow row = pattern;
    row.setting = setting.key;
    row.id = row.words = "setting." + setting.key;  // so that no key is taken for another widget
    row.kind = setting.choices.empty() ? WidgetKind::number : WidgetKind::choice;
    rows.push_back(std::move(row));
  }
  widgets.insert(widgets.erase(star), rows.begin(), rows.end());
}

Result<ScanSettings> settingsOf(const Instrument& instrument, const SettingValues& values) {
  return instrument.moving ? resolveMovingSettings(instrument, values) : resolveSettings(instrument, values);
}

// The device speaks every language that there are words in.
void offerLanguages(std::vector<ValueRow>& values, const Words& words) {
  for (auto& value : values)
    if (value.id == "language")
      for (const auto& language : words.languages())
        if (std::find(value.choices.begin(), value.choices.end(), language) == value.choices.end())
          value.choices.push_back(language);
}

}  // namespace

Result<std::shared_ptr<const DeviceType>> makeDeviceType(DeviceDefinition definition, const DeviceProgram& program,
                                                         Instrument instrument, std::shared_ptr<const Words> words) {
  const auto& drives = definition.instruments;
  const bool any = std::find(drives.begin(), drives.end(), "*") != drives.end();
  if (!any && std::find(drives.begin(), drives.end(), instrument.id) == drives.end())
    return failure(ErrorKind::usage, fmt::format("drives {}, not '{}'", fmt::join(drives, ", "), instrument.id),
                   definition.id);
  if (instrument.moving && any)
    return failure(ErrorKind::usage, "the device needs a tripod, but this instrument is mobile", instrument.id);
  if (auto default_value = settingsOf(instrument, {}); !default_value) return failure(default_value.error());
  for (auto& screen : definition.screens) spellOutSettings(screen.widgets, instrument);
  offerLanguages(definition.values, *words);
  auto type = std::make_shared<DeviceType>();
  type->definition = std::move(definition);
  type->program = program;
  type->program.transitions = allTransitions(type->definition, program);
  type->instrument = std::move(instrument);
  type->words = std::move(words);
  for (const auto& transition : type->program.transitions) {
    auto guard = Condition::parse(transition.guard);
    if (!guard)
      return failure(ErrorKind::internal, guard.error().message,
                     type->definition.id + " transition " + transition.event.name);
    type->guards.push_back(*std::move(guard));
  }
  return type;
}

Device::Device(std::shared_ptr<const DeviceType> type) : type_(std::move(type)) {
  const auto& d = type_->definition;
  state_.phase = d.phases.front().id;
  state_.screen = d.phases.front().screen;
  state_.around.card_bytes = d.body.card_bytes;
  for (const auto& value : d.values) state_.values[value.id] = value.default_value;
  expected_ = *settingsOf(type_->instrument, {});
  state_.settings = expected_.values;
}

bool Device::on() const {
  const auto* phase = findPhase(type_->definition, state_.phase);
  return phase != nullptr && phase->on;
}

bool Device::busy() const {
  const auto* phase = findPhase(type_->definition, state_.phase);
  return order_.has_value() || !state_.walk.legs.empty() || (phase != nullptr && phase->ends() && !phase->waits);
}

bool Device::idles() const {
  const auto* phase = findPhase(type_->definition, state_.phase);
  return phase->waits || (phase->ends() ? leftOfPhase().value_or(0) < 1e-9 : !state_.running);
}

bool Device::asleep() const {
  const auto& body = type_->definition.body;
  const auto found = body.sleeps_after_min.find(value(body.sleeps_by));
  return on() && found != body.sleeps_after_min.end() && state_.untouched_s >= 60 * found->second;
}

std::string Device::value(const std::string& id) const {
  const auto found = state_.values.find(id);
  return found == state_.values.end() ? std::string() : found->second;
}

std::string Device::entry(const std::string& id) const {
  const auto found = state_.entries.find(id);
  return found == state_.entries.end() ? std::string() : found->second;
}

std::string Device::setting(const std::string& key) const {
  for (const auto& [name, value] : state_.settings)
    if (name == key) return value;
  return {};
}

Result<void> Device::setSettings(const SettingValues& wanted) {
  TRY_ASSIGN(auto resolved, settingsOf(type_->instrument, wanted));
  expected_ = std::move(resolved);
  state_.settings = expected_.values;
  return {};
}

const DeviceProject* Device::project() const {
  const auto at = static_cast<std::size_t>(state_.project);
  return state_.project >= 0 && at < state_.projects.size() ? &state_.projects[at] : nullptr;
}
DeviceProject* Device::project() { return const_cast<DeviceProject*>(std::as_const(*this).project()); }

const StoredSetup* Device::shownSetup() const {
  const auto* open = project();
  const auto at = static_cast<std::size_t>(state_.shown);
  return open != nullptr && state_.shown >= 0 && at < open->setups.size() ? &open->setups[at] : nullptr;
}
StoredSetup* Device::shownSetup() { return const_cast<StoredSetup*>(std::as_const(*this).shownSetup()); }

const StoredSetup* Device::newestSetup() const {
  const auto* open = project();
  return open == nullptr || open->setups.empty() ? nullptr : &open->setups.back();
}
StoredSetup* Device::newestSetup() { return const_cast<StoredSetup*>(std::as_const(*this).newestSetup()); }

double Device::expectedBytes() const {
  if (!expected_.laser) return 0;
  return static_cast<double>(expected_.columns) * expected_.rows * type_->definition.body.bytes_per_point;
}

double Device::entryNumber(const std::string& id) const { return numberIn(entry(id)).value_or(0); }

bool Device::levelled() const {
  const auto& definition = type_->definition;
  return definition.scan.levelled.empty() ? tilt() <= definition.body.tilt_limit_deg
                                          : definition.scan.levelled.holds(facts());
}

double Device::levelledRange() const {
  const auto& compensator = type_->instrument.compensator;
  const double range = compensator ? compensator->range_rad / kRadPerDeg : 0;
  return range > 0 ? range : type_->definition.body.tilt_limit_deg;
}

double Device::tilt() const {
  return std::acos(std::clamp(
             std::cos(state_.around.tilt_x_deg * kRadPerDeg) * std::cos(state_.around.tilt_y_deg * kRadPerDeg), -1.0,
             1.0)) /
         kRadPerDeg;
}

void Device::note(const std::string& what, const std::string& detail) {
  ++state_.noted;
  if (state_.log.size() < kLongestLog) state_.log.push_back({state_.clock_s, what, detail});
}

// --- the state machine ---

bool EventId::isOfEngine() const {
  return std::find(std::begin(kEngineEventNames), std::end(kEngineEventNames), name) != std::end(kEngineEventNames);
}

bool Device::in(const Phases& phases) const {
  return std::any_of(phases.begin(), phases.end(), [&](const PhaseId& phase) { return in(phase); });
}

bool Device::can(const EventId& event) const {
  const auto& transitions = type_->program.transitions;
  for (std::size_t i = 0; i < transitions.size(); ++i)
    if (event == transitions[i].event && namesPhase(transitions[i].from, state_.phase, on()) &&
        type_->guards[i].holds(facts()))
      return true;
  return false;
}

bool Device::fire(const EventId& event) {
  const auto& transitions = type_->program.transitions;
  for (std::size_t i = 0; i < transitions.size(); ++i) {
    const Transition& t = transitions[i];
    if (event != t.event || !namesPhase(t.from, state_.phase, on()) || !type_->guards[i].holds(facts())) continue;
    if (event != Event::elapsed) note("event", event.name);
    if (!t.to.name.empty()) enter(*findPhase(type_->definition, t.to.name));
    if (t.effect != nullptr) t.effect(*this);
    if (!t.show.empty()) show(t.show);
    if (!t.ask.empty()) ask(t.ask, state_.dialog_detail);
    return true;
  }
  return false;
}

void Device::enter(const PhaseRow& phase) {
  state_.phase = phase.id;
  state_.elapsed_s = 0;
  wake();
  state_.dialog.clear();
  if (!phase.screen.empty() && phase.screen != state_.screen) {
    state_.came_from.clear();
    state_.screen = phase.screen;
  }
  note("phase", phase.id);
}

void Device::show(const std::string& screen) {
  auto& from = state_.came_from;
  if (screen == "back") {
    if (from.empty()) return;
    state_.screen = from.back();
    from.pop_back();
  } else if (screen != state_.screen) {
    const auto earlier = std::find(from.begin(), from.end(), screen);
    if (earlier != from.end())
      from.erase(earlier, from.end());
    else
      from.push_back(state_.screen);
    state_.screen = screen;
  }
  note("screen", state_.screen);
}

void Device::ask(const std::string& dialog, const std::string& detail) {
  state_.dialog = dialog;
  state_.dialog_detail = detail;
  wake();
  note("dialog", dialog);
}

// The time that the present phase still takes; nothing when it waits.
std::optional<double> Device::leftOfPhase() const {
  const auto* phase = findPhase(type_->definition, state_.phase);
  if (!phase->ends()) return std::nullopt;
  return std::max(0.0, number("phase.lasts") - state_.elapsed_s);
}

void Device::pass(double seconds) {
  const auto* phase = findPhase(type_->definition, state_.phase);
  auto& around = state_.around;
  state_.clock_s += seconds;
  around.acclimatised_s += seconds;
  const double drain = !phase->on || around.mains ? 0 : asleep() ? kAsleepDrain : 1;
  around.battery = std::max(0.0, around.battery - drain * seconds / type_->definition.body.battery_s);
  state_.untouched_s = busy() ? 0 : state_.untouched_s + seconds;
  state_.elapsed_s += seconds;
  walkOn(state_.walk, paceLimits(type_->instrument), seconds);
  if (state_.running && phase->ends()) state_.scanned_s += seconds;
  if (state_.running && phase->laser) state_.laser_s += seconds;
}

// The device's clock and the simulation behind it run side by side: a phase whose time is over stays until what it
// waits for is there. The real instrument would be done by then, so meanwhile the clock stands still and the battery
// keeps.
void Device::run(double seconds) {
  for (int i = 0; i < 1000; ++i) {
    const auto left = on() ? leftOfPhase() : std::nullopt;
    const double step = left ? std::min(*left, seconds) : seconds;
    pass(step);
    seconds -= step;
    if (!left || step < *left) return;
    if (fire(Event::elapsed)) continue;
    if (findPhase(type_->definition, state_.phase)->waits) pass(seconds);  // for people, whose time is real
    return;
  }
}

void Device::watchBattery(double before) {
  const auto& body = type_->definition.body;
  const double now = state_.around.battery;
  const auto crossed = [&](double limit) { return now < limit && before >= limit; };
  if (crossed(body.battery_warning)) {
    note("trouble", "battery_low");
    fire(Event::battery_low);
  }
  if (crossed(body.battery_critical)) {
    note("trouble", "battery_critical");
    fire(Event::battery_critical);
  }
  if (now <= 0 && before > 0) {
    note("trouble", "battery_empty");
    fire(Event::battery_empty);
  }
}

void Device::watchWalk(double before_s) {
  auto& walk = state_.walk;
  if (!walk.recording) return;
  const auto& told = type_->definition.walk;
  for (const double minutes : told.reminders_min)
    if (before_s < 60 * minutes && walk.recorded_s >= 60 * minutes) fire(Event::reminder);
  if (told.rest_s <= 0 || walk.rest_told || walk.rested_s < told.rest_s) return;
  walk.rest_told = true;
  fire(Event::rested);
}

void Device::tick(double seconds) {
  if (!(seconds > 0)) return;
  const double before = state_.around.battery;
  const double recorded_s = state_.walk.recording ? state_.walk.recorded_s : 0;
  run(seconds);
  watchBattery(before);
  watchWalk(recorded_s);
}

// --- orders ---

void Device::give(Order order) {
  if (const auto* link = std::get_if<LinkOrder>(&order)) {
    state_.linking = link->from_file;
    state_.linking_to = link->to_file;
  }
  order_ = std::move(order);
  state_.engine_fraction = 0;
}

std::optional<Order> Device::takeOrder() { return std::exchange(order_, std::nullopt); }
bool Device::takeCancel() { return std::exchange(cancel_, false); }
bool Device::takeStored() { return std::exchange(stored_, false); }
std::optional<StationOrientation> Device::takeOriented() { return std::exchange(oriented_, std::nullopt); }
std::optional<StoredSetup> Device::takeView() { return std::exchange(view_, std::nullopt); }

void Device::takeBack() {
  cancel_ = true;
  order_.reset();
  state_.running.reset();
  state_.data.reset();
}

void Device::scanDone(StoredSetup setup) {
  if (!state_.running) return;  // it was taken back meanwhile
  setup.moved = state_.running->tripod_moved_at_fraction.has_value();
  setup.partial = state_.running->until_fraction < 1;
  setup.tracked = state_.around.tracking;
  setup.unlevelled = !state_.running->compensator || tilt() > type_->definition.body.tilt_limit_deg;
  setup.stood_x_deg = state_.running->tilt_x_deg;
  setup.stood_y_deg = state_.running->tilt_y_deg;
  if (setup.unlevelled) {
    setup.lean_x_deg = state_.running->tilt_x_deg;
    setup.lean_y_deg = state_.running->tilt_y_deg;
  }
  state_.data = std::move(setup);
  fire(Event::data);
}

void Device::linkDone(const LinkResult& link) {
  for (auto& p : state_.projects)
    for (auto& setup : p.setups)
      if (setup.file == state_.linking) {
        setup.link = link;
        setup.link->to = state_.linking_to;
      }
  note("linked", link.joined ? "joined" : "refused");
  fire(Event::linked);
}

void Device::targetsDone(std::vector<FittedTarget> targets) {
  auto* setup = shownSetup();
  if (setup == nullptr) setup = newestSetup();
  const auto found = std::count_if(targets.begin(), targets.end(), [](const FittedTarget& t) { return t.found; });
  if (setup != nullptr) setup->targets = std::move(targets);
  note("targets", std::to_string(found));
  fire(Event::targets_measured);
  if (found == 0 && !busy() && state_.dialog.empty())
    ask("refused", word("target_not_found"));  // else the press seems to have done nothing
}

void Device::pickDone(const std::string& file, const FittedTarget& target) {
  note("picked", target.found ? target.name : "");
  if (!target.found) return ask("refused", word("target_not_found"));
  for (auto& p : state_.projects)
    for (auto& setup : p.setups) {
      if (setup.file != file) continue;
      std::erase_if(setup.targets, [&](const FittedTarget& t) { return t.name == target.name; });
      setup.targets.push_back(target);
    }
}

// What was picked comes under the ID that was typed, in the place of an earlier sight of that ID.
void Device::sightDone(const FittedTarget& target) {
  note("sighted", target.found ? target.name : "");
  if (target.found) {
    auto& all = state_.sighted;
    const auto typed = fact("entry.target_id")->text;
    const auto id = typed.empty() ? target.name : typed;
    std::erase_if(all, [&](const SightedTarget& s) { return s.id == id; });
    const auto height = fact("entry.target_height");
    all.push_back({id, target.levelled_m, numberIn(height->text).value_or(0), target.residual_m, target.points, true});
    if (state_.orientation && !state_.orientation->accepted) state_.orientation.reset();  // a check changes nothing
  }
  fire(target.found ? Event::sighted : Event::not_sighted);
}

// Its targets are known from here on: by what this set-up makes of them.
void Device::acceptOrientation() {
  if (!state_.orientation) return;
  auto& o = *state_.orientation;
  o.accepted = true;
  if (auto* open = project())
    for (const auto& s : state_.sighted) {
      std::erase_if(open->carried, [&](const ControlPlace& c) { return c.name == s.id; });
      open->carried.push_back({s.id, o.pose * s.place_m - Eigen::Vector3d(0, 0, s.height_m)});
    }
  state_.accepted = o;
  note("oriented", o.method);
  if (!o.local) oriented_ = o;
}

void Device::orientationErred(const PlaceError& error) {
  if (state_.accepted) state_.accepted->error = error;
}

void Device::previewDone(const std::string& file, const std::shared_ptr<const ScanPreview>& preview) {
  for (auto& p : state_.projects)
    for (auto& setup : p.setups)
      if (setup.file == file) setup.preview = preview;
  if (auto* shown = shownSetup(); shown != nullptr && shown->file == file) {  // else nobody has seen it
    shown->looked_at = true;
    note("looked_at", shown->name);
  }
}

void Device::transferDone(const std::vector<std::string>& files) {
  for (auto& p : state_.projects)
    for (auto& setup : p.setups)
      if (std::find(files.begin(), files.end(), setup.file) != files.end()) setup.transferred = true;
  note("transferred", std::to_string(files.size()));
  fire(Event::transferred);
}

void Device::orderFailed(const std::string& message) {
  state_.running.reset();
  state_.data.reset();
  note("failed", message);
  fire(Event::failed);
  ask("failed", message);
}

void Device::sceneDone() { state_.walk.scene = true; }

void Device::load(const std::vector<StoredSetup>& stored) {
  state_.projects.clear();
  state_.project = -1;
  state_.around.card_used_bytes = 0;
  for (const auto& setup : stored) {
    auto found = std::find_if(state_.projects.begin(), state_.projects.end(),
                              [&](const DeviceProject& p) { return p.name == setup.project; });
    if (found == state_.projects.end()) {
      found = state_.projects.insert(found, DeviceProject{});
      found->name = setup.project;
      found->first = setup.number;
    }
    found->setups.push_back(setup);
    state_.around.card_used_bytes += setup.bytes;
  }
}

}  // namespace standpoint
