// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/effects.h"

#include <algorithm>

#include <fmt/format.h>

#include "emulated-ui/device/device.h"
#include "emulated-ui/device/linking.h"

namespace standpoint {

namespace {

constexpr double kDustNoise = 2;    // [P] instrument facts §3.3 M01: twice the noise
constexpr double kColdNoise = 1.5;  // [P] an instrument that is not used to its temperature
constexpr std::size_t kLongestName = 60;

// Who measured for whom, for the file's record.
SettingValues notesOf(const Device& device) {
  SettingValues notes;
  if (const auto name = device.value("operator"); !name.empty()) notes.emplace_back("operator", name);
  if (const auto* project = device.project(); project != nullptr && !project->note.empty())
    notes.emplace_back("project", project->note);
  return notes;
}

std::vector<std::string> sensorsOn(const Device& device) {
  std::vector<std::string> on;
  for (const auto& sensor : device.type().definition.sensors)
    if (sensor.value.empty() || device.value(sensor.value) == "on") on.push_back(sensor.id);
  return on;
}

std::string baseOfNames(const Device& device) {
  const auto& scan = device.type().definition.scan;
  const auto* project = device.project();
  const bool has_base = scan.project_base && project != nullptr && !project->base.empty();
  return has_base ? project->base : scan.name;
}

bool hasReading(const StoredSetup& setup, const char* sensor) {
  return std::any_of(setup.notes.begin(), setup.notes.end(), [&](const auto& note) { return note.first == sensor; });
}

}  // namespace

Result<void> checkName(const Device& device, const std::string& name) {
  const auto wrong = [&](const char* word) { return failure(ErrorKind::usage, device.word(word)); };
  if (name.empty()) return wrong("name_empty");
  if (name.size() > kLongestName) return wrong("name_long");
  if (name.find_first_of("\\/:*?\"<>|") != std::string::npos) return wrong("name_signs");
  if (name.front() == '.' || name.back() == '.' || name.front() == ' ' || name.back() == ' ') return wrong("name_ends");
  return {};
}

void beginScan(Device& device) {
  auto& s = device.change();
  const auto& type = device.type();
  ScanOrder order;
  order.instrument = type.instrument.id;
  if (const auto* project = device.project()) {
    order.project = project->name;
    order.folder = project->cluster;
  }
  order.number = static_cast<int>(device.fact("setup.next")->number.value_or(1));
  order.name = fmt::format("{}{:03d}", baseOfNames(device), order.number);
  order.station = s.around.station;
  order.settings = s.settings;
  order.panorama = device.expected().imaging;
  order.compensator = device.levelled();
  if (s.around.dust) order.noise_factor *= kDustNoise;
  if (s.around.acclimatised_s < type.definition.body.warm_up_s) order.noise_factor *= kColdNoise;
  order.tilt_x_deg = s.around.tilt_x_deg;
  order.tilt_y_deg = s.around.tilt_y_deg;
  order.sensors = sensorsOn(device);
  order.notes = notesOf(device);
  if (s.around.passer_by) order.passer_by_at_fraction = 0.5;
  s.around.passer_by = false;
  order.operator_in_view = s.around.operator_in_view;
  order.operator_place = s.around.operator_place;
  if (type.program.prepare != nullptr) type.program.prepare(device, order);
  s.moved = false;
  s.scanned_s = s.laser_s = 0;
  s.data.reset();
  s.running = order;
  device.note("scan_started", order.name);
  device.give(order);
}

void storeScan(Device& device) {
  auto& s = device.change();
  auto* project = device.project();
  if (!s.data || project == nullptr) return;
  s.around.card_used_bytes += s.data->bytes;
  project->setups.push_back(*std::move(s.data));
  s.data.reset();
  s.running.reset();
  s.shown = static_cast<int>(project->setups.size()) - 1;
  device.markStored();
  device.note("scan_stored", project->setups.back().name);
}

void dropScan(Device& device) {
  if (!device.state().running && !device.state().data) return;
  device.note("scan_dropped", device.state().running ? device.state().running->name : "");
  device.takeBack();
}

namespace {

// Of the sweep: what the laser has measured.
double swept(const Device& device) {
  return std::clamp(device.state().laser_s / std::max(1.0, device.expected().scan_seconds), 0.0, 1.0);
}

// What was simulated so far did not know of it.
template <class Change>
void changeRunning(Device& device, Change change) {
  auto& s = device.change();
  if (!s.running) return;
  ScanOrder order = *s.running;
  change(order);
  device.takeBack();
  s.running = order;
  device.give(order);
}

}  // namespace

void markMoved(Device& device) {
  device.change().moved = true;
  changeRunning(device, [&](ScanOrder& order) { order.tripod_moved_at_fraction = swept(device); });
}

void operatorComes(Device& device) {
  changeRunning(device, [&](ScanOrder& order) {
    if (!order.operator_in_view) order.operator_from_fraction = swept(device);
    order.operator_in_view = true;
    order.operator_until_fraction = 1;
    order.operator_place = device.state().around.operator_place;
  });
}

void operatorGoes(Device& device) {
  changeRunning(device, [&](ScanOrder& order) { order.operator_until_fraction = swept(device); });
}

void somebodyWalksBy(Device& device) {
  constexpr double kAhead = 0.02;  // of the sweep: where the laser looks next
  changeRunning(device, [&](ScanOrder& order) { order.passer_by_at_fraction = std::min(swept(device) + kAhead, 1.0); });
}

void keepPartial(Device& device) {
  changeRunning(device, [&](ScanOrder& order) {
    order.until_fraction = std::max(swept(device), 0.01);
    order.panorama = false;
  });
}

double falseStart(const Device& device, const StoredSetup& newer, const StoredSetup& older) {
  return hasReading(newer, "compass") && hasReading(older, "compass") ? 0 : device.number("value.false_start");
}

void mislay(Device& device, LinkOrder& order) {
  constexpr double kNothingThere_m = 1000;
  if (device.state().around.registration_fails) order.shift_x_m += kNothingThere_m;
  device.change().around.registration_fails = false;
}

void orderLink(Device& device) {
  const auto* project = device.project();
  if (project == nullptr || project->setups.size() < 2) return;
  const auto& setups = project->setups;
  orderLinkTo(device, setups[setups.size() - 1], setups[setups.size() - 2]);
}

void orderLinkTo(Device& device, const StoredSetup& newer, const StoredSetup& older) {
  LinkOrder order{newer.file, older.file};
  order.turn_deg = falseStart(device, newer, older);
  mislay(device, order);
  device.give(std::move(order));
}

void storeAndLink(Device& device) {
  storeScan(device);
  orderLink(device);
}

void loseTracking(Device& device) { device.change().around.tracking = false; }
void resetTracking(Device& device) { device.change().around.tracking = true; }

void deleteShownSetup(Device& device) {
  auto* project = device.project();
  const auto* setup = device.shownSetup();
  if (project == nullptr || setup == nullptr) return;
  auto& s = device.change();
  s.around.card_used_bytes = std::max(0.0, s.around.card_used_bytes - setup->bytes);
  device.note("setup_deleted", setup->name);
  project->setups.erase(project->setups.begin() + s.shown);
  s.shown = -1;
}

void deleteOpenProject(Device& device) {
  auto& s = device.change();
  const auto* project = device.project();
  if (project == nullptr) return;
  for (const auto& setup : project->setups) {
    s.around.card_used_bytes = std::max(0.0, s.around.card_used_bytes - setup.bytes);
    device.note("setup_deleted", setup.name);
  }
  device.note("project_deleted", project->name);
  s.projects.erase(s.projects.begin() + s.project);
  s.project = s.shown = -1;
}

void formatCard(Device& device) {
  auto& s = device.change();
  int lost = 0;
  for (const auto& p : s.projects)
    for (const auto& setup : p.setups) lost += setup.transferred ? 0 : 1;
  s.projects.clear();
  s.project = s.shown = -1;
  s.around.card_used_bytes = 0;
  device.note("card_formatted", std::to_string(lost));
}

const std::vector<NamedEffect>& namedEffects() {
  static const std::vector<NamedEffect> rows = {
      {"begin_scan", beginScan},
      {"store_scan", storeScan},
      {"store_and_link", storeAndLink},
      {"drop_scan", dropScan},
      {"mark_moved", markMoved},
      {"keep_partial", keepPartial},
      {"lose_tracking", loseTracking},
      {"reset_tracking", resetTracking},
      {"delete_setup", deleteShownSetup},
      {"delete_project", deleteOpenProject},
      {"format_card", formatCard},
      {"remove_link", removeLink},
      {"order_scene", orderScene},
      {"begin_walk", beginWalk},
      {"pause_walk", pauseWalk},
      {"resume_walk", resumeWalk},
      {"fix_walk", fixWalk},
      {"end_walk", endWalk},
      {"drop_walk", dropWalk},
      {"process_walk", orderWalk},
      {"store_walk", storeWalk},
  };
  return rows;
}

}  // namespace standpoint
