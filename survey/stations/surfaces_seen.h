// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scanners/forecast/surface_samples.h"

namespace standpoint {

// A part of the scene's surface, counted in samples.
struct SurfaceCoverage {
  std::string name;                                // a class, a storey, or a product's id
  std::uint32_t product = 0;                       // of a product's share
  std::uint64_t exposed = 0, seen = 0, twice = 0;  // twice: from two stations or more
  double coverage() const { return exposed == 0 ? 0 : static_cast<double>(seen) / static_cast<double>(exposed); }
};

// What two stations have in common; the share of the one that sees less is the overlap.
struct StationPair {
  std::size_t a = 0, b = 0;  // of the stations that were counted
  double common_m2 = 0, of_a = 0, of_b = 0;
  double overlap() const { return of_a > of_b ? of_a : of_b; }
};

// What of the scene's surface stations see, be it forecast or measured.
struct SurfacesSeen {
  SurfaceCoverage all;
  std::vector<SurfaceCoverage> classes, storeys, holes;  // holes: products, by what of them is not seen
  std::vector<double> seen_m2;                           // of each station
  std::vector<StationPair> pairs;
};

// `seen`: of each station, a 1 for each sample that it sees and that is exposed, else a 0.
using SeenByStation = std::span<const std::vector<std::uint8_t>* const>;
SurfacesSeen countSeen(const SurfaceSamples& samples, const Environment& environment, SeenByStation seen);

}  // namespace standpoint
