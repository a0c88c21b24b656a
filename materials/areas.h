// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/environment.h"
#include "core/progress.h"
#include "core/result.h"

namespace standpoint {

// A surface of a product with all its placed triangles.
struct SurfaceOfProduct {
  std::uint32_t product = 0, surface = 0;
  double area_m2 = 0;
};

// By product, then surface.
Result<std::vector<SurfaceOfProduct>> measuredSurfaces(const Environment& environment, Progress& progress);

// How thick the solids are that a surface bounds, on average: 2 V / A of its triangles in the mesh, which for a pane is
// its thickness less some thousandths. 0 where they bound none: a pane without thickness.
double solidThickness(const Mesh& mesh, std::uint32_t surface);

}  // namespace standpoint
