// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "importers/ifc/model/model.h"

namespace standpoint::ifc {

// host − tools. Tools along a common direction with the host go the kernel's way in the plane; other convex tools,
// which most openings and half-spaces are, are taken away by their planes, which always comes out the same; only what
// is left goes the kernel's general ways. An error says that the host must stay as it is.
Result<geometry::PolyMesh> subtractTools(const geometry::PolyMesh& host, std::span<const geometry::PolyMesh> tools);

// The same without the general ways: an error where a tool is neither along a common direction nor convex.
Result<geometry::PolyMesh> subtractSimpleTools(const geometry::PolyMesh& host,
                                               std::span<const geometry::PolyMesh> tools);

}  // namespace standpoint::ifc
