// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/sounds.h"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include "emulated-ui/device/device.h"

namespace standpoint {

namespace {

constexpr std::array<std::string_view, 9> kHeard = {"pressed", "refused", "dialog", "phase",      "trouble",
                                                    "failed",  "linked",  "woken",  "scan_stored"};

bool isOf(const DeviceEvent& event, const std::string& name) {
  return name == event.what || (name.size() > event.what.size() && name.starts_with(event.what) &&
                                name[event.what.size()] == '.' && name.substr(event.what.size() + 1) == event.detail);
}

}  // namespace

const SoundRow* soundSince(const Device& device, std::uint64_t noted) {
  const auto& log = device.state().log;
  const auto& sounds = device.type().definition.sounds;
  if (noted >= log.size() || !sounds.when.holds([&](const auto& name) { return device.fact(name); })) return nullptr;
  const std::span<const DeviceEvent> recent(log.begin() + static_cast<std::ptrdiff_t>(noted), log.end());
  const auto due = [&](const SoundRow& row) {
    return std::any_of(row.on.begin(), row.on.end(), [&](const std::string& name) {
      return std::any_of(recent.begin(), recent.end(), [&](const DeviceEvent& event) { return isOf(event, name); });
    });
  };
  const auto last = std::find_if(sounds.rows.rbegin(), sounds.rows.rend(), due);
  return last == sounds.rows.rend() ? nullptr : &*last;
}

std::string unheardOf(const DeviceDefinition& d, const std::string& event) {
  const auto dot = event.find('.');
  const auto what = event.substr(0, dot);
  if (std::find(kHeard.begin(), kHeard.end(), what) == kHeard.end())
    return fmt::format("unknown event '{}'; available: {}", what, fmt::join(kHeard, ", "));
  if (dot == std::string::npos) return {};
  const auto detail = event.substr(dot + 1);
  const auto& troubles = troubleRows();
  if (what == "phase" && findPhase(d, detail) == nullptr) return fmt::format("unknown phase '{}'", detail);
  if (what == "dialog" && findDialog(d, detail) == nullptr) return fmt::format("unknown dialog '{}'", detail);
  if (what == "trouble" &&
      std::none_of(troubles.begin(), troubles.end(), [&](const TroubleRow& row) { return detail == row.id; }))
    return fmt::format("unknown trouble '{}'", detail);
  return {};
}

}  // namespace standpoint
