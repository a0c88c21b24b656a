// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/statistics/distribution.h"

#include <algorithm>
#include <cmath>

namespace standpoint {

void Moments::add(double v) {
  ++n;
  const double before = v - mean;
  mean += before / static_cast<double>(n);
  squares += before * (v - mean);
}

double Moments::sigma() const { return n < 2 ? 0 : std::sqrt(squares / static_cast<double>(n - 1)); }

Distribution distributionOf(std::vector<double> values) {
  Distribution d;
  if (values.empty()) return d;
  std::sort(values.begin(), values.end());
  Moments moments;
  for (const double v : values) moments.add(v);
  const auto at = [&](double fraction) {
    return values[static_cast<std::size_t>(std::lround(fraction * static_cast<double>(values.size() - 1)))];
  };
  return {moments.n, moments.mean, moments.sigma(), at(0.05), at(0.5), at(0.95)};
}

}  // namespace standpoint
