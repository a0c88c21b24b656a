// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace standpoint {

// How a family of instruments looks: our own colours and proportions. Colours as ImGui packs them, 0xAABBGGRR.
struct Skin {
  const char* name;
  unsigned body, body_edge, display, title_bar, title_text, tile, tile_hover, tile_text, accent, accent_text, key, text, dim, line;
  float rounding;           // of tiles, in units
  bool large_tiles;         // buttons of a first screen stand two in a row
};
const Skin& skinOf(const std::string& name);   // the plain one where there is no such skin

}  // namespace standpoint
