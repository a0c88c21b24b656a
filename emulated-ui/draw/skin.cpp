// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/draw/skin.h"

#include <imgui.h>

namespace standpoint {

unsigned packed(std::uint32_t rgb) { return IM_COL32(rgb >> 16U & 0xFFU, rgb >> 8U & 0xFFU, rgb & 0xFFU, 255); }

Skin skinOf(const SkinRow& row) {
  return {.body = packed(row.body),
          .body_edge = packed(row.body_edge),
          .display = packed(row.display),
          .title_bar = packed(row.title_bar),
          .title_text = packed(row.title_text),
          .tile = packed(row.tile),
          .tile_hover = packed(row.tile_hover),
          .tile_text = packed(row.tile_text),
          .accent = packed(row.accent),
          .accent_text = packed(row.accent_text),
          .key = packed(row.key),
          .text = packed(row.text),
          .dim = packed(row.dim),
          .line = packed(row.line),
          .key_text = packed(row.key_text),
          .warning = packed(row.warning),
          .off = packed(row.off),
          .rounding = static_cast<float>(row.rounding)};
}

}  // namespace standpoint
