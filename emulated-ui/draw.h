// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "emulated-ui/device/device.h"

namespace standpoint {

// How an instrument looks: our own colours and proportions.
struct Skin {
  unsigned body, display, title_bar, tile, tile_hover, accent, key, text, dim;   // 0xAABBGGRR, as ImGui packs them
  float display_aspect;      // width over height of the touch display
};
extern const Skin kLeicaSkin;

// Draws the device into the current ImGui window at most `width` × `height` pixels, and acts on it when something is
// pressed. `error` receives what it refused.
void drawDevice(Device& device, const Skin& skin, float width, float height, std::string& error);

}  // namespace standpoint
