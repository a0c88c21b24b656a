// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "emulated-ui/menu.h"

struct ImFont;

namespace standpoint {

// How an instrument looks: our own colours and proportions.
struct Skin {
  unsigned body, display, title_bar, tile, tile_hover, accent, key, text, dim;   // 0xAABBGGRR, as ImGui packs them
  float display_aspect;      // width over height of the touch display
};
extern const Skin kLeicaSkin;

// Draws the instrument's display into the current ImGui window at most `width` × `height` pixels, and acts on the menu when
// something is pressed. `error` receives what the menu refused.
void drawMenu(Menu& menu, const Skin& skin, float width, float height, std::string& error);

}  // namespace standpoint
