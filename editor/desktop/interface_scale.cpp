// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/desktop/interface_scale.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace standpoint {

namespace {

constexpr double kLeastWidth = 760, kLeastHeight = 420;  // points that the areas need

}  // namespace

double neighbourScale(double now, int steps) {
  const auto nearest = std::min_element(kUserScales.begin(), kUserScales.end(),
                                        [&](double a, double b) { return std::abs(a - now) < std::abs(b - now); });
  const auto at = std::clamp<std::ptrdiff_t>(nearest - kUserScales.begin() + steps, 0, std::ssize(kUserScales) - 1);
  return kUserScales[static_cast<std::size_t>(at)];
}

double fittingScale(double monitor, double user, int width_px, int height_px) {
  for (double wanted = user; wanted > kUserScales.front(); wanted = neighbourScale(wanted, -1))
    if (wanted * monitor * kLeastWidth <= width_px && wanted * monitor * kLeastHeight <= height_px)
      return wanted * monitor;
  return std::min(user, kUserScales.front()) * monitor;
}

}  // namespace standpoint
