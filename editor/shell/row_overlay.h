// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <imgui.h>

namespace standpoint {

struct Editor;

// How many stations a row has, or how far apart they stand, while one is laid.
void rowChips(Editor& editor);
// A tripod for each of them, in the verdict of its place.
void drawRow(Editor& editor, ImVec2 origin);

}  // namespace standpoint
