// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "scanners/engine/embree_scene.h"
#include "scanners/pictures/picture.h"

namespace standpoint {

// How images on surfaces scale the reflectance of their materials: the luminance at a place (Rec. 709, linear) over its
// mean on all of the surface, by area, so that the material's own reflectance stays in the mean. A picture was taken in
// visible light and says nothing of what its inks do in the infrared. Surfaces whose image has the light in it (unlit)
// are left alone. Immutable; thread-safe.
class SurfacePaint {
 public:
  explicit SurfacePaint(const Environment& environment);
  bool empty() const;  // no surface is painted
  bool paints(const Facet& facet) const;
  // Of a facet that is painted, at a place on it in the local frame.
  float factor(const Facet& facet, const Eigen::Vector3d& place) const;

 private:
  struct Paint {
    const Picture* picture = nullptr;  // null: plain
    float inverse_mean = 1;
  };
  void findMean(std::uint32_t surface);

  const Environment& environment_;
  std::vector<std::optional<Picture>> pictures_;  // by image, of those that are asked for
  std::vector<Paint> paints_;                     // by surface
};

}  // namespace standpoint
