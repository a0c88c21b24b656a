// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

namespace standpoint {

// Sizes of the interface that can be chosen, on top of the monitor's.
inline constexpr std::array kUserScales = {0.75, 0.9, 1.0, 1.1, 1.25, 1.5, 1.75, 2.0, 2.25, 2.5};
double neighbourScale(double now, int steps);  // the next larger or smaller of them
// Pixels per point of a window: as the user wants, but never so large that the interface has no room for its areas.
double fittingScale(double monitor, double user, int width_px, int height_px);

}  // namespace standpoint
