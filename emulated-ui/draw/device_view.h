// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "emulated-ui/device/device.h"
#include "emulated-ui/draw/keyboard.h"

namespace standpoint {

// What somebody did to a drawn device.
struct Press {
  std::string widget, value;
};

// What a drawn device keeps from one frame to the next. A plain value but for the way to textures.
struct DeviceView {
  bool asking = false;                        // a press explains instead of acting
  std::string explained;                      // the widget that was asked about last
  std::string pointed;                        // a hint: this widget is framed
  std::map<std::string, std::string> typing;  // entries that have the keyboard
  Keyboard keyboard;
  std::array<double, 4> area{};  // edges while one is dragged: from_h, to_h, from_v, to_v in degrees
  int dragged_edge = -1;
  bool grabbed = false, scrolling = false;  // a finger lies on the screen, and has moved it
  // A texture of a preview; 0 or empty: none can be had.
  std::function<std::uint64_t(const std::shared_ptr<const ScanPreview>&)> texture;
  bool still = false;             // for a picture: lamps do not flash
  std::string said;               // why the last press did nothing, or what it did besides
  std::optional<double> working;  // share of what the device reads or computes just now
  std::string waits;              // in words, when that is all that is waited for
};

// How wide a device of this height is, in pixels.
float deviceWidth(const Device& device, float height);
// Draws the device into the current ImGui window, at most `width` × `height` pixels, and gives what was pressed.
std::optional<Press> drawDevice(const Device& device, DeviceView& view, float width, float height);

}  // namespace standpoint
