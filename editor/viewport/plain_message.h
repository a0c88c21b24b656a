// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace standpoint {

// Shows a text in a window of its own until it is closed, by the X server alone: for what keeps the editor's window
// from opening, when somebody has started it from a menu and sees no terminal. False where there is no display.
bool showPlainMessage(const std::string& title, const std::string& text);

}  // namespace standpoint
