// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/balls.h"

#include <algorithm>
#include <cmath>

#include "scanners/engine/face_meeting.h"

namespace standpoint {

namespace {

// b and h of the two ranges b - h and b + h; h² is negative where the line misses.
struct Passage {
  double middle = 0, half2 = 0;
};
Passage through(const PlacedBall& ball, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction_unit) {
  const Eigen::Vector3d to_centre = ball.centre - origin;
  const double middle = to_centre.dot(direction_unit);
  return {middle, ball.radius_m * ball.radius_m - (to_centre - middle * direction_unit).squaredNorm()};
}

void bounds(const RTCBoundsFunctionArguments* args) {
  const auto& ball = *static_cast<const PlacedBall*>(args->geometryUserPtr);
  const double reach =
      ball.radius_m * (1 + 1e-6) + 1e-6 * ball.centre.cwiseAbs().maxCoeff();  // more than a float's step
  auto& box = *args->bounds_o;
  box.lower_x = static_cast<float>(ball.centre.x() - reach), box.upper_x = static_cast<float>(ball.centre.x() + reach);
  box.lower_y = static_cast<float>(ball.centre.y() - reach), box.upper_y = static_cast<float>(ball.centre.y() + reach);
  box.lower_z = static_cast<float>(ball.centre.z() - reach), box.upper_z = static_cast<float>(ball.centre.z() + reach);
}

void intersectBall(const RTCIntersectFunctionNArguments* args) {
  const auto& ball = *static_cast<const PlacedBall*>(args->geometryUserPtr);
  const unsigned n = args->N;
  RTCRayN* rays = RTCRayHitN_RayN(args->rayhit, n);
  RTCHitN* hits = RTCRayHitN_HitN(args->rayhit, n);
  for (unsigned k = 0; k < n; ++k) {
    if (args->valid[k] == 0) continue;
    const Eigen::Vector3d origin(RTCRayN_org_x(rays, n, k), RTCRayN_org_y(rays, n, k), RTCRayN_org_z(rays, n, k));
    const Eigen::Vector3d along(RTCRayN_dir_x(rays, n, k), RTCRayN_dir_y(rays, n, k), RTCRayN_dir_z(rays, n, k));
    const double length = along.norm();
    const auto [middle, half2] = through(ball, origin, along / length);
    if (!(half2 >= 0)) continue;
    const double half = std::sqrt(half2), nearest = RTCRayN_tnear(rays, n, k);
    double range = (middle - half) / length;
    if (range < nearest) range = (middle + half) / length;
    if (!(range >= nearest)) continue;
    // Of what is met in the same cell the first of the scene, as of triangles (face_meeting.h).
    const float cell = endOfTieCell(range), farthest = RTCRayN_tfar(rays, n, k);
    const unsigned instance = RTCHitN_instID(hits, n, k, 0);
    const unsigned held = instance == RTC_INVALID_GEOMETRY_ID ? RTCHitN_geomID(hits, n, k) : instance;
    if (cell > farthest || (cell == farthest && args->geomID >= held)) continue;
    RTCRayN_tfar(rays, n, k) = cell;
    const Eigen::Vector3d normal = origin + range * along - ball.centre;
    RTCHitN_Ng_x(hits, n, k) = static_cast<float>(normal.x());
    RTCHitN_Ng_y(hits, n, k) = static_cast<float>(normal.y());
    RTCHitN_Ng_z(hits, n, k) = static_cast<float>(normal.z());
    RTCHitN_u(hits, n, k) = 0, RTCHitN_v(hits, n, k) = 0;
    RTCHitN_primID(hits, n, k) = 0;
    RTCHitN_geomID(hits, n, k) = args->geomID;
    RTCHitN_instID(hits, n, k, 0) = args->context->instID[0];
  }
}

}  // namespace

double rangeOnBall(const PlacedBall& ball, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction_unit) {
  const auto [middle, half2] = through(ball, origin, direction_unit);
  const double half = std::sqrt(std::max(0.0, half2));
  return middle > half ? middle - half : middle + half;
}

RTCGeometry ballGeometry(RTCDevice device, const PlacedBall& ball) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, 1);
  rtcSetGeometryUserData(geometry, const_cast<PlacedBall*>(&ball));  // Embree only hands it back
  rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersectBall);
  rtcCommitGeometry(geometry);
  return geometry;
}

}  // namespace standpoint
