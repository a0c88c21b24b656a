// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/geometry/kernel.h"

namespace standpoint::ifc {

// Whether faces lie back to back: a sheet without thickness, which a Boolean leaves where a tool's face fell on the
// host's and rounding put it a hair short of it.
bool hasFlaps(const geometry::PolyMesh& mesh);

// The tool with every face moved outwards by that much; corners go where their faces meet then.
geometry::PolyMesh grown(geometry::PolyMesh tool, double by_m);

}  // namespace standpoint::ifc
