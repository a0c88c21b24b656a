// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace standpoint {

struct Editor;

// One frame of the whole interface, between ImGui::NewFrame and ImGui::Render.
void drawShell(Editor& editor);

// The picture of the scene with what lies over it, in the current window.
void drawViewport(Editor& editor);

}  // namespace standpoint
