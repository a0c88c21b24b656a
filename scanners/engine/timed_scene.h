// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "scanners/engine/embree_scene.h"
#include "scanners/engine/pose_window.h"
#include "scanners/engine/swept_bodies.h"

namespace standpoint {

// Sixteen rays of which some, as bits, come near a body.
struct NearBody {
  std::uint32_t body = 0, lanes = 0;
};

// A scene at any time, as one thread of a scan sees it: what stands, and bodies that move. A ray is taken into the rest
// frame of each body that it comes near, by the body's pose at the ray's own time (pose_window.h): no body stands still
// for a moment, and none jumps. What it answers depends on the question alone. Which bodies a ray comes near is asked
// of what they sweep (swept_bodies.h).
class TimedScene {
 public:
  TimedScene(const EmbreeScene& scene, const BeamWidth& beam) : TimedScene(swept(scene, beam)) {}
  // `bodies`: made by swept(), for any number of threads.
  explicit TimedScene(std::shared_ptr<SweptBodies> bodies);
  static std::shared_ptr<SweptBodies> swept(const EmbreeScene& scene, const BeamWidth& beam);
  TimedScene(const TimedScene&) = delete;
  TimedScene& operator=(const TimedScene&) = delete;

  bool moves() const { return !scene_.bodies().empty(); }
  // As EmbreeScene has it, of rays at their times; there is room for a whole packet's answers. `near` gets the bodies
  // that some come near; null: nobody asks.
  void intersect(const RayPacket& rays, int count, float max_range_m, std::uint64_t* facets, float* ranges_m,
                 std::vector<NearBody>* near);
  void intersect(const RayPacket& rays, int count, float max_range_m, NearestHit* hits);
  NearestHit nearest(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction_unit, double min_range_m,
                     double max_range_m, double time_s);
  // Of bodies alone: what they hide of a place that far away is not asked of what stands.
  NearestHit nearestBody(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction_unit, double max_range_m,
                         double time_s);
  Pose pose(std::uint32_t body, double time_s);  // local_from_rest
  // Where a body is at each of the times of those lanes; the others keep what they have.
  void poses(std::uint32_t body, const double* times_s, std::uint32_t lanes, PoseLanes& local_from_rest);
  // A facet of the rest frame where it is at that time; one that stands is itself.
  Facet at(const Facet& facet, double time_s);

 private:
  static constexpr double kSlots_per_s = 128;
  static constexpr std::int64_t kNoSlot = std::numeric_limits<std::int64_t>::min();
  // Rays that ask for bodies, in the local frame.
  struct Asked;
  struct Slot {
    std::int64_t number = kNoSlot;  // of 1/128 s: so many rays come near a body before it is another one
    PoseWindow poses;
  };

  static void meet(const RTCIntersectFunctionNArguments* arguments);
  const PoseWindow& during(std::uint32_t body, std::int64_t slot);
  void meetBody(std::uint32_t body, Asked& asked, std::uint32_t lanes);
  void ask(Asked& asked, int count);
  // What a ray meets of bodies before that, or that.
  NearestHit nearer(const NearestHit& than, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction_unit,
                    double min_range_m, double time_s);
  const SweptWindow& windowOf(std::int64_t number);

  std::shared_ptr<SweptBodies> swept_;
  const EmbreeScene& scene_;
  double beam_m_;                           // aside, as far as rays go
  std::vector<std::array<Slot, 2>> slots_;  // of each body, an even one and an odd one: a column may lie in two
  struct Held {
    std::int64_t number = 0;
    std::shared_ptr<const SweptWindow> window;
  };
  std::array<Held, 2> windows_;  // a column may lie in two
  std::size_t oldest_ = 0;
};

}  // namespace standpoint
