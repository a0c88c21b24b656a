// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <imgui.h>

#include "editor/model/view_state.h"

namespace standpoint {

struct Editor;

// Of a part of the interface that has this size.
struct ScreenPixels {
  int width = 0, height = 0;
};
ScreenPixels screenPixels(ImVec2 size);

// The picture of a scene in a part of the view; nothing where there is nothing that draws.
void drawScene(SceneView* scene, const ViewState& state, ImVec2 origin, ImVec2 size, bool fine);
// What stands at the lower edge of that part.
void drawCaption(const Editor& editor, ImVec2 origin, ImVec2 size, const std::string& text);

}  // namespace standpoint
