// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/film/panorama.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <tbb/parallel_for.h>

namespace standpoint {

namespace {

using std::numbers::pi;

using Rgba = std::array<std::uint8_t, 4>;

const Rgba& at(const PixelPicture& picture, int x, int y) {
  const int column = std::clamp(x, 0, picture.width - 1), row = std::clamp(y, 0, picture.height - 1);
  return picture
      .rgba[static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(column)];
}

// Between the centres of four pixels.
Rgba between(const PixelPicture& picture, const Eigen::Vector2d& pixel) {
  const double x = pixel.x() - 0.5, y = pixel.y() - 0.5;
  const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
  const double right = x - column, below = y - row;
  Rgba mixed{0, 0, 0, 255};
  for (std::size_t c = 0; c < 3; ++c) {
    const double upper = std::lerp(at(picture, column, row)[c], at(picture, column + 1, row)[c], right);
    const double lower = std::lerp(at(picture, column, row + 1)[c], at(picture, column + 1, row + 1)[c], right);
    mixed[c] = static_cast<std::uint8_t>(std::lround(std::lerp(upper, lower, below)));
  }
  return mixed;
}

// The four around, then up and down.
struct Turn {
  double azimuth_rad, elevation_rad;
};
constexpr std::array<Turn, kFaces> kTurns = {Turn{0, 0},      Turn{-pi / 2, 0}, Turn{pi, 0},
                                             Turn{pi / 2, 0}, Turn{0, -pi / 2}, Turn{0, pi / 2}};

}  // namespace

// Camera::azimuth_rad turns to the left, what is seen further right has the smaller one.
Eigen::Vector2d pixelOfDirection(const Eigen::Vector3d& direction, double azimuth_rad, int width, int height) {
  const double level = std::hypot(direction.x(), direction.y());
  const double azimuth = std::atan2(-direction.x(), direction.y());
  const double to_right = std::remainder(azimuth_rad - azimuth, 2 * pi);
  const double up = std::atan2(direction.z(), level);
  return {(0.5 + to_right / (2 * pi)) * width, (0.5 - up / pi) * height};
}

Eigen::Vector3d directionOfPixel(const Eigen::Vector2d& pixel, double azimuth_rad, int width, int height) {
  const double azimuth = azimuth_rad - (pixel.x() / width - 0.5) * 2 * pi;
  const double up = (0.5 - pixel.y() / height) * pi;
  return {-std::sin(azimuth) * std::cos(up), std::cos(azimuth) * std::cos(up), std::sin(up)};
}

// In its middle a face of n pixels has n / 2 for a radian, the panorama's equator width / 2π.
int faceSize(int panorama_width) { return 2 * static_cast<int>(std::ceil(panorama_width / (2 * pi))) + 2; }

Camera faceCamera(int face, const Eigen::Vector3d& eye, double azimuth_rad, int face_size) {
  const auto& turn = kTurns[static_cast<std::size_t>(face)];
  Camera camera;
  camera.azimuth_rad = azimuth_rad + turn.azimuth_rad;
  camera.elevation_rad = turn.elevation_rad;
  camera.view_angle_rad = 2 * std::atan(face_size / (face_size - 2.0));
  camera.distance_m = 1;
  camera.target = eye + camera.forward();
  return camera;
}

PixelPicture panoramaOf(const std::array<PixelPicture, kFaces>& faces, double azimuth_rad, int width, int height) {
  PixelPicture panorama{width, height, {}};
  panorama.rgba.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const int size = faces.front().width;
  std::array<Camera, kFaces> cameras;
  for (int f = 0; f < kFaces; ++f)
    cameras[static_cast<std::size_t>(f)] = faceCamera(f, Eigen::Vector3d::Zero(), azimuth_rad, size);
  // Each row for itself.
  tbb::parallel_for(0, height, [&](int row) {
    for (int column = 0; column < width; ++column) {
      const auto direction = directionOfPixel({column + 0.5, row + 0.5}, azimuth_rad, width, height);
      std::size_t best = 0;
      for (std::size_t f = 1; f < kFaces; ++f)
        if (direction.dot(cameras[f].forward()) > direction.dot(cameras[best].forward())) best = f;
      const auto pixel = project(cameras[best], direction, {size, size});
      panorama
          .rgba[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column)] =
          between(faces[best], pixel.value_or(Eigen::Vector2d::Zero()));
    }
  });
  return panorama;
}

}  // namespace standpoint
