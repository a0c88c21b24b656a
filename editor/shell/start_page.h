// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <imgui.h>

namespace standpoint {

struct Editor;

// Whether nothing is open that could be shown instead.
bool wantsStartPage(const Editor& editor);

// In the current window, which has this size: begin something, samples with pictures, what was open before.
void drawStartPage(Editor& editor, ImVec2 size);

}  // namespace standpoint
