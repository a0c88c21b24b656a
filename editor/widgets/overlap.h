// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <imgui.h>

namespace standpoint::ui {

// Draws an item on which later ones may lie and take the mouse from it; returns what `item` does. Dear ImGui wants to
// know it before the item from 1.89.7 on (Debian 13), and after it up to 1.86 (Debian 12).
template <typename Item>
auto overlappable(Item&& item) {
#if IMGUI_VERSION_NUM >= 18970
  ImGui::SetNextItemAllowOverlap();
  return item();
#else
  const auto drawn = item();
  ImGui::SetItemAllowOverlap();
  return drawn;
#endif
}

}  // namespace standpoint::ui
