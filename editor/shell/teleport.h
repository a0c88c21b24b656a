// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <imgui.h>

namespace standpoint {

struct Editor;

// While T is held, or after the button, one aims with the pointer: releasing it, or a click, puts somebody there.
// `hovered`: the pointer is over the scene. True while one aims: then the pointer does nothing else.
bool aimTeleport(Editor& editor, bool hovered);
// A click soon after a tap of T, which has gone at once to where the pointer was, goes to where it is now. False: it is
// no such click.
bool clickAfterTap(Editor& editor);
bool goesOnByClick(const Editor& editor);
// Where one would stand, and towards where, or why not.
void drawTeleport(const Editor& editor, ImVec2 origin, bool over_view);

}  // namespace standpoint
