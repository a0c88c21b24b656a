// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

#include "scanners/engine/edge_map.h"
#include "scanners/engine/footprint.h"

namespace standpoint {

constexpr int kMostStrips = BeamEdges::kMost + 1;

// A beam in which straight edges run side by side, as one edge does, a wire's two or the facets of a pipe: they cut it
// into strips, and of each strip of a Gaussian beam the share of the power and the mean place are known. Between edges
// at a and b, in w across them, these are Q(2a) - Q(2b) and ½ (φ(2a) - φ(2b)) / (Q(2a) - Q(2b)), φ the density of the
// normal distribution and Q its tail. A ray through each mean place stands for its strip.
//
// `draw`: the pulse's random numbers. The shares of one pulse stray from these as those of drawn rays do (footprint.h),
// so that an edge along the grid shows no layers.
// The number of rays; 1: no edge is in the beam; 0: the edges do not lie so.
int drawStrips(const EmbreeScene& scene, const Instrument& instrument, const Beam& beam, const BeamEdges& edges,
               const std::array<std::uint32_t, 4>& draw, SubRay* rays);

}  // namespace standpoint
