// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace standpoint {

struct Editor;

// In the current window: what is under the pointer, else what the model has; at the right the task that runs with its
// progress, else the next step of the guide.
void drawStatusBar(Editor& editor);

}  // namespace standpoint
