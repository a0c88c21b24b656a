// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment.h"
#include "core/report.h"

namespace standpoint {

// Materials, treatments and updates follow a product by its GlobalId. A warning for each product that has the one of
// another before it; with `first` for those from there on that have the one of a product before `first`.
void warnOfSharedGlobalIds(const Environment& environment, std::size_t first, Report& report);

}  // namespace standpoint
