// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "editor/camera/camera.h"

namespace standpoint {

// A small cube that stands as the model does; each of its faces, edges and corners is a way to look at it. Places are
// in half edges of the cube from its middle, x to the right and y down.
struct CubeFace {
  Eigen::Vector3d normal, across, up;  // unit
  const char* name = "";
  double turned_here = 0;                  // cosine of the angle to the viewer; the face is seen where it is positive
  std::array<Eigen::Vector2d, 4> corners;  // of the picture of it
};
std::vector<CubeFace> cubeFaces(const Camera& camera);  // those that are seen

// To where the cube's part under this place points: a vector of -1, 0 and 1. Nothing beside the cube.
std::optional<Eigen::Vector3i> cubePartAt(const Camera& camera, const Eigen::Vector2d& place);
// Its outline, on each face that it is on.
std::vector<std::array<Eigen::Vector2d, 4>> cubePartOutline(const Camera& camera, const Eigen::Vector3i& part);
// From there to the middle: from a face in parallel and level, else in perspective.
void lookFromCubePart(Camera& camera, const Eigen::Vector3i& part);

}  // namespace standpoint
