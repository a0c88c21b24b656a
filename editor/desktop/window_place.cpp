// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/desktop/window_place.h"

#include <algorithm>
#include <cstdint>

namespace standpoint {

namespace {

int shared(int low_a, int size_a, int low_b, int size_b) {
  return std::max(0, std::min(low_a + size_a, low_b + size_b) - std::max(low_a, low_b));
}

std::int64_t shownOn(const MonitorArea& m, const WindowPlace& w) {
  return std::int64_t{shared(w.x, w.width, m.x, m.width)} * shared(w.y, w.height, m.y, m.height);
}

}  // namespace

WindowPlace onMonitors(WindowPlace place, std::span<const MonitorArea> monitors) {
  const auto most = std::max_element(monitors.begin(), monitors.end(), [&](const MonitorArea& a, const MonitorArea& b) {
    return shownOn(a, place) < shownOn(b, place);
  });
  if (most == monitors.end()) return place;
  place.width = std::min(place.width, most->width);
  place.height = std::min(place.height, most->height);
  place.x = std::clamp(place.x, most->x, most->x + most->width - place.width);
  place.y = std::clamp(place.y, most->y, most->y + most->height - place.height);
  return place;
}

}  // namespace standpoint
