// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace standpoint {

struct OptimiseState {
  double budget_fraction = 0.25;  // of the imported model's triangles
  bool only_lossless = false;
  double max_deviation_mm = 15;
  bool by_view = false;         // what walkers see weighs more
  bool live = false;            // the view follows the sliders
  std::string engine = "auto";  // one of engineChoices()
};

}  // namespace standpoint
