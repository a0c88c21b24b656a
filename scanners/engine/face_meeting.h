// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "core/environment.h"
#include "scanners/engine/embree.h"

namespace standpoint {

// Which triangle a ray meets is decided here and not by Embree, whose rounding differs between instruction sets: Embree
// only says which triangles may be met. In double, without fused operations, so that the answer is the same on every
// processor: a ray that strikes the edge of two triangles meets one of them at least, and of those that it meets in the
// same 61 µm of its way the one that comes first in the scene is met.
struct RayFaces {
  std::vector<std::array<Eigen::Vector3f, 3>> corners;  // side by side: they are looked at in no order
  const Eigen::Affine3d* world_from_mesh = nullptr;     // by placement, where the mesh is instanced; else null
  double swell = 0;                                     // of bounds, for Embree's rounding; in the corners' frame

  RayFaces(const Mesh& mesh, const Eigen::Affine3d& frame_from_mesh);
};

constexpr double kTieCells_per_m = 16384;
// The end of the cell that the range is in.
float endOfTieCell(double range);

// The rays of a query in the world's frame, a lane for each id.
struct alignas(64) MeetingQuery {  // its lanes are set by `set`
  static constexpr int kLanes = 16;
  RayQuery query;                                      // first: Embree hands a pointer to its context on
  double origin_x = 0, origin_y = 0, origin_z = 0;     // of the first ray
  double off_x[kLanes], off_y[kLanes], off_z[kLanes];  // of the others' origins from it
  double direction_x[kLanes], direction_y[kLanes], direction_z[kLanes];
  double moment_x[kLanes], moment_y[kLanes], moment_z[kLanes];  // direction × off
  bool one_origin = true;                                       // nothing is off
  explicit MeetingQuery(RayQuery::Rays rays) : query(rays) {}
  // Of `count` rays, x, y and z of each figure `stride` apart.
  void set(const float* origins, const float* directions, int stride, int count, bool from_one);
};

// A geometry of Embree for triangles that are met so; `faces` must outlive it.
RTCGeometry newFaces(RTCDevice device, RayFaces& faces);

}  // namespace standpoint
