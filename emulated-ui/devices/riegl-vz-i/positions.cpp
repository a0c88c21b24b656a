// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/devices/riegl-vz-i/positions.h"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

#include "emulated-ui/device/effects.h"

namespace standpoint::riegl_vz_i {

namespace {

const std::string kMedium = "medium.";  // + file: a value of the device

int firstFree(const Device& device) {
  const auto* project = device.project();
  int next = project == nullptr ? 1 : project->first;
  for (std::size_t i = 0; project != nullptr && i < project->setups.size(); ++i)
    next = std::max(next, project->setups[i].number + 1);
  return next;
}

int scansOf(const Device& device, int number) {
  const auto* project = device.project();
  if (project == nullptr) return 0;
  return static_cast<int>(std::count_if(project->setups.begin(), project->setups.end(),
                                        [&](const StoredSetup& s) { return s.number == number; }));
}

void setNumber(Device& device, int number) { device.change().values["position"] = std::to_string(number); }

// What was stored before a device was loaded lies on the SSD.
bool onSsd(const Device& device, const StoredSetup& setup) {
  const auto medium = device.value(kMedium + setup.file);
  return medium.empty() || medium == "ssd";
}

double usedOfSsd(const Device& device) {
  double bytes = 0;
  for (const auto& p : device.state().projects)
    for (const auto& setup : p.setups) bytes += onSsd(device, setup) ? setup.bytes : 0;
  return bytes;
}

}  // namespace

int nextPosition(const Device& device) {
  const int stands = static_cast<int>(device.number("value.position"));
  return device.value("auto_number") == "on" ? std::max(stands, firstFree(device)) : stands;
}

bool positionTaken(const Device& device) { return scansOf(device, nextPosition(device)) > 0; }

std::string nextPositionName(const Device& device) {
  const auto* project = device.project();
  const std::string base = project == nullptr || project->base.empty() ? kPositionBase : project->base;
  const int number = nextPosition(device), earlier = scansOf(device, number);
  return (earlier > 0 ? fmt::format("Scan{}_", earlier + 1) : "") + fmt::format("{}{:03d}", base, number);
}

double doublePositions(const Device& device) {
  double n = 0;
  if (const auto* project = device.project())
    for (const auto& setup : project->setups) n += scansOf(device, setup.number) > 1 ? 1 : 0;
  return n;
}

// Loads the project of this name; makes it where there is none [S31].
Result<void> loadOrCreate(Device& device, const std::string&) {
  const auto name = device.entry("name");
  if (auto ok = checkName(device, name); !ok) return ok;
  auto& s = device.change();
  const auto found =
      std::find_if(s.projects.begin(), s.projects.end(), [&](const DeviceProject& p) { return p.name == name; });
  s.project = static_cast<int>(found - s.projects.begin());
  if (found == s.projects.end()) {
    DeviceProject project;
    project.name = name;
    s.projects.push_back(std::move(project));
    device.note("project_created", name);
  } else {
    device.note("project_opened", name);
  }
  s.shown = -1;
  setNumber(device, firstFree(device));
  return {};
}

Result<void> openPositionProject(Device& device, const std::string& row) {
  auto& s = device.change();
  const int at = std::atoi(row.c_str());  // a row of the list
  s.project = at;
  s.shown = -1;
  device.note("project_opened", s.projects[static_cast<std::size_t>(at)].name);
  setNumber(device, firstFree(device));
  return {};
}

Result<void> proposePosition(Device& device, const std::string&) {
  const auto* project = device.project();
  device.change().entries["base"] = project == nullptr || project->base.empty() ? kPositionBase : project->base;
  setNumber(device, nextPosition(device));
  return {};
}

Result<void> setBase(Device& device, const std::string&) {
  const auto base = device.entry("base");
  if (auto ok = checkName(device, base); !ok) return ok;
  device.project()->base = base;
  device.note("position_base", base);
  return {};
}

Result<void> numberFromHere(Device& device, const std::string&) {
  setNumber(device, device.value("auto_number") == "on" ? firstFree(device) : std::max(1, firstFree(device) - 1));
  return {};
}

std::string cardState(const Device& device) {
  const auto& around = device.state().around;
  if (device.value("storage") == "ssd") return "present";
  return !around.card_present ? "absent" : around.card_locked ? "locked" : "present";
}

double cardFree(const Device& device) {
  if (cardState(device) != "present") return 0;
  const auto& around = device.state().around;
  return device.value("storage") == "ssd" ? std::max(0.0, kSsdBytes - usedOfSsd(device))
                                          : std::max(0.0, around.card_bytes - around.card_used_bytes);
}

void storePosition(Device& device) {
  const double before = device.state().around.card_used_bytes;
  storeScan(device);
  const auto* newest = device.newestSetup();
  if (newest == nullptr) return;
  const auto medium = device.value("storage");
  device.change().values[kMedium + newest->file] = medium;
  if (medium == "ssd") device.change().around.card_used_bytes = before;
  if (device.value("auto_number") == "on") setNumber(device, newest->number + 1);
}

void deletePosition(Device& device) {
  const auto* setup = device.shownSetup();
  if (setup == nullptr) return;
  const double before = device.state().around.card_used_bytes;
  const bool ssd = onSsd(device, *setup);
  deleteShownSetup(device);
  if (ssd) device.change().around.card_used_bytes = before;
}

// Only what lies on the chosen medium goes.
void formatMedium(Device& device) {
  auto& s = device.change();
  const bool ssd = device.value("storage") == "ssd";
  int lost = 0;
  for (auto& p : s.projects)
    std::erase_if(p.setups, [&](const StoredSetup& setup) {
      if (onSsd(device, setup) != ssd) return false;
      lost += setup.transferred ? 0 : 1;
      return true;
    });
  s.shown = -1;
  if (!ssd) s.around.card_used_bytes = 0;
  device.note("card_formatted", std::to_string(lost));
}

}  // namespace standpoint::riegl_vz_i
