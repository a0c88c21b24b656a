// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <imgui.h>

// Lists of choices that open below a box, the same by pointer and by keys, in whatever is drawn with Dear ImGui. Up,
// Down, Home and End go through an open one, Enter takes, Esc (shell/escape.h) closes, and a letter goes to the next
// entry that begins with it. The box of one that was closed by a key keeps the keyboard until something else is
// pressed: Space or Down opens it again, and Enter goes to its dialog.
namespace standpoint::ui {

// As BeginCombo(), Selectable() and EndCombo() of Dear ImGui.
bool beginDropDown(const char* id, const char* shown, ImGuiComboFlags flags = ImGuiComboFlags_None);
bool choice(const char* label, bool chosen = false);
void endDropDown();

// In this frame: Enter is the list's, and means nothing else.
bool dropDownIsOpen();

}  // namespace standpoint::ui
