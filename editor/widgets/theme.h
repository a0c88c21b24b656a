// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <imgui.h>

namespace standpoint {

struct Fonts;

// Colours with a meaning; the rest of the look is in applyTheme.
namespace tone {
constexpr ImU32 kAccent = IM_COL32(64, 144, 247, 255);
constexpr ImU32 kGood = IM_COL32(87, 186, 122, 255);
constexpr ImU32 kWarning = IM_COL32(232, 178, 76, 255);
constexpr ImU32 kBad = IM_COL32(234, 99, 92, 255);
constexpr ImU32 kDim = IM_COL32(132, 141, 156, 255);
constexpr ImU32 kText = IM_COL32(222, 226, 233, 255);
constexpr ImU32 kUnassigned = IM_COL32(237, 66, 153, 255);
constexpr ImU32 kLine = IM_COL32(54, 60, 70, 255);
constexpr ImU32 kOverlay = IM_COL32(24, 27, 32, 205);
constexpr ImU32 kStation = IM_COL32(255, 176, 32, 255);
}  // namespace tone

ImVec4 colour(ImU32 packed);
void applyTheme(float scale);

// Builds the atlas of the current ImGui context at the given scale: Inter, JetBrains Mono and Font Awesome where they
// are installed, else Dear ImGui's own font.
Fonts buildFonts(float scale);

}  // namespace standpoint
