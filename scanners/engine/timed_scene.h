// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "scanners/engine/embree_scene.h"
#include "scanners/engine/pose_window.h"

namespace standpoint {

// A scene at any time, as one thread of a scan sees it: what stands, and bodies that move. A ray is taken into the rest
// frame of each body that it comes near, by the body's pose at the ray's own time (pose_window.h): no body stands still
// for a moment, and none jumps. What it answers depends on the question alone.
//
// Which bodies a ray comes near is asked of boxes around what they sweep in windows of 0.25 s; how far a body strays
// from where eight poses a window say that it is, is taken from how far it gets between them.
class TimedScene {
 public:
  // A ray comes near a body that is in the beam about it: `exit_m` wide and spreading by `divergence_rad`. Rays go
  // `farthest_m` at most.
  struct BeamWidth {
    double exit_m = 0, divergence_rad = 0, farthest_m = 0;
  };
  TimedScene(const EmbreeScene& scene, const BeamWidth& beam);
  ~TimedScene();
  TimedScene(const TimedScene&) = delete;
  TimedScene& operator=(const TimedScene&) = delete;

  bool moves() const { return !scene_.bodies().empty(); }
  // As EmbreeScene has it, of rays at their times. The answer: the lanes that come near a body, as bits.
  std::uint32_t intersect(const RayPacket& rays, int count, float max_range_m, std::uint64_t* facets, float* ranges_m);
  void intersect(const RayPacket& rays, int count, float max_range_m, NearestHit* hits);
  NearestHit nearest(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction_unit, double min_range_m,
                     double max_range_m, double time_s);
  // Of bodies alone: what they hide of a place that far away is not asked of what stands.
  NearestHit nearestBody(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction_unit, double max_range_m,
                         double time_s);
  // A facet of the rest frame where it is at that time; one that stands is itself.
  Facet at(const Facet& facet, double time_s);

 private:
  static constexpr double kWindow_s = 0.25, kSlots_per_s = 128;
  static constexpr std::int64_t kNoSlot = std::numeric_limits<std::int64_t>::min();
  struct Window;
  // Rays that ask for bodies, in the local frame.
  struct Asked;
  struct Known {
    std::int64_t slot = kNoSlot;  // of 1/128 s: so many rays come near a body before it is another one
    PoseWindow poses;
    double time_s = 0;  // that was asked for last
    Pose local_from_rest;
  };

  static void bounds(const RTCBoundsFunctionArguments* arguments);
  static void meet(const RTCIntersectFunctionNArguments* arguments);
  void meetBody(std::uint32_t body, Asked& asked, unsigned lane);
  void ask(Asked& asked, int count);
  Window& windowOf(std::int64_t number);
  const Pose& pose(std::uint32_t body, double time_s);
  double aside_m(double range_m) const;

  const EmbreeScene& scene_;
  BeamWidth width_;
  double beam_m_;                                   // aside, as far as rays go
  std::vector<Known> known_;                        // of each body
  std::array<std::unique_ptr<Window>, 2> windows_;  // a column may lie in two
  std::size_t oldest_ = 0;
};

}  // namespace standpoint
