// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "emulated-ui/device/definition.h"

namespace standpoint {

// A device's SkinRow as it is drawn: colours as ImGui packs them, 0xAABBGGRR.
struct Skin {
  unsigned body, body_edge, display, title_bar, title_text, tile, tile_hover, tile_text, accent, accent_text, key, text,
      dim, line, key_text, warning, off;
  float rounding;  // of tiles, in units
};
// 0xRRGGBB as ImGui packs it, opaque.
unsigned packed(std::uint32_t rgb);
Skin skinOf(const SkinRow& row);

}  // namespace standpoint
