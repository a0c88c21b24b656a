// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "scanners/scan_plan.h"

namespace standpoint {

// A facet with what the scan needs to know of its material.
struct MetFacet {
  std::uint64_t number = kNoFacet;
  Facet facet;
  const Optics* optics = nullptr;
  std::uint32_t material = 0;      // label
  bool plain = true;               // light that meets it goes nowhere but back
};

// Facets looked up lately. For one thread; what it answers does not depend on what was asked before.
class FacetCache {
 public:
  explicit FacetCache(const ScanPlan& plan);
  // Good until the next call.
  const MetFacet& of(std::uint64_t number);

 private:
  std::int32_t materialAt(const Facet& facet) const;

  const ScanPlan& plan_;
  std::vector<MetFacet> entries_;
};

}  // namespace standpoint
