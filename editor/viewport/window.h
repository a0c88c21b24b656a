// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "core/result.h"
#include "editor/shell/editor.h"

namespace standpoint {

// Wakes a window that waits for events; may be called from any thread, also when there is no window.
void wakeWindow();

// Opens the window, shows the editor until it is quit. `size` in points.
Result<void> runWindow(Editor& editor, int width, int height);

}  // namespace standpoint
