// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <vector>

namespace standpoint {

inline constexpr double kTukey = 4.685;  // 95 % efficiency for normal noise

// Tukey's biweight of a residual as a share of where it ends.
inline double tukeyWeight(double fraction) {
  const double rest = 1 - fraction * fraction;
  return rest > 0 ? rest * rest : 0;
}

// σ by the median of absolute residuals; reorders them.
inline double medianScale(std::vector<double>& absolute) {
  if (absolute.empty()) return 0;
  const auto middle = absolute.begin() + static_cast<std::ptrdiff_t>(absolute.size() / 2);
  std::nth_element(absolute.begin(), middle, absolute.end());
  return 1.4826 * *middle;
}

}  // namespace standpoint
