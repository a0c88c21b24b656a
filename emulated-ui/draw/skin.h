// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>

namespace standpoint {

// How a family of instruments looks: our own colours and proportions. Colours as ImGui packs them, 0xAABBGGRR.
struct Skin {
  const char* name;
  unsigned body, body_edge, display, title_bar, title_text, tile, tile_hover, tile_text, accent, accent_text, key, text,
      dim, line;
  unsigned key_text, warning, off;  // on the key; of what is wrong; of a switch that is off
  float rounding;                   // of tiles, in units
};
std::span<const Skin> skins();
const Skin& skinOf(const std::string& name);  // the plain one where there is no such skin

}  // namespace standpoint
