// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <imgui.h>

namespace standpoint {

struct Editor;

// Takes a station by its instrument and sets it up where the pointer lets go, if it can stand there. True while the
// pointer belongs to it.
bool dragStation(Editor& editor, ImVec2 origin, bool hovered);
// What can be done with the station whose instrument is under the pointer. False where none is.
bool openStationMenu(Editor& editor, ImVec2 origin);
void drawStationMenu(Editor& editor);

}  // namespace standpoint
