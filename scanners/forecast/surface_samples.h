// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "scanners/engine/ray_engine.h"
#include "scanners/forecast/expectation.h"

namespace standpoint {

// A place that stands for an equal share of the scene's surface.
struct SurfaceSample {
  SurfacePlace place;  // its normal is that of the triangle, whichever side is looked at
  std::uint32_t product = 0;
  bool exposed = false;  // light gets there: not where bodies touch, nor inside of one; a face of two is the first's
};

struct SurfaceSamples {
  std::vector<SurfaceSample> samples;  // in the order of the triangles
  double area_m2 = 0;                  // of all triangles in the scene, each once
  double each_m2() const { return samples.empty() ? 0 : area_m2 / static_cast<double>(samples.size()); }
};

// `count` places in strata of equal area, so that even small surfaces get their share; the same seed gives the same
// ones.
Result<SurfaceSamples> sampleSurfaces(const RayScene& scene, std::size_t count, std::uint64_t seed, Progress& progress);

// Could somebody at `eye` see the place, nearer than `most_range_m` and less slanting than that?
struct SightLimits {
  double max_range_m = 40;
  double min_cosine = 0.17;  // 80 degrees of incidence
  double min_elevation_rad = -1.0472, max_elevation_rad = 1.5708;
};
bool inSight(const RayScene& scene, const Eigen::Vector3d& eye, const SurfacePlace& place, const SightLimits& limits);

}  // namespace standpoint
