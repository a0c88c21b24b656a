// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <imgui.h>

#include "editor/model/expected_view.h"

namespace standpoint {

struct Editor;

// Wants the picture of what the request says, through the camera and at this size, and draws the best that there is.
void drawRequested(Editor& editor, ExpectedRequest request, ImVec2 origin, ImVec2 size);

// The views of what a station is expected to get (ColourMode::expected_*), over the picture of the scene.
void drawExpected(Editor& editor, ImVec2 origin, ImVec2 size);
void drawExpectedLegend(Editor& editor, ImVec2 origin, ImVec2 size);  // with what the pointer is on
void expectedChips(Editor& editor);                                   // instrument, place

// The probe follows the pointer while it is dragged. True while the pointer is on it or drags it.
bool dragProbe(Editor& editor, ImVec2 origin, bool hovered);
void putProbeOn(Editor& editor, const Eigen::Vector3d& floor);

std::optional<ExpectedQuantity> expectedQuantity(ColourMode mode);

}  // namespace standpoint
