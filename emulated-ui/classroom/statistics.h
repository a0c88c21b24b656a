// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "emulated-ui/rehearsal/marks.h"

namespace standpoint {

// How a criterion, a step or a rule, worked in a class. Figures that too few results cannot tell are left out.
struct CriterionStatistics {
  std::string id, text;
  bool rule = false, must = false;
  std::size_t met = 0, of = 0;                 // results
  double facility = 0;                         // mean share of its points
  double facility_low = 0, facility_high = 0;  // 95 % interval (Wilson) of the share that met it
  std::optional<double> correlation;           // with the points for all else; from 20 results on
  std::optional<double> discrimination;        // best 27 % less worst 27 %; from 20 results on
};
// Correlations need so many results.
constexpr std::size_t kEnoughResults = 20;

struct ClassStatistics {
  std::size_t results = 0, passed = 0;
  double mean = 0;              // of the scores, 0 to 1
  std::optional<double> alpha;  // Cronbach's; from 20 results on
  std::vector<CriterionStatistics> criteria;
};

// Of the same exercise, in any variant. None: all is zero.
ClassStatistics statisticsOf(const std::vector<const Marks*>& marks);

// What went wrong: the mistakes of broken rules ("M03"), else the first step that was not done ("step level"), else
// broken rules by their ids. The most important first.
std::vector<std::string> mistakesOf(const Marks& marks);

}  // namespace standpoint
