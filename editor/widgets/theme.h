// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>

#include <imgui.h>

#include "editor/model/graphics.h"

namespace standpoint {

struct Fonts;

// A colour in either theme: dark tones on a light ground are deeper, so that words keep a contrast of 4.5 to 1.
struct Tone {
  ImU32 dark, light;
  operator ImU32() const;  // of the theme that is applied; without braces, as a colour is written
};

// Colours with a meaning; the rest of the look is in applyTheme.
namespace tone {
constexpr Tone kAccent{IM_COL32(64, 144, 247, 255), IM_COL32(26, 99, 201, 255)};
constexpr Tone kGood{IM_COL32(87, 186, 122, 255), IM_COL32(24, 120, 62, 255)};
constexpr Tone kWarning{IM_COL32(232, 178, 76, 255), IM_COL32(150, 92, 0, 255)};
constexpr Tone kBad{IM_COL32(234, 99, 92, 255), IM_COL32(190, 38, 32, 255)};
constexpr Tone kDim{IM_COL32(132, 141, 156, 255), IM_COL32(90, 98, 112, 255)};
constexpr Tone kText{IM_COL32(222, 226, 233, 255), IM_COL32(32, 37, 45, 255)};
constexpr Tone kUnassigned{IM_COL32(237, 66, 153, 255), IM_COL32(196, 24, 112, 255)};
constexpr Tone kEdge{IM_COL32(110, 118, 134, 255), IM_COL32(128, 136, 150, 255)};  // of an empty box, 3 to 1
constexpr Tone kLine{IM_COL32(54, 60, 70, 255), IM_COL32(200, 205, 213, 255)};
constexpr Tone kOverlay{IM_COL32(24, 27, 32, 225), IM_COL32(250, 251, 253, 225)};
constexpr Tone kStation{IM_COL32(255, 176, 32, 255), IM_COL32(196, 110, 0, 255)};
constexpr Tone kChosen{IM_COL32(158, 201, 255, 255), IM_COL32(16, 70, 150, 255)};  // word of a tab
constexpr Tone kCalm{IM_COL32(184, 191, 204, 255), IM_COL32(66, 74, 87, 255)};     // of the tabs beside it
constexpr Tone kLink{IM_COL32(128, 186, 255, 255), IM_COL32(16, 84, 180, 255)};
constexpr Tone kIcon{IM_COL32(133, 140, 156, 255), IM_COL32(104, 112, 126, 255)};     // of a row
constexpr Tone kGroupIcon{IM_COL32(158, 168, 186, 255), IM_COL32(84, 94, 112, 255)};  // of a row with others below it
constexpr Tone kPartIcon{IM_COL32(115, 158, 217, 255), IM_COL32(38, 96, 170, 255)};   // of a product, of a cloud
constexpr Tone kCurve{IM_COL32(98, 160, 214, 255), IM_COL32(20, 104, 170, 255)};
// Grounds, from the one that lies behind all to the one that is in front.
constexpr Tone kBehind{IM_COL32(22, 24, 29, 255), IM_COL32(196, 201, 209, 255)};
constexpr Tone kBar{IM_COL32(26, 29, 34, 255), IM_COL32(226, 229, 234, 255)};
constexpr Tone kTabs{IM_COL32(31, 35, 41, 255), IM_COL32(226, 229, 234, 255)};
constexpr Tone kPanel{IM_COL32(35, 39, 46, 255), IM_COL32(246, 247, 249, 255)};
constexpr Tone kPlot{IM_COL32(22, 25, 30, 255), IM_COL32(255, 255, 255, 255)};
constexpr Tone kWell{IM_COL32(27, 30, 36, 255), IM_COL32(214, 218, 225, 255)};    // of a bar that fills, of a plot
constexpr Tone kLit{IM_COL32(255, 255, 255, 18), IM_COL32(0, 0, 0, 18)};          // a switch that is on
constexpr Tone kFaint{IM_COL32(84, 94, 110, 255), IM_COL32(150, 158, 170, 255)};  // large icons
}  // namespace tone

ImVec4 colour(ImU32 packed);
void applyTheme(float scale, Theme theme = Theme::dark);

// Builds the atlas of the current ImGui context at the given scale: Inter, JetBrains Mono and Font Awesome where they
// are installed, else Dear ImGui's own font.
Fonts buildFonts(float scale);
// The same with fonts from these folders, in their order.
Fonts buildFonts(float scale, std::span<const std::filesystem::path> roots);

}  // namespace standpoint
