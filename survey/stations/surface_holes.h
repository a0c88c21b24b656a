// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "scanners/forecast/surface_samples.h"

namespace standpoint {

using HoleSquare = std::array<int, 2>;                     // how many sides to the right and up
using HoleEdge = std::array<HoleSquare, 2>;                // between two corners
std::vector<HoleEdge> rimOf(const std::set<HoleSquare>&);  // where squares end, as far as it runs straight

// What a hole looks like: squares in its plane. Local frame.
struct HoleShape {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // unit; that of the triangles
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::UnitX(),  // a side of a square; level, but for a level plane's X
      up = Eigen::Vector3d::UnitY();                 // the other side
  std::vector<HoleSquare> squares;                   // ascending
  Eigen::Vector3d corner(const HoleSquare& s) const { return origin + s[0] * right + s[1] * up; }  // the lower left one
  Eigen::Vector3d middle(const HoleSquare& s) const { return corner(s) + (right + up) / 2; }
};

// A part of a product's surface that light gets to and that no station sees: what hangs together and is about even.
struct SurfaceHole {
  std::uint32_t product = 0;
  double area_m2 = 0;
  std::optional<double> spacing_m;               // median on what is seen of the product; nothing: all of it is hidden
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  // on the hole, near its middle; local frame
  HoleShape shape;
};

constexpr std::size_t kMostPatches = 250;  // that are listed

// Largest first, no more than `most`, and none that fewer than four samples show. `spacing_m`: of each sample the
// spacing of the points on it, 0 where no station sees it.
std::vector<SurfaceHole> surfaceHoles(const SurfaceSamples& samples, std::span<const double> spacing_m,
                                      std::size_t most);

}  // namespace standpoint
