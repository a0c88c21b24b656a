// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "scanners/engine/embree_scene.h"

namespace standpoint {

// Bodies that lie in each other share faces: a slab's edge in the plane of the wall that it runs into. Which of two
// such faces a ray meets first is a matter of rounding, and a picture of them is speckled. Here one of them is seen
// everywhere: an opaque one before a transparent one, then the one that comes first in the scene.
class CoincidentFacets {
 public:
  explicit CoincidentFacets(const EmbreeScene& scene);
  CoincidentFacets(const CoincidentFacets&) = delete;
  CoincidentFacets& operator=(const CoincidentFacets&) = delete;
  ~CoincidentFacets();
  // Puts the facet that is to be seen in the place of the one that was met. Thread-safe.
  void choose(const RayPacket& rays, int count, NearestHit* hits) const;

 private:
  struct Shared {
    std::uint64_t facet = 0;
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    bool transparent = false;
  };
  struct Choice;
  static void look(const RTCFilterFunctionNArguments* arguments);
  std::uint32_t indexOf(std::uint64_t facet) const {
    return index_[first_[facet >> 32U] + static_cast<std::uint32_t>(facet)];
  }

  std::vector<std::size_t> first_;    // of each placement, into index_
  std::vector<std::uint32_t> index_;  // of each facet, into shared_; or kAlone
  std::vector<Shared> shared_;        // facets whose plane has another surface in it, too
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

}  // namespace standpoint
