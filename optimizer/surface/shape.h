// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/mesh.h"

namespace standpoint {

// A mesh made ready for simplification: welded, in double, about its own centre.
struct Shape {
  std::vector<Eigen::Vector3d> positions;  // minus centre
  std::vector<Triangle> triangles;         // no two corners alike, no triangle twice
  std::vector<std::uint32_t> surface_of_triangle;
  std::vector<Triangle> wedges;  // painted meshes only: for each corner the position of the mesh whose paint it has
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d half_size = Eigen::Vector3d::Zero();

  double diagonal() const { return 2 * half_size.norm(); }
  // What rounding to float does to a coordinate of this shape: below it two positions are the same.
  double rounding() const;
};

struct SurfacePoint {
  std::uint32_t triangle = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

// What weld() took away.
struct WeldCounts {
  std::uint64_t positions = 0, degenerate = 0, repeated = 0;
};

// Whether it has texture coordinates or colours.
bool isPainted(const Mesh& mesh);

// Equal positions become one vertex; triangles with two equal corners, and exact repetitions of a triangle of the same
// surface and orientation, are left out. Neither moves the surface.
Shape weld(const Mesh& mesh, WeldCounts* counts = nullptr);

// Back to float and the mesh's own frame, without unused positions.
Mesh meshOf(const Shape& shape);

// Directions of the faces (either sense), largest total area first, no two closer than half a degree.
std::vector<Eigen::Vector3d> faceDirections(const Shape& shape);

}  // namespace standpoint
