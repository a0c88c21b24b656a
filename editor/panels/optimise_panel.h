// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "project/document.h"

namespace standpoint {

struct OptimiseState {
  double budget_fraction = 0.25;  // of the imported model's triangles
  std::uint64_t asked = 0;        // triangles, when it was started last
  bool only_lossless = false;
  double max_deviation_mm = SimplificationRequest().max_deviation_m * 1000;
  bool by_view = false;  // what walkers see weighs more
  bool live = false;     // the view follows the sliders
  std::string engine = SimplificationRequest().engine;
  bool budget_wanted = false;                       // its field is to be edited
  std::shared_ptr<const SimplifiedModel> followed;  // whose request the form has begun with
};

}  // namespace standpoint
