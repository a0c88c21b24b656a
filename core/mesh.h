// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace standpoint {

using Triangle = std::array<std::uint32_t, 3>;  // counter-clockwise seen from outside

// A triangle mesh in metres, float positions in its own frame (keep them small: see Instance).
// Invariants, which validate() checks and every producer keeps:
//  - every index < positions.size(), every position finite;
//  - surface_of_triangle.size() == triangles.size(), each an index into Environment::surfaces;
//  - triangles are sorted by surface (stable), so that a mesh survives a glTF file unchanged;
//  - texture_coordinates and colours are empty or have one entry for each position, every coordinate finite. Where two
//    faces meet at a seam of the texture, the position stands there twice, as in glTF.
struct Mesh {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> surface_of_triangle;
  std::vector<Eigen::Vector2f> texture_coordinates;  // (0, 0) is the image's upper left corner, as in glTF
  std::vector<std::array<std::uint8_t, 4>> colours;  // sRGB and alpha; multiplies the surface's colour
};

// Sorts the triangles by surface, stably. Producers call it last.
void sortBySurface(Mesh& mesh);

// Empty when the invariants hold, else what is wrong.
std::string validate(const Mesh& mesh, std::size_t surface_count);

// Sum of triangle areas in m².
double area(const Mesh& mesh);

// Signed volume by the divergence theorem in m³; meaningful when isClosed().
double volume(const Mesh& mesh);

// True when, after welding equal positions, each edge is used as often in one direction as in the other.
bool isClosed(const Mesh& mesh);

}  // namespace standpoint
