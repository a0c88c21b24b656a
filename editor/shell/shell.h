// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "editor/model/settings.h"

namespace standpoint {

struct Editor;
struct GuideStep;

// One frame of the whole interface, between ImGui::NewFrame and ImGui::Render.
void drawShell(Editor& editor);

// The whole frame. Where the workspace has changed, at once another one: what Dear ImGui lays out for the first time
// has its tabs in the second, and the first is not to be seen.
void drawFrame(Editor& editor);

// The picture of the scene with what lies over it, in the current window.
void drawViewport(Editor& editor);

// Goes to a workspace and brings a panel of it to the front.
void openPanel(Editor& editor, Workspace workspace, std::string_view panel);
// Does what the step advises, where it is done.
void takeStep(Editor& editor, const GuideStep& step);

}  // namespace standpoint
