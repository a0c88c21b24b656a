// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <imgui.h>

#include "editor/widgets/widgets.h"

namespace standpoint {

struct Editor;

namespace banner {
constexpr ImU32 kHint = IM_COL32(38, 84, 148, 235), kReadout = IM_COL32(24, 26, 30, 220),
                kWarning = IM_COL32(150, 84, 16, 240), kTooFast = IM_COL32(176, 42, 36, 240);
}

// Words over the view.
struct Banner {
  ui::Text words;
  ImU32 ground = banner::kReadout;
};

// Over the lower edge of the view, the first the lowest, each in as many lines as it needs and those without words left
// out; all of them at the upper edge, the first the highest, while the pointer is near one, so that they never hide
// what is pointed at.
void drawBanners(Editor& editor, ImVec2 origin, ImVec2 size, const std::vector<Banner>& banners);
// The upper left corner of that column, where its extent is this.
ImVec2 bannersPlace(const Editor& editor, ImVec2 origin, ImVec2 size, ImVec2 extent);

}  // namespace standpoint
