// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "optimizer/simplify/collapses/collapser.h"

namespace standpoint {

// The cheapest steps of all logs, each of which is in order, until no more than `enough` of the `triangles` are left:
// what one queue over all of them would do. Put in order side by side. Keeps a reference to the logs.
class CheapestSteps {
 public:
  CheapestSteps(const std::vector<std::vector<Step>>& logs, std::size_t triangles, std::size_t enough);
  const std::vector<Step>& steps() const { return steps_; }
  std::size_t taken(std::size_t log) const { return taken_[log]; }

 private:
  struct Stretch {
    std::vector<std::size_t> from;  // in each log
    std::size_t first = 0, triangles = 0;
  };
  void findStretches();
  void merge(const Stretch& stretch, const std::vector<std::size_t>& to);

  const std::vector<std::vector<Step>>& logs_;
  std::vector<Stretch> stretches_;
  std::vector<Step> steps_;
  std::vector<std::size_t> taken_;
};

}  // namespace standpoint
