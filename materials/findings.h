// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "core/environment.h"
#include "materials/materials.h"

namespace standpoint {

// Gathers findings that have the same cause into one line: the first product stands for all, the rest are counted.
class FindingCollector {
 public:
  // `what` reads on with the product: "no rule fits surface 'X' of" … "IfcWall 'W1'", then `then`.
  struct Cause {
    bool warning;
    std::string what, ifc_class, then;
    auto operator<=>(const Cause&) const = default;
  };
  void add(Cause cause, std::uint32_t product, double area_m2);
  // Warnings first, then by falling area.
  std::vector<MaterialFinding> findings(const Environment& environment) const;

 private:
  struct Extent {
    std::uint32_t first = 0;
    std::uint32_t last = 0;
    std::size_t products = 0;
    double area_m2 = 0;
  };
  std::map<Cause, Extent> extents_;
};

}  // namespace standpoint
