// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/surface/triangle_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "optimizer/surface/triangle_tree.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

// Of segments p0-p1 and q0-q1 (Ericson, Real-Time Collision Detection, 5.1.9).
NearestPoints nearestPoints(const Vector3d& p0, const Vector3d& p1, const Vector3d& q0, const Vector3d& q1) {
  const Vector3d d1 = p1 - p0, d2 = q1 - q0, r = p0 - q0;
  const double a = d1.squaredNorm(), e = d2.squaredNorm(), f = d2.dot(r), c = d1.dot(r), b = d1.dot(d2);
  double s = 0, t = 0;
  if (a <= 0 && e <= 0) return {p0, q0};
  if (a <= 0) {
    t = std::clamp(f / e, 0.0, 1.0);
  } else if (e <= 0) {
    s = std::clamp(-c / a, 0.0, 1.0);
  } else {
    const double determinant = a * e - b * b;
    s = determinant > 0 ? std::clamp((b * f - c * e) / determinant, 0.0, 1.0) : 0;
    t = (b * s + f) / e;
    if (t < 0) {
      t = 0;
      s = std::clamp(-c / a, 0.0, 1.0);
    } else if (t > 1) {
      t = 1;
      s = std::clamp((b - c) / a, 0.0, 1.0);
    }
  }
  return {p0 + s * d1, q0 + t * d2};
}

// Whether the segment passes through the triangle's inside.
bool pierces(const Vector3d& p, const Vector3d& q, const Corners& t) {
  const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double dp = normal.dot(p - t[0]), dq = normal.dot(q - t[0]);
  if (dp * dq > 0 || dp == dq) return false;
  const Vector3d x = p + (q - p) * (dp / (dp - dq));
  for (int k = 0; k < 3; ++k)
    if (normal.dot((t[(k + 1) % 3] - t[k]).cross(x - t[k])) < 0) return false;
  return true;
}

}  // namespace

double distance(const Corners& a, const Corners& b) {
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    if (pierces(a[i], a[(i + 1) % 3], b) || pierces(b[i], b[(i + 1) % 3], a)) return 0;
    best = std::min({best, (closestPoint(a[i], b[0], b[1], b[2]) - a[i]).squaredNorm(),
                     (closestPoint(b[i], a[0], a[1], a[2]) - b[i]).squaredNorm()});
    for (int k = 0; k < 3; ++k)
      best = std::min(best, nearestPoints(a[i], a[(i + 1) % 3], b[k], b[(k + 1) % 3]).squaredDistance());
  }
  return std::sqrt(best);
}

std::optional<NearestPoints> nearestPoints(const Vector3d& p, const Vector3d& q, const Corners& t) {
  if (pierces(p, q, t)) return std::nullopt;
  NearestPoints best{p, closestPoint(p, t[0], t[1], t[2])};
  const auto take = [&](const NearestPoints& other) {
    if (other.squaredDistance() < best.squaredDistance()) best = other;
  };
  take({q, closestPoint(q, t[0], t[1], t[2])});
  for (int k = 0; k < 3; ++k) take(nearestPoints(p, q, t[k], t[(k + 1) % 3]));
  return best;
}

}  // namespace standpoint
