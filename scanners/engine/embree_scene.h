// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/environment.h"
#include "scanners/engine/balls.h"
#include "scanners/engine/embree.h"
#include "scanners/engine/face_meeting.h"
#include "scanners/engine/ray_engine.h"
#include "scanners/engine/scene_edges.h"
#include "scanners/math/vector_lanes.h"

namespace standpoint {

constexpr std::uint64_t kNoFacet = ~std::uint64_t{0};
constexpr std::uint32_t kNoBody = ~0U;

// A triangle where it stands: the plane n·p = offset in double, so that a range does not suffer from the float BVH.
// The number of a facet is placement << 32 | triangle; a placement is an instance that beams can meet. A ball is one
// facet, without a plane of its own: `metBy` gives the one that touches it where a ray meets it. Of a body that moves
// it is where the body rests (timed_scene.h says where it is).
struct Facet {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // unit, of either side; zero for a degenerate triangle and a ball
  double offset = 0;
  std::uint32_t product = 0, surface = 0, instance = 0, triangle = 0;
  const PlacedBall* ball = nullptr;  // null: a triangle
  std::uint32_t body = kNoBody;      // of EmbreeScene::bodies

  // Is it where it is whatever meets it, and whenever?
  bool stays() const { return ball == nullptr && body == kNoBody; }

  Facet metBy(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction_unit) const {
    if (ball == nullptr) return *this;
    Facet touching = *this;
    const Eigen::Vector3d place = origin + rangeOnBall(*ball, origin, direction_unit) * direction_unit;
    touching.normal = (place - ball->centre).normalized();
    touching.offset = touching.normal.dot(place);
    return touching;
  }
};

// The range is rounded up to the next 61 µm (face_meeting.h); the facet's plane says where exactly.
struct NearestHit {
  std::uint64_t facet = kNoFacet;
  float range_m = 0;
};

// Sixteen rays side by side, as Embree wants them.
struct alignas(64) RayPacket {
  float origin_x[kPacket], origin_y[kPacket], origin_z[kPacket];
  float direction_x[kPacket], direction_y[kPacket], direction_z[kPacket];
  double time_s[kPacket];     // for what moves, and by its clock
  bool one_origin = false;    // of all lanes, the others included: that of `seen`, if any
  SeenFaces* seen = nullptr;  // from a place near all origins

  void set(int lane, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
    origin_x[lane] = static_cast<float>(origin.x());
    origin_y[lane] = static_cast<float>(origin.y());
    origin_z[lane] = static_cast<float>(origin.z());
    direction_x[lane] = static_cast<float>(direction.x());
    direction_y[lane] = static_cast<float>(direction.y());
    direction_z[lane] = static_cast<float>(direction.z());
  }
};

// A body that moves, in its rest frame: the local frame as the environment has it.
struct RestingBody {
  RTCScene scene = nullptr;
  Eigen::AlignedBox3d box;
  PoseFunctionPtr local_from_rest;
  double from_s = 0, to_s = 0;
};

class EmbreeScene final : public RayScene {
 public:
  EmbreeScene() = default;
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;
  ~EmbreeScene() override;

  Result<void> commit(std::shared_ptr<const Environment> environment, const std::vector<RoundInstance>& balls,
                      const std::string& embree_settings, const std::vector<MovingBody>& bodies, Progress& progress);
  std::optional<RayHit> intersect(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction_unit,
                                  double max_range_m) const override;
  const Environment& environment() const override { return *environment_; }

  // The first `count` rays of the packet; they should point to about the same side (coherent).
  void intersect(const RayPacket& rays, int count, float max_range_m, std::uint64_t* facets, float* ranges_m) const;
  void intersect(const RayPacket& rays, int count, float max_range_m, NearestHit* hits) const;
  // One ray from `min_range_m` on.
  NearestHit nearest(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction_unit, double min_range_m,
                     double max_range_m) const;
  // What those of the rays in its rest frame, as bits, meet of a body before what they have met, of all sixteen.
  void intersectBody(std::uint32_t body, const RayLanes& rays, std::uint32_t lanes, float min_range_m,
                     std::uint64_t* facets, float* ranges_m) const;
  // Where rays start and go, for tracing; and nothing is met.
  static void setRays(RTCRayHit16& query, const RayPacket& rays);
  Facet facet(std::uint64_t number) const;
  const std::vector<RestingBody>& bodies() const { return bodies_; }
  RTCDevice device() const { return device_; }
  // Of what stands; those of bodies follow.
  std::size_t stillCount() const { return still_count_; }
  std::size_t placedCount() const { return placements_.size(); }
  std::uint32_t bodyOf(std::uint32_t placement) const {
    return placement < still_count_ ? kNoBody : body_of_[placement - still_count_];
  }
  bool isBall(std::uint32_t placement) const { return balls_.contains(placement); }
  // Of placement << 32 | index in `edges`: its ends, in the local frame.
  std::array<Eigen::Vector3d, 2> edgeEnds(std::uint64_t edge) const;
  // Of a mesh that is placed.
  const std::vector<MeshEdge>& edges(std::uint32_t mesh) const { return edges_[mesh]; }
  const Instance& placed(std::size_t placement) const { return environment_->instances[placements_[placement]]; }

 private:
  void listPlacements(const std::vector<MovingBody>& bodies);
  void buildBodies(const std::vector<MovingBody>& bodies);
  void attachPlaced(std::uint32_t placement, RTCScene scene);
  void attachInstanced(std::uint32_t placement);
  void attachBall(std::uint32_t placement, double radius_m);
  void buildTree(const std::vector<std::uint32_t>& uses, const std::vector<RoundInstance>& balls, Progress& progress);
  void findEdges(Progress& progress);
  RTCScene meshScene(std::uint32_t mesh);
  double size() const;

  std::shared_ptr<const Environment> environment_;
  std::vector<std::uint32_t> placements_;  // indices into Environment::instances
  std::size_t still_count_ = 0;            // of them: what stands
  std::vector<std::uint32_t> body_of_;     // of those that follow
  std::vector<RestingBody> bodies_;
  std::vector<std::vector<MeshEdge>> edges_;   // by mesh
  double size_m_ = 0;                          // how far from the origin anything is
  std::deque<RayFaces> faces_;                 // of Embree's geometries
  std::vector<Eigen::Affine3d> placed_at_;     // by placement, for those that are instanced
  std::vector<RTCScene> mesh_scenes_;          // by mesh; null unless instanced
  std::map<std::uint32_t, PlacedBall> balls_;  // by placement
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

// The range at which the ray meets the facet's plane, or `fallback_m` when the plane is seen edge-on or degenerate.
inline double rangeOnPlane(const Facet& facet, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                           double fallback_m) {
  const double range = (facet.offset - facet.normal.dot(origin)) / facet.normal.dot(direction);
  // Edge-on, the plane says nothing.
  return std::abs(range - fallback_m) <= 1e-3 + 1e-4 * fallback_m ? range : fallback_m;
}

}  // namespace standpoint
