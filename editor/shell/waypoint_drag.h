// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <imgui.h>

namespace standpoint {

struct Editor;

// A waypoint of a trajectory that the pointer takes, chooses and moves. True while the pointer belongs to it.
bool dragWaypoint(Editor& editor, ImVec2 origin, bool hovered);

}  // namespace standpoint
