// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "importers/ifc/model/model.h"

namespace standpoint::ifc {

// Takes from `body` what the tools that touch it hold; both in the element's frame. Where that fails the body stays as
// it was and the report says so.
void cutAway(geometry::PolyMesh& body, const std::vector<geometry::PolyMesh>& tools, const Entity& element,
             Report& report);

}  // namespace standpoint::ifc
