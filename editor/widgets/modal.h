// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <imgui.h>

namespace standpoint {

struct Style;

namespace ui {

// A modal that is open as long as `wanted`; false when there is nothing to draw. It waits while another one is open:
// Dear ImGui would close that one. Centred and as high as what is in it; with a height it can be moved and resized.
bool beginModal(const Style& style, const char* english, bool wanted, float width, float height = 0);

// In an open modal: whether it has just been asked to go, by Esc or by a click beside it. One that would lose what was
// entered, or asks what must be decided, shakes at a click instead; Esc always means Cancel.
bool modalCancelled(bool keeps_at_click = false);

// In an open modal: whether Enter was pressed in the dialog itself: not in a field, which takes over what was typed,
// nor in an open list.
bool modalAccepted();

// What Esc (`click` false) or a click beside it asks the modal with this id. For the frame that begins now.
void askModalToGo(ImGuiID popup, bool click);

}  // namespace ui
}  // namespace standpoint
