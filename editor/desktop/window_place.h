// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

namespace standpoint {

// Of a window without its frame, in the desktop's units. Of a maximised one it is where it goes back to.
struct WindowPlace {
  int x = 0, y = 0, width = 1280, height = 800;
  bool maximised = false;
  bool operator==(const WindowPlace&) const = default;
};

// Of a monitor, without what is always in front there: panels, docks.
struct MonitorArea {
  int x = 0, y = 0, width = 0, height = 0;
};

// The same on what there is now: wholly on that monitor which shows most of it, or on the first, and no larger than
// that. Without monitors as it was.
WindowPlace onMonitors(WindowPlace place, std::span<const MonitorArea> monitors);

}  // namespace standpoint
