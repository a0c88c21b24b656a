// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <imgui.h>

namespace standpoint {

struct Editor;

// How to read the colours of a scan's points: a scale with its histogram, or classes.
void drawPointsLegend(Editor& editor, ImVec2 origin, ImVec2 size);

}  // namespace standpoint
