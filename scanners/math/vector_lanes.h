// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstdint>

#include <Eigen/Geometry>

#include "core/portable_math.h"

// Sixteen of a kind side by side, and what is done to one of them: with the very operations of Eigen, in their order,
// so that a lane has the same bits as one that is worked out alone.
namespace standpoint {

constexpr int kPacket = 16;

struct alignas(64) VectorLanes {
  double x[kPacket] = {}, y[kPacket] = {}, z[kPacket] = {};

  Eigen::Vector3d at(std::uint32_t lane) const { return {x[lane], y[lane], z[lane]}; }
  void set(std::uint32_t lane, const Eigen::Vector3d& v) { x[lane] = v.x(), y[lane] = v.y(), z[lane] = v.z(); }
};

struct RayLanes {
  VectorLanes origin, direction;
};

struct PoseLanes {
  VectorLanes translation;
  double qx[kPacket] = {}, qy[kPacket] = {}, qz[kPacket] = {}, qw[kPacket] = {};

  Eigen::Quaterniond rotation(std::uint32_t lane) const { return {qw[lane], qx[lane], qy[lane], qz[lane]}; }
};

// Of each lane that is in `bits`.
template <class Do>
STANDPOINT_INLINE void forLanes(std::uint32_t bits, const Do& todo) {
  for (; bits != 0; bits &= bits - 1) todo(static_cast<std::uint32_t>(std::countr_zero(bits)));
}

// Of sixteen figures those that are not 0.
inline std::uint32_t bitsOf(const std::uint64_t* figures) {
  std::uint32_t bits = 0;
  for (unsigned k = 0; k < kPacket; ++k) bits |= figures[k] != 0 ? 1U << k : 0;
  return bits;
}

STANDPOINT_INLINE double dotOf(double ax, double ay, double az, double bx, double by, double bz) {
  return ax * bx + (ay * by + az * bz);
}

// q v q*, of a unit quaternion.
STANDPOINT_INLINE void turnBy(double qx, double qy, double qz, double qw, double& x, double& y, double& z) {
  double ux = qy * z - qz * y, uy = qz * x - qx * z, uz = qx * y - qy * x;
  ux += ux, uy += uy, uz += uz;
  const double vx = x + qw * ux + (qy * uz - qz * uy);
  const double vy = y + qw * uy + (qz * ux - qx * uz);
  const double vz = z + qw * uz + (qx * uy - qy * ux);
  x = vx, y = vy, z = vz;
}

// In the frame of what is at those poses.
void placesAtRest(const PoseLanes& poses, const VectorLanes& places, VectorLanes& at_rest);
void directionsAtRest(const PoseLanes& poses, const VectorLanes& directions, VectorLanes& at_rest);

}  // namespace standpoint
