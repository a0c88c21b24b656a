// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <vector>

#include "scanners/engine/footprint.h"
#include "scanners/engine/scan_plan.h"
#include "scanners/engine/timed_scene.h"

namespace standpoint {

// A facet with what the scan needs to know of its material.
struct MetFacet {
  std::uint64_t number = kNoFacet;
  Facet facet;
  const Optics* optics = nullptr;
  std::uint32_t material = 0;  // label
  bool plain = true;           // light that meets it goes nowhere but back, and as much of it everywhere
  bool painted = false;        // an image scales its reflectance
  float factor = 1;            // of the diffuse reflectance: this surface's over its material's

  // Is what a ray beside it meets the same surface to a beam? A facet in the same plane is, or one that bends away
  // gently.
  bool holds(const RayLine& line, const NearestHit& hit, double tolerance_m) const {
    if (hit.facet == kNoFacet) return false;
    if (hit.facet == number) return true;
    const double range = (facet.offset - facet.normal.dot(line.origin)) / facet.normal.dot(line.direction);
    return std::abs(range - static_cast<double>(hit.range_m)) < tolerance_m;
  }
};

// Facets looked up lately. For one thread; what it answers does not depend on what was asked before.
class FacetCache {
 public:
  FacetCache(const ScanPlan& plan, TimedScene& scene);
  // Good until the next call.
  const MetFacet& of(std::uint64_t number) {
    MetFacet& entry = entries_[(number * 0x9E3779B97F4A7C15ULL) >> (64U - kBits)];
    if (entry.number != number) lookUp(number, entry);
    return entry;
  }
  // With the plane that a ray meets at that time.
  MetFacet met(std::uint64_t number, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction_unit,
               double time_s) {
    MetFacet met = of(number);
    met.facet = scene_.at(met.facet, time_s).metBy(origin, direction_unit);
    return met;
  }

 private:
  static constexpr unsigned kBits = 12;
  void lookUp(std::uint64_t number, MetFacet& entry) const;
  std::int32_t materialAt(const Facet& facet) const;

  const ScanPlan& plan_;
  TimedScene& scene_;
  std::vector<MetFacet> entries_;
};

}  // namespace standpoint
