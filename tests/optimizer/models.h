// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/environment.h"

namespace standpoint::models {

// Closed, with radius r; 2 * rings * segments - 2 * segments triangles.
Mesh sphere(double radius, int rings, int segments);
Mesh torus(double radius, double tube, int rings, int segments);
// Closed box from the origin to `size`, each face a grid of n x n cells; the six faces may have surfaces of their own.
Mesh box(const Eigen::Vector3d& size, int n, bool surface_per_face = false);
Mesh cylinder(double radius, double height, int segments, int rows);
// Upright plate with a rectangular hole, as a grid with cells of `cell`, of two surfaces with a border at half height.
Mesh plateWithHole(double width, double height, double hole, double cell);

void append(Mesh& mesh, const Mesh& other, const Eigen::Affine3d& place = Eigen::Affine3d::Identity());

// Adds a product with one instance of a mesh of its own.
void add(Environment& environment, Mesh mesh, const std::string& ifc_class = "",
         const Eigen::Affine3d& place = Eigen::Affine3d::Identity());

// Largest distance of any of a's sampled points (vertices, centres and points by area) from b, by exhaustion.
double farthest(const Mesh& a, const Mesh& b, int samples);
double meanDistance(const Mesh& a, const Mesh& b, int samples);

}  // namespace standpoint::models
