// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

namespace standpoint {

struct Distribution {
  std::uint64_t samples = 0;
  double mean = 0, sigma = 0;
  double p5 = 0, median = 0, p95 = 0;
};

// Running mean and variance (Welford 1962).
struct Moments {
  std::uint64_t n = 0;
  double mean = 0, squares = 0;
  void add(double v);
  double sigma() const;
};

Distribution distributionOf(std::vector<double> values);

}  // namespace standpoint
