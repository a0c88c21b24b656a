// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/environment.h"

namespace standpoint {

// It is level and bears nobody.
inline bool isSuspendedCeiling(const Product& product) {
  return product.ifc_class == "IfcCovering" && product.predefined_type == "CEILING";
}

// A roof or a part of one, or a suspended ceiling: whatever its slope, one does not walk on it.
inline bool isRoofOrCeiling(const Environment& environment, std::uint32_t product) {
  auto at = static_cast<std::int32_t>(product);
  for (int depth = 0; depth < 32 && at >= 0; ++depth) {  // a file may make a ring of parts
    const auto& part = environment.products[static_cast<std::size_t>(at)];
    if (part.ifc_class == "IfcRoof" || (part.ifc_class == "IfcSlab" && part.predefined_type == "ROOF") ||
        isSuspendedCeiling(part))
      return true;
    at = part.whole;
  }
  return false;
}

// Of each product.
inline std::vector<bool> roofsAndCeilings(const Environment& environment) {
  std::vector<bool> result;
  for (std::uint32_t i = 0; i < environment.products.size(); ++i) result.push_back(isRoofOrCeiling(environment, i));
  return result;
}

}  // namespace standpoint
