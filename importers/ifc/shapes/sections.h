// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/geometry/kernel.h"

namespace standpoint::ifc {

// Whether two cross sections have the same loops with the same numbers of points, so that one can turn into the other.
bool alike(const geometry::Region2& a, const geometry::Region2& b);
// a at t = 0, b at t = 1; they are alike.
geometry::Region2 blend(const geometry::Region2& a, const geometry::Region2& b, double t);

}  // namespace standpoint::ifc
