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
  const auto* partner = partnerOf(device, setup);
  if (partner == nullptr || !link.joined || tiltDifference_deg(setup, *partner) >= kMostTiltDifference_deg)
    return "failed";
  const double confidence = confidenceOf(link);
  return confidence >= kGreenConfidence ? "registered" : confidence >= kAmberConfidence ? "check" : "failed";
}

void orderRefine(Device& device, const StoredSetup& setup, bool laid) {
  const auto* partner = partnerOf(device, setup);
  if (partner == nullptr) return;
  forgetRegistration(device, setup);
  if (laid)
    orderLaidLink(device, setup);
  else
    orderLinkTo(device, setup, *partner);
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

const StoredSetup* linkedSetup(const Device& device) {
  const auto* shown = device.shownSetup();
  if (shown != nullptr && partnerOf(device, *shown) != nullptr) return shown;
  const auto* newest = device.newestSetup();
  return newest != nullptr && partnerOf(device, *newest) != nullptr ? newest : nullptr;
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
  forgetLaid(device);
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
  forgetLaid(device);
  return {};
}

// Two stations that a line on the plan has joined.
Result<void> choosePair(Device& device, const std::string& rows) {
  TRY_ASSIGN(const auto pair, pairIn(device, rows));
  pair.first->joined_with = pair.second->file;
  return chooseLink(device, std::to_string(pair.first - device.project()->setups.data()));
}

void forgetLink(Device& device) {
  if (const auto* setup = device.shownSetup()) forgetRegistration(device, *setup);
  removeLink(device);
}

Result<void> applyLink(Device& device, const std::string&) {
  if (const auto* setup = linkedSetup(device)) setRegistration(device, *setup, "applied");
  return {};
}

Result<void> rejectLink(Device& device, const std::string&) {
  const auto* setup = linkedSetup(device);
  if (setup == nullptr) return {};
  setRegistration(device, *setup, "rejected");
  auto& setups = device.project()->setups;
  auto& link = setups[static_cast<std::size_t>(setup - setups.data())].link;
  if (link) link->joined = false;  // nothing is placed by it
  return {};
}

std::vector<WidgetOption> linkRows(const Device& device) {
  std::vector<WidgetOption> rows;
  const auto* project = device.project();
  for (std::size_t i = 1; project != nullptr && i < project->setups.size(); ++i) {
    const auto& setup = project->setups[i];
    std::string text = fmt::format("{} – {}  {}", partnerOf(device, setup)->name, setup.name,
                                   device.word("registration=" + registrationOf(device, setup)));
    if (setup.link && setup.link->joined)
      text += fmt::format("  {:.1f} mm  {:.0f} %  {:.0f}", setup.link->error_m * 1000, setup.link->overlap * 100,
                          confidenceOf(*setup.link));
    rows.push_back({std::to_string(i), text, true, {}});
  }
  return rows;
}

}  // namespace standpoint::trimble_x7
