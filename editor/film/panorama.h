// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>

#include <Eigen/Core>

#include "core/result.h"
#include "editor/camera/camera.h"
#include "editor/model/view_state.h"

namespace standpoint {

// A spherical picture (equirectangular): twice as wide as high; the middle looks level along `azimuth_rad` of a Camera,
// columns turn to the right by equal angles, rows go from the zenith to the nadir.

// Where a direction is in it: pixels from the top left, the centre of the first one at 0.5.
Eigen::Vector2d pixelOfDirection(const Eigen::Vector3d& direction, double azimuth_rad, int width, int height);
Eigen::Vector3d directionOfPixel(const Eigen::Vector2d& pixel, double azimuth_rad, int width, int height);

// The six pictures that it is put together from. They overlap by a pixel on each side, so that nothing is read beyond
// an edge, and show what is there in at least as many pixels as the panorama will have.
constexpr int kFaces = 6;
int faceSize(int panorama_width);
Camera faceCamera(int face, const Eigen::Vector3d& eye, double azimuth_rad, int face_size);

// From the six faces, in their order.
PixelPicture panoramaOf(const std::array<PixelPicture, kFaces>& faces, double azimuth_rad, int width, int height);

}  // namespace standpoint
