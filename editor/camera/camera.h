// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>

#include <Eigen/Geometry>

#include "core/environment.h"

namespace standpoint {

// A turntable camera: it looks at `target` from `distance_m`, turned by `azimuth_rad` around Z (0 = from the south,
// looking along +Y) and lifted by `elevation_rad`. The horizon stays level, as a building has a floor.
struct Camera {
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  double distance_m = 20;
  double azimuth_rad = 0.7;
  double elevation_rad = 0.5;
  double view_angle_rad = 0.7;  // vertical
  bool orthographic = false;    // then the picture is as high as the perspective one is at `target`
  bool operator==(const Camera&) const = default;

  Eigen::Vector3d forward() const;
  Eigen::Vector3d right() const;
  Eigen::Vector3d up() const;
  Eigen::Vector3d eye() const { return target - forward() * distance_m; }
  // From where a point is looked at: the eye, or for a parallel projection a place straight before the point.
  Eigen::Vector3d eyeOf(const Eigen::Vector3d& point) const;
  // Metres that one pixel covers at `depth_m` along the view.
  double metresPerPixel(double depth_m, double height_px) const;
  double heightAtTarget_m() const;
};

// Of so many directions all around the i-th to look in: the one of before first, then those beside it by turns.
double azimuthBeside(double before_rad, int i, int directions);
std::array<Eigen::Vector3d, 8> cornersOf(const Bounds& bounds);

struct ViewRay {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;  // unit
};

// Pixels have their origin at the top left of a picture of the given size.
ViewRay rayThrough(const Camera& camera, const Eigen::Vector2d& pixel, const Eigen::Vector2d& size);
// None when the point is behind the eye.
std::optional<Eigen::Vector2d> project(const Camera& camera, const Eigen::Vector3d& point, const Eigen::Vector2d& size);

// Drags, in pixels. orbit turns around `pivot`, which stays where it is in the picture.
void orbit(Camera& camera, const Eigen::Vector2d& drag_px, const Eigen::Vector3d& pivot);
void pan(Camera& camera, const Eigen::Vector2d& drag_px, const Eigen::Vector2d& size, double depth_m);
// `steps` > 0 comes closer; what lies at `anchor` stays under the pointer.
void zoom(Camera& camera, double steps, const Eigen::Vector3d& anchor);

// Shows all of `bounds` without turning.
void frame(Camera& camera, const Bounds& bounds, double aspect);

// Whether it shows a plan.
bool looksStraightDown(const Camera& camera);

enum class StandardView { front, back, left, right, top, bottom, corner };
void look(Camera& camera, StandardView view);

}  // namespace standpoint
