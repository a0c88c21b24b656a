// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <imgui.h>

namespace standpoint {

struct Editor;
class LabelBoard;
struct ViewState;

// The ways of the job's trajectories and of what is being laid: a ribbon on the floor that is walked on, or in the air
// where it is flown, with what it runs through and the waypoints of the chosen one.
void drawTrajectories(Editor& editor, const ViewState& state, ImVec2 origin, LabelBoard& labels);
// Where the pointer would add a waypoint, and how the way goes there.
void drawNextWaypoint(Editor& editor, ImVec2 origin);
// Carrier, height and speed, and the ends of a trajectory that is being laid.
void trajectoryChips(Editor& editor);

}  // namespace standpoint
