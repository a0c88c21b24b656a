// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/camera/navigation_cube.h"

#include <cmath>
#include <numbers>

namespace standpoint {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kCubeRim = 0.58;  // of a half edge: what is farther out belongs to an edge or a corner

Vector2d onCubePicture(const Camera& camera, const Vector3d& p) { return {p.dot(camera.right()), -p.dot(camera.up())}; }

int cubeThird(double along) { return along > kCubeRim ? 1 : along < -kCubeRim ? -1 : 0; }
double lowEnd(int third) { return third == 0 ? -kCubeRim : third < 0 ? -1 : kCubeRim; }
double highEnd(int third) { return third == 0 ? kCubeRim : third < 0 ? -kCubeRim : 1; }

std::array<Vector2d, 4> facePatch(const Camera& camera, const CubeFace& face, double a0, double a1, double u0,
                                  double u1) {
  const auto at = [&](double a, double u) {
    return onCubePicture(camera, face.normal + a * face.across + u * face.up);
  };
  return {at(a0, u0), at(a1, u0), at(a1, u1), at(a0, u1)};
}

}  // namespace

std::vector<CubeFace> cubeFaces(const Camera& camera) {
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();
  const std::array faces = {CubeFace{-y, x, z, "Front", 0, {}}, CubeFace{y, -x, z, "Back", 0, {}},
                            CubeFace{-x, -y, z, "Left", 0, {}}, CubeFace{x, y, z, "Right", 0, {}},
                            CubeFace{z, x, y, "Top", 0, {}},    CubeFace{-z, x, -y, "Bottom", 0, {}}};
  std::vector<CubeFace> seen;
  for (auto face : faces) {
    face.turned_here = -face.normal.dot(camera.forward());
    if (face.turned_here < 0.02) continue;
    face.corners = facePatch(camera, face, -1, 1, -1, 1);
    seen.push_back(face);
  }
  return seen;
}

std::optional<Eigen::Vector3i> cubePartAt(const Camera& camera, const Vector2d& place) {
  for (const auto& face : cubeFaces(camera)) {
    Eigen::Matrix2d axes;
    axes << onCubePicture(camera, face.across), onCubePicture(camera, face.up);
    const Vector2d at = axes.inverse() * (place - onCubePicture(camera, face.normal));
    if (at.cwiseAbs().maxCoeff() > 1) continue;
    return (face.normal + cubeThird(at.x()) * face.across + cubeThird(at.y()) * face.up)
        .array()
        .round()
        .cast<int>()
        .matrix();
  }
  return std::nullopt;
}

std::vector<std::array<Vector2d, 4>> cubePartOutline(const Camera& camera, const Eigen::Vector3i& part) {
  std::vector<std::array<Vector2d, 4>> outline;
  const Vector3d to = part.cast<double>();
  for (const auto& face : cubeFaces(camera)) {
    if (to.dot(face.normal) < 0.5) continue;
    const int a = static_cast<int>(std::lround(to.dot(face.across))),
              u = static_cast<int>(std::lround(to.dot(face.up)));
    outline.push_back(facePatch(camera, face, lowEnd(a), highEnd(a), lowEnd(u), highEnd(u)));
  }
  return outline;
}

void lookFromCubePart(Camera& camera, const Eigen::Vector3i& part) {
  const Vector3d from = part.cast<double>().normalized();
  camera.elevation_rad = std::asin(from.z());
  constexpr double kQuarter = std::numbers::pi / 2;
  camera.azimuth_rad = part.x() == 0 && part.y() == 0
                           ? kQuarter * std::round(camera.azimuth_rad / kQuarter)  // as it is turned already
                           : std::atan2(from.x(), -from.y());
  camera.orthographic = part.cwiseAbs().sum() == 1;
}

}  // namespace standpoint
