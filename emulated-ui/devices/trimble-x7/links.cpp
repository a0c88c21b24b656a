// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/devices/trimble-x7/links.h"

#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "emulated-ui/device/effects.h"

namespace standpoint::trimble_x7 {

namespace {

const std::string kState = "registration.";  // + file: a value of the device
constexpr const char* kLeft = "links_left";  // an entry

std::string judged(const Device& device, const StoredSetup& setup, const LinkResult& link) {
  const auto* before = setupBefore(device, setup);
  if (before == nullptr || !link.joined || tiltDifference_deg(setup, *before) >= kMostTiltDifference_deg)
    return "failed";
  const double confidence = confidenceOf(link);
  return confidence >= kGreenConfidence ? "registered" : confidence >= kAmberConfidence ? "check" : "failed";
}

void forgetShift(Device& device) {
  for (const char* value : {"shift_x", "shift_y", "turn"}) device.change().values[value] = std::string(1, '0');
}

void orderRefine(Device& device, const StoredSetup& setup, bool with_shift) {
  const auto* before = setupBefore(device, setup);
  if (before == nullptr) return;
  LinkOrder order{setup.file, before->file};
  order.turn_deg = falseStart(device);
  if (with_shift) {
    order.shift_x_m = device.number("value.shift_x");
    order.shift_y_m = device.number("value.shift_y");
    order.turn_deg += device.number("value.turn");
  }
  mislay(device, order);
  forgetRegistration(device, setup);
  device.give(std::move(order));
}

}  // namespace

double consistencyOf(const LinkResult& link) { return link.joined ? 100 / (1 + std::pow(link.error_m / 0.010, 4)) : 0; }

double confidenceOf(const LinkResult& link) {
  return consistencyOf(link) * (1 - std::exp(-std::pow(link.overlap / 0.2, 2)));
}

double tiltDifference_deg(const StoredSetup& a, const StoredSetup& b) {
  return std::hypot(a.lean_x_deg - b.lean_x_deg, a.lean_y_deg - b.lean_y_deg);
}

std::string registrationOf(const Device& device, const StoredSetup& setup) {
  const auto state = device.value(kState + setup.file);
  return state.empty() ? "none" : state;
}

void forgetRegistration(Device& device, const StoredSetup& setup) { device.change().values.erase(kState + setup.file); }

void setRegistration(Device& device, const StoredSetup& setup, const std::string& state) {
  device.change().values[kState + setup.file] = state;
  device.note("registration", setup.name + "=" + state);
}

const StoredSetup* setupBefore(const Device& device, const StoredSetup& setup) {
  const auto* project = device.project();
  if (project == nullptr) return nullptr;
  for (std::size_t i = 1; i < project->setups.size(); ++i)
    if (project->setups[i].file == setup.file) return &project->setups[i - 1];
  return nullptr;
}

const StoredSetup* setupOfFile(const Device& device, const std::string& file) {
  for (const auto& p : device.state().projects)
    for (const auto& setup : p.setups)
      if (setup.file == file) return &setup;
  return nullptr;
}

const StoredSetup* linkedSetup(const Device& device) {
  const auto* shown = device.shownSetup();
  if (shown != nullptr && setupBefore(device, *shown) != nullptr) return shown;
  const auto* newest = device.newestSetup();
  return newest != nullptr && setupBefore(device, *newest) != nullptr ? newest : nullptr;
}

void refineShown(Device& device) {
  device.change().entries.erase(kLeft);
  if (const auto* setup = linkedSetup(device)) orderRefine(device, *setup, true);
}

void refineFirst(Device& device) {
  const auto& setups = device.project()->setups;
  device.change().entries[kLeft] = std::to_string(setups.size() - 2);
  orderRefine(device, setups[1], false);
}

int linksLeft(const Device& device) { return static_cast<int>(device.entryNumber(kLeft)); }

void judgeLink(Device& device) {
  const auto* setup = setupOfFile(device, device.state().linking);
  if (setup == nullptr || !setup->link) return;
  setRegistration(device, *setup, judged(device, *setup, *setup->link));
  forgetShift(device);
}

void judgeAndRefineNext(Device& device) {
  judgeLink(device);
  const int left = linksLeft(device);
  device.change().entries[kLeft] = std::to_string(left - 1);
  const auto& setups = device.project()->setups;
  orderRefine(device, setups[setups.size() - static_cast<std::size_t>(left)], false);
}

Result<void> chooseLink(Device& device, const std::string& row) {
  device.change().shown = std::atoi(row.c_str());
  forgetShift(device);
  return {};
}

Result<void> applyLink(Device& device, const std::string&) {
  if (const auto* setup = linkedSetup(device)) setRegistration(device, *setup, "applied");
  return {};
}

Result<void> rejectLink(Device& device, const std::string&) {
  if (const auto* setup = linkedSetup(device)) setRegistration(device, *setup, "rejected");
  return {};
}

std::vector<WidgetOption> linkRows(const Device& device) {
  std::vector<WidgetOption> rows;
  const auto* project = device.project();
  for (std::size_t i = 1; project != nullptr && i < project->setups.size(); ++i) {
    const auto& setup = project->setups[i];
    std::string text = fmt::format("{} – {}  {}", project->setups[i - 1].name, setup.name,
                                   device.word("registration=" + registrationOf(device, setup)));
    if (setup.link && setup.link->joined)
      text += fmt::format("  {:.1f} mm  {:.0f} %  {:.0f}", setup.link->error_m * 1000, setup.link->overlap * 100,
                          confidenceOf(*setup.link));
    rows.push_back({std::to_string(i), text, true, {}});
  }
  return rows;
}

}  // namespace standpoint::trimble_x7
