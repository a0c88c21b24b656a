// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "importers/ifc/model.h"

namespace standpoint::ifc {

// host − tools: the kernel's way first, all at once. Where that fails, each convex tool is taken away by cuts with its
// planes alone: what is outside of each plane in turn stays, and the parts touch with faces inside the body, which no beam
// meets; the report then warns. An error when a tool is not convex either.
Result<geometry::PolyMesh> subtractOrCut(const geometry::PolyMesh& host, std::span<const geometry::PolyMesh> tools, const Entity& place, Report& report);

}  // namespace standpoint::ifc
