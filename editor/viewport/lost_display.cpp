// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/lost_display.h"

#include <X11/Xlib.h>
#include <cstdlib>
#include <iostream>
#include <utility>

namespace standpoint {

namespace {

constexpr int kExitCode = 4;  // as where a file cannot be reached

std::function<void()> to_be_done;

// Destructors and what is registered for the end would talk to the display again.
int endWithoutDisplay(Display*) {
  if (const auto act = std::exchange(to_be_done, nullptr)) act();
  std::cerr << "standpoint-editor: the display was lost; unsaved work is kept, and the next start offers it\n";
  std::_Exit(kExitCode);
}

}  // namespace

void whenDisplayIsLost(std::function<void()> act) {
  XSetIOErrorHandler(act ? endWithoutDisplay : nullptr);
  to_be_done = std::move(act);
}

}  // namespace standpoint
