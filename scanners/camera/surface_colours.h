// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/report.h"
#include "scanners/engine/ray_engine.h"
#include "scanners/pictures/picture.h"

namespace standpoint {

// What the surfaces of an environment look like at a point: colour, vertex colours and image together.
class SurfaceColours {
 public:
  // Decodes the images; one that cannot be is a warning, and its surfaces have their plain colour.
  SurfaceColours(const Environment& environment, Report& report);
  struct Look {
    Eigen::Array3f colour;  // linear
    float opacity;
    bool unlit;
  };
  Look at(const RayHit& hit) const;  // thread-safe

 private:
  const Environment& environment_;
  std::vector<Eigen::Array3f> plain_;  // linear, of each surface
  std::vector<Picture> pictures_;
};

float linearOf(float srgb);
std::uint8_t srgbOf(float linear);  // clamped

}  // namespace standpoint
