// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <imgui.h>

namespace standpoint {

struct Editor;

// Handles of the chosen station: its heading on the floor, its instrument height and its tilt above the instrument.
// True while the pointer belongs to one of them; what it was dragged to is set up when it is let go.
bool dragStationHandle(Editor& editor, ImVec2 origin, bool hovered);
void drawStationHandles(Editor& editor, ImVec2 origin);

}  // namespace standpoint
