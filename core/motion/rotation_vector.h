// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include <Eigen/Geometry>

#include "core/portable_math.h"
#include "core/units.h"

namespace standpoint {

// The rotation about the direction of `vector` by its length in radians, and back: exponential and logarithm of
// rotations, the same bits on every processor.
inline Eigen::Quaterniond rotationBy(const Eigen::Vector3d& vector) {
  const double square = vector.squaredNorm();
  if (square < 1e-8) {  // sin(a/2)/a and cos(a/2) by series; what is left out is below 1e-20
    const Eigen::Vector3d v = vector * (0.5 - square / 48 + square * square / 3840);
    return {1 - square / 8 + square * square / 384, v.x(), v.y(), v.z()};
  }
  const double angle = std::sqrt(square);
  double sine, cosine;
  portable::sinCos(angle / 2, sine, cosine);
  const Eigen::Vector3d v = vector * (sine / angle);
  return {cosine, v.x(), v.y(), v.z()};
}

// Of a unit quaternion q, the same as of -q: the length is from 0 to π.
inline Eigen::Vector3d rotationVector(const Eigen::Quaterniond& q) {
  const double sign = q.w() < 0 ? -1 : 1;
  const double sine = q.vec().norm();
  if (sine < 1e-150) return 2 * sign * q.vec();  // whose square may be no number any more
  const double angle = 2 * kRadPerTurn * portable::turnOf(sine, sign * q.w());
  return q.vec() * (sign * angle / sine);
}

// The rotation as Pose wants it: of unit length, w >= 0.
inline Eigen::Quaterniond unitRotation(const Eigen::Quaterniond& q) {
  const double scale = (q.w() < 0 ? -1 : 1) / std::sqrt(q.squaredNorm());
  return {q.w() * scale, q.x() * scale, q.y() * scale, q.z() * scale};
}

// Heading counter-clockwise from x, then nose down, then right side down: R = Rz(yaw) Ry(pitch) Rx(roll), of a body
// with x forward, y left, z up.
struct EulerAngles {
  double roll_rad = 0, pitch_rad = 0, yaw_rad = 0;
};

inline Eigen::Quaterniond rotationOf(const EulerAngles& angles) {
  double sr, cr, sp, cp, sy, cy;
  portable::sinCos(angles.roll_rad / 2, sr, cr);
  portable::sinCos(angles.pitch_rad / 2, sp, cp);
  portable::sinCos(angles.yaw_rad / 2, sy, cy);
  return {cr * cp * cy + sr * sp * sy, sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy,
          cr * cp * sy - sr * sp * cy};
}

// Roll and yaw from -π to π, pitch from -π/2 to π/2; where the nose points straight up or down, roll is 0.
inline EulerAngles eulerAngles(const Eigen::Quaterniond& q) {
  const double w = q.w(), x = q.x(), y = q.y(), z = q.z();
  const double sine = 2 * (w * y - x * z);
  const double across = 2 * (y * z + w * x), up = 1 - 2 * (x * x + y * y);  // of the bottom row
  const double cosine = std::sqrt(across * across + up * up);
  if (cosine < 1e-9) return {0, kRadPerTurn * portable::turnOf(sine, cosine), 2 * kRadPerTurn * portable::turnOf(z, w)};
  return {kRadPerTurn * portable::turnOf(across, up), kRadPerTurn * portable::turnOf(sine, cosine),
          kRadPerTurn * portable::turnOf(2 * (x * y + w * z), 1 - 2 * (y * y + z * z))};
}

}  // namespace standpoint
