// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "core/result.h"
#include "editor/shell/editor.h"

namespace standpoint {

// Wakes a window that waits for events; may be called from any thread, also when there is no window.
void wakeWindow();

// Error::source where the window could not be opened because OpenGL is missing or too old.
constexpr const char* kNoOpenGl = "OpenGL";

// Opens the window, shows the editor until it is quit. Width and height in points; `after_crash` is remembered for the
// next start, should this one crash soon. `ready` is called just before the first frame: what it starts holds that up
// no more, neither by its work nor by a model to be drawn.
Result<void> runWindow(Editor& editor, int width, int height, bool after_crash, const std::function<void()>& ready);

}  // namespace standpoint
