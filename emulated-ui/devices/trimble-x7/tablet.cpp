// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/devices/trimble-x7/tablet.h"

#include <charconv>
#include <string_view>

#include "emulated-ui/device/format.h"
#include "emulated-ui/devices/trimble-x7/phases.h"

namespace standpoint::trimble_x7 {

namespace {

constexpr double kWlan_bytes_per_s = 20e6, kCable_bytes_per_s = 40e6;  // [P]

// With its picture.
Result<void> create(Device& device) {
  if (auto ok = sharedAction(device, "create_project"); !ok) return ok;
  const auto photo = device.value("project_photo");
  device.project()->photo = photo == "none" ? "" : photo;
  return {};
}

}  // namespace

Result<void> sharedAction(Device& device, std::string_view name, const std::string& value) {
  for (const auto& action : sharedActions())
    if (name == action.name) return action.act(device, value);
  return failure(ErrorKind::internal, "unknown action");
}

Result<void> proposeNew(Device& device, const std::string&) {
  if (auto ok = sharedAction(device, "propose_project"); !ok) return ok;
  const auto user = device.value("operator");
  device.change().entries["note"] = clockText(device.state().clock_s) + (user.empty() ? "" : ", " + user);
  return {};
}

// An empty name takes the one that is proposed.
Result<void> createNew(Device& device, const std::string&) {
  auto& entries = device.change().entries;
  if (entries["name"].empty()) {
    const auto typed = entries;
    if (auto ok = sharedAction(device, "propose_project"); !ok) return ok;
    entries["first"] = typed.at("first");
    entries["note"] = typed.at("note");
  }
  return create(device);
}

bool startIndexValid(const Device& device) {
  const auto text = device.entry("first");
  int index = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
  return error == std::errc() && end == text.data() + text.size() && index >= 1 && index <= 999999;
}

// Of the raw scans, those that lie on the scanner's card only: what an interrupted download has left there.
Result<void> importNow(Device& device, const std::string&) {
  if (!device.in(phase::interrupted) || device.value("import_format") != "TZF")
    return failure(ErrorKind::usage, device.word("nothing_to_import"));
  return {};
}

bool reachable(const Device& device) { return device.value("connection") == "cable" || device.state().around.wlan; }

bool connected(const Device& device) {
  const bool waits = device.in({phase::booting, phase::disconnected, phase::connecting, phase::shutting_down});
  return device.on() && !waits && reachable(device);
}

double downloadSeconds(const Device& device) {
  return device.expectedBytes() / (device.value("connection") == "cable" ? kCable_bytes_per_s : kWlan_bytes_per_s);
}

}  // namespace standpoint::trimble_x7
