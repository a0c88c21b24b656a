// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <imgui.h>

#include "editor/shell/banners.h"

namespace standpoint {

struct Editor;
struct ViewState;

// Of a walk that is recorded or scanned: the way so far on the floor, red where it was too fast.
void drawWalkedRibbon(const Editor& editor, const ViewState& state, ImVec2 origin);
// How the live scan goes, and above that a warning while somebody walks or turns too fast; for a view of this width,
// px.
std::vector<Banner> liveReadouts(const Editor& editor, float width);
// While one walks: record, scan, with which instrument; and what colours live points, what that means, and what is done
// with them.
void walkingChips(Editor& editor);
void livePointChips(Editor& editor);

}  // namespace standpoint
