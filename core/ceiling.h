// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment.h"

namespace standpoint {

// It is level and bears nobody.
inline bool isSuspendedCeiling(const Product& product) {
  return product.ifc_class == "IfcCovering" && product.predefined_type == "CEILING";
}

}  // namespace standpoint
