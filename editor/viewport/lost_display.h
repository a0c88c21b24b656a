// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

namespace standpoint {

// Xlib ends the program when its connection breaks: the X server has crashed, or somebody has logged out. Before that,
// `act` is called once, on the thread that talks to the display; nothing may be drawn then. An empty one: nothing is.
// The program then ends with exit code 4.
void whenDisplayIsLost(std::function<void()> act);

}  // namespace standpoint
