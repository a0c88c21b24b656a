// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
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

// A triangle as rays from about one place see it: what they span with each edge (Plücker) is the product of a direction
// and of a moment with these figures. Both triangles of an edge have the same ones with opposite signs, to the last
// bit.
struct SeenFace {
  double moment[3][3], along[3][3];  // of the edges b–c, c–a, a–b
  double normal[3], volume;

  SeenFace() = default;
  SeenFace(const Eigen::Vector3d& corner_a, const Eigen::Vector3d& corner_b, const Eigen::Vector3d& corner_c,
           const Eigen::Vector3d& from);
};

// The triangles seen lately from one place: neighbouring beams of a scanner meet the same ones. For one thread.
class SeenFaces {
 public:
  explicit SeenFaces(const Eigen::Vector3d& from) : from_(from), entries_(std::size_t{1} << kBits) {}
  const Eigen::Vector3d& from() const { return from_; }
  // Good until the next call. `instance`: of Embree.
  const SeenFace& of(const RayFaces& faces, std::uint32_t triangle, std::uint32_t instance);

 private:
  static constexpr unsigned kBits = 9;
  struct Entry {
    const RayFaces* faces = nullptr;
    std::uint32_t triangle = 0, instance = 0;
    SeenFace seen;
  };
  Eigen::Vector3d from_;
  std::vector<Entry> entries_;
};

// The rays of a query in the world's frame, a lane for each id.
struct alignas(64) MeetingQuery {  // its lanes are set by `set`
  static constexpr int kLanes = 16;
  RayQuery query;  // first: Embree hands a pointer to its context on
  SeenFaces* seen = nullptr;
  double origin_x = 0, origin_y = 0, origin_z = 0;     // near the rays'
  double off_x[kLanes], off_y[kLanes], off_z[kLanes];  // of the rays' origins from it
  double direction_x[kLanes], direction_y[kLanes], direction_z[kLanes];
  double moment_x[kLanes], moment_y[kLanes], moment_z[kLanes];  // direction × off
  bool one_origin = true;                                       // nothing is off
  explicit MeetingQuery(RayQuery::Rays rays) : query(rays) {}
  // Of `count` rays, x, y and z of each figure `stride` apart; `seen`: from where they nearly start, or null.
  void set(const float* origins, const float* directions, int stride, int count, bool from_one, SeenFaces* from);
};

// A geometry of Embree for triangles that are met so; `faces` must outlive it.
RTCGeometry newFaces(RTCDevice device, RayFaces& faces);

}  // namespace standpoint
