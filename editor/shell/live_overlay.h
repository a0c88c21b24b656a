// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <imgui.h>

namespace standpoint {

struct Editor;
struct ViewState;

// Of a walk that is recorded or scanned: the way so far on the floor, red where it was too fast.
void drawWalkedRibbon(const Editor& editor, const ViewState& state, ImVec2 origin);
// Above `above_pt`: how the live scan goes, and above that a warning while somebody walks or turns too fast.
void drawLiveReadout(const Editor& editor, ImVec2 origin, ImVec2 size, float above_pt);
// While one walks: record, scan, with which instrument; and what colours live points, what that means, and what is done
// with them.
void walkingChips(Editor& editor);
void livePointChips(Editor& editor);

}  // namespace standpoint
