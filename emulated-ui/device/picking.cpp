// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/picking.h"

#include <algorithm>
#include <numbers>

#include <fmt/format.h>

#include "emulated-ui/device/effects.h"
#include "emulated-ui/device/picture.h"

namespace standpoint {

namespace {

std::string freeName(const StoredSetup& setup) {
  for (int n = 1;; ++n) {
    auto name = fmt::format("T{}", n);
    if (std::none_of(setup.targets.begin(), setup.targets.end(),
                     [&](const FittedTarget& t) { return t.found && t.name == name; }))
      return name;
  }
}

}  // namespace

Result<void> beginPicking(Device& device, const std::string&) {
  const auto* setup = device.shownSetup();
  if (setup == nullptr) return failure(ErrorKind::usage, device.word("no_setup"));
  if (!setup->preview) device.give(PreviewOrder{setup->file});
  auto& entries = device.change().entries;
  entries["aim"] = "0.5,0.5";
  entries["target_name"] = freeName(*setup);
  return {};
}

Result<void> aim(Device& device, const std::string& place) {
  if (!placeIn(place))
    return failure(ErrorKind::usage, "u,v required: fractions of the image from its upper left corner");
  device.change().entries["aim"] = place;
  return {};
}

Result<void> pickAimed(Device& device, const std::string&) {
  const auto* setup = device.shownSetup();
  if (setup == nullptr || !setup->preview) return failure(ErrorKind::usage, device.word("no_preview"));
  const auto name = device.entry("target_name");
  if (auto ok = checkName(device, name); !ok) return ok;
  const auto spot = spotIn(*setup->preview, device.entry("aim"));
  if (!spot) return failure(ErrorKind::usage, device.word("no_point"));
  if (!device.state().around.targets_visible) {
    device.note("picked");
    return failure(ErrorKind::usage, device.word("target_not_found"));
  }
  PickOrder order;
  order.file = setup->file;
  order.spot_m = *spot;
  order.reach_rad = std::numbers::pi / setup->preview->columns;
  order.kind = device.value("pick_type");
  order.name = name;
  device.give(std::move(order));
  return {};
}

}  // namespace standpoint
