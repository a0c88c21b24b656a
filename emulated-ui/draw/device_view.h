// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "emulated-ui/device/device.h"
#include "emulated-ui/draw/keyboard.h"
#include "emulated-ui/layout/layout.h"

struct ImFont;

namespace standpoint {

// What somebody did to a drawn device.
struct Press {
  std::string widget, value;
  Gesture by = Gesture::tap;
};

// A map that is moved and made larger by hand: its middle in shares of the picture, and how much larger.
struct MapView {
  float x = 0, y = 0, zoom = 1;
};

// What of a map a finger holds since it came down.
struct MapGrip {
  enum class On { nothing, ground, mark, link, cloud, ring } on = On::nothing;
  int setup = -1;                                        // of the mark or link
  std::array<double, 3> laid{};                          // x, y, turn of the cloud: where it is drawn meanwhile
  double from_x_m = 0, from_y_m = 0, from_turn_rad = 0;  // what the finger came down on, beside that
};

// What a drawn device keeps from one frame to the next. A plain value but for the ways to textures and fonts.
struct DeviceView {
  // Where its widgets stand; null: title and form on a plain body.
  std::shared_ptr<const Layout> layout;
  std::string face;                           // that was shown last: it stays when the display goes dark
  std::map<std::string, int> tabs;            // which tab is chosen, by the screen and the place of the tabs
  std::map<std::string, MapView> maps;        // by screen and widget
  bool asking = false;                        // a press explains instead of acting
  std::string explained;                      // the widget that was asked about last
  std::string pointed;                        // a hint: this widget is framed
  std::map<std::string, std::string> typing;  // entries that have the keyboard
  Keyboard keyboard;
  std::array<double, 4> area{};  // edges while one is dragged: from_h, to_h, from_v, to_v in degrees
  int dragged_edge = -1;
  std::string grabbed;                       // the form that a finger lies on
  bool scrolling = false;                    // the finger has moved it
  bool held = false;                         // what it lies on was held long enough
  std::optional<std::array<double, 2>> aim;  // u, v under the cross-hair while the picture is moved
  MapGrip grip;                              // what of a map the finger holds
  // A texture of a preview; 0 or empty: none can be had.
  std::function<std::uint64_t(const std::shared_ptr<const ScanPreview>&)> texture;
  // The font whose letters are made for about this height; empty or null: the current one.
  std::function<ImFont*(float pixels)> font;
  bool still = false;              // for a picture: lamps do not flash
  std::optional<double> working;   // share of what the device reads or computes just now
  std::array<float, 4> display{};  // where it was drawn in the last frame: left, top, width, height on the screen
  std::vector<std::string> cut;    // of the last frame: texts that do not fit where they stand, as "widget: text"
};

// How wide and high a device is that fits into this room, in pixels.
std::array<float, 2> deviceSize(const Device& device, const DeviceView& view, float width, float height);
// Draws the device into the current ImGui window, at most `width` × `height` pixels, and gives what was pressed.
std::optional<Press> drawDevice(const Device& device, DeviceView& view, float width, float height);

}  // namespace standpoint
