// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/camera/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace standpoint {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kNearestDistance_m = 0.05;
constexpr double kFarthestDistance_m = 50000;
constexpr double kRadPerPixel = 0.006;  // half a turn for a drag of about 500 pixels

double wrapped(double angle_rad) { return std::remainder(angle_rad, 2 * kPi); }

}  // namespace

Eigen::Vector3d Camera::forward() const {
  const double c = std::cos(elevation_rad);
  return {-std::sin(azimuth_rad) * c, std::cos(azimuth_rad) * c, -std::sin(elevation_rad)};
}

Eigen::Vector3d Camera::right() const { return {std::cos(azimuth_rad), std::sin(azimuth_rad), 0}; }

Eigen::Vector3d Camera::up() const { return right().cross(forward()); }

double Camera::heightAtTarget_m() const { return 2 * distance_m * std::tan(view_angle_rad / 2); }

Eigen::Vector3d Camera::eyeOf(const Eigen::Vector3d& point) const {
  return orthographic ? Eigen::Vector3d(point - forward() * (point - eye()).dot(forward())) : eye();
}

double Camera::metresPerPixel(double depth_m, double height_px) const {
  const double depth = orthographic ? distance_m : depth_m;
  return 2 * depth * std::tan(view_angle_rad / 2) / std::max(height_px, 1.0);
}

double azimuthBeside(double before_rad, int i, int directions) {
  const int aside = (i + 1) / 2 * (i % 2 == 0 ? 1 : -1);
  return before_rad + 2 * kPi * aside / directions;
}

std::array<Eigen::Vector3d, 8> cornersOf(const Bounds& bounds) {
  std::array<Eigen::Vector3d, 8> corners;
  for (unsigned i = 0; i < corners.size(); ++i)
    corners[i] = {(i & 1U) != 0 ? bounds.max.x() : bounds.min.x(), (i & 2U) != 0 ? bounds.max.y() : bounds.min.y(),
                  (i & 4U) != 0 ? bounds.max.z() : bounds.min.z()};
  return corners;
}

ViewRay rayThrough(const Camera& camera, const Eigen::Vector2d& pixel, const Eigen::Vector2d& size) {
  const double scale = camera.metresPerPixel(camera.distance_m, size.y());
  const Eigen::Vector3d on_target_plane = camera.target + camera.right() * ((pixel.x() - size.x() / 2) * scale) +
                                          camera.up() * ((size.y() / 2 - pixel.y()) * scale);
  if (camera.orthographic) return {on_target_plane - camera.forward() * camera.distance_m, camera.forward()};
  return {camera.eye(), (on_target_plane - camera.eye()).normalized()};
}

std::optional<Eigen::Vector2d> project(const Camera& camera, const Eigen::Vector3d& point,
                                       const Eigen::Vector2d& size) {
  const Eigen::Vector3d seen = point - camera.eye();
  const double depth = seen.dot(camera.forward());
  if (!camera.orthographic && depth < 1e-6) return std::nullopt;
  const double scale = camera.metresPerPixel(depth, size.y());
  return Eigen::Vector2d(size.x() / 2 + seen.dot(camera.right()) / scale, size.y() / 2 - seen.dot(camera.up()) / scale);
}

void orbit(Camera& camera, const Eigen::Vector2d& drag_px, const Eigen::Vector3d& pivot) {
  // The pivot's place in the camera's own axes is kept while the axes turn.
  const Eigen::Vector3d seen = pivot - camera.target;
  const double x = seen.dot(camera.right()), y = seen.dot(camera.up()), z = seen.dot(camera.forward());
  camera.azimuth_rad = wrapped(camera.azimuth_rad - drag_px.x() * kRadPerPixel);
  camera.elevation_rad = std::clamp(camera.elevation_rad + drag_px.y() * kRadPerPixel, -kPi / 2, kPi / 2);
  camera.target = pivot - (camera.right() * x + camera.up() * y + camera.forward() * z);
}

void pan(Camera& camera, const Eigen::Vector2d& drag_px, const Eigen::Vector2d& size, double depth_m) {
  const double scale = camera.metresPerPixel(depth_m, size.y());
  camera.target += (camera.up() * drag_px.y() - camera.right() * drag_px.x()) * scale;
}

void zoom(Camera& camera, double steps, const Eigen::Vector3d& anchor) {
  const double wanted = camera.distance_m * std::pow(0.85, steps);
  const double distance = std::clamp(wanted, kNearestDistance_m, kFarthestDistance_m);
  const double fraction = distance / camera.distance_m;
  camera.target = anchor + (camera.target - anchor) * fraction;
  camera.distance_m = distance;
}

void frame(Camera& camera, const Bounds& bounds, double aspect) {
  if (bounds.empty()) return;
  const Eigen::Vector3d centre = (bounds.min + bounds.max) / 2;
  const double tangent_y = std::tan(camera.view_angle_rad / 2);
  const double tangent_x = tangent_y * std::max(aspect, 0.1);
  double distance = 0.2;
  for (const auto& corner : cornersOf(bounds)) {
    const Eigen::Vector3d d = corner - centre;
    const double nearer = camera.orthographic ? 0 : -d.dot(camera.forward());
    distance = std::max({distance, nearer + std::abs(d.dot(camera.right())) / tangent_x,
                         nearer + std::abs(d.dot(camera.up())) / tangent_y});
  }
  camera.target = centre;
  camera.distance_m = std::clamp(distance * 1.08, kNearestDistance_m, kFarthestDistance_m);
}

bool looksStraightDown(const Camera& camera) {
  constexpr double kStraight = 0.99999;  // a quarter of a degree
  return -camera.forward().z() > kStraight;
}

void look(Camera& camera, StandardView view) {
  camera.elevation_rad = 0;
  switch (view) {
    case StandardView::front: camera.azimuth_rad = 0; break;
    case StandardView::back: camera.azimuth_rad = kPi; break;
    case StandardView::left: camera.azimuth_rad = -kPi / 2; break;
    case StandardView::right: camera.azimuth_rad = kPi / 2; break;
    case StandardView::top: camera.azimuth_rad = 0, camera.elevation_rad = kPi / 2; break;
    case StandardView::bottom: camera.azimuth_rad = 0, camera.elevation_rad = -kPi / 2; break;
    case StandardView::corner: camera.azimuth_rad = 0.7, camera.elevation_rad = 0.5; break;
  }
}

}  // namespace standpoint
