// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "scanners/engine/embree_scene.h"
#include "scanners/engine/footprint.h"

namespace standpoint {

// Sixteen rays at their times.
struct TimedRays {
  RayLanes rays;
  double time_s[kPacket] = {};
  int piece[kPacket] = {};  // of the paths in the window that is asked, which setPieces() tells
};

// A ray comes near a body that is in the beam about it: `exit_m` wide and spreading by `divergence_rad`. Rays go
// `farthest_m` at most.
struct BeamWidth {
  double exit_m = 0, divergence_rad = 0, farthest_m = 0;
  // As far out as rays of a beam go (footprint.h), which is w(R) ≤ (D0 + γR) / 2.
  STANDPOINT_INLINE double aside_m(double range_m) const {
    return kBeamEdge * (exit_m + divergence_rad * (farthest_m < range_m ? farthest_m : range_m)) / 2;
  }
};

// Where bodies get in a quarter of a second: boxes around what they sweep, in a scene of Embree, and about where each
// of them is meanwhile. How far it strays from where four poses say that it is, is taken from how far it gets between
// them.
class SweptWindow {
 public:
  static constexpr double kLength_s = 0.25;
  // `meet` is asked about the rays that enter a box, with this as the geometry's data.
  SweptWindow(const EmbreeScene& scene, const BeamWidth& beam, std::int64_t number, RTCIntersectFunctionN meet);
  ~SweptWindow();
  SweptWindow(const SweptWindow&) = delete;
  SweptWindow& operator=(const SweptWindow&) = delete;

  RTCScene scene() const { return scene_; }  // null: nothing is there
  std::uint32_t body(std::size_t box) const { return bodies_[box]; }
  // Of those rays.
  void setPieces(TimedRays& rays) const;
  // Which of those rays may come near the body before they end, as bits.
  std::uint32_t reaching(std::size_t box, const TimedRays& rays, std::uint32_t lanes, const float* farthest_m) const;

  static constexpr int kPoses = 4;
  // Where the middle of a body is about, from one pose to the next, and how far off at most.
  struct Path {
    double centre[3][kPoses + 1];
    double reach_m = 0;  // from there: of the body, too
  };

 private:
  static void bounds(const RTCBoundsFunctionArguments* arguments);
  void addPath(std::uint32_t body);
  void build(RTCIntersectFunctionN meet);

  const EmbreeScene& of_;
  BeamWidth beam_;
  double beam_m_;  // aside, as far as rays go
  std::int64_t number_;
  std::vector<std::uint32_t> bodies_;  // those that are there, a box each
  std::vector<Path> paths_;
  std::vector<Eigen::AlignedBox3d> boxes_;
  RTCScene scene_ = nullptr;
};

// The windows that are asked for about the same time: each is made once, for any number of threads.
class SweptBodies {
 public:
  SweptBodies(const EmbreeScene& scene, const BeamWidth& beam, RTCIntersectFunctionN meet)
      : scene_(scene), beam_(beam), meet_(meet) {}
  const EmbreeScene& scene() const { return scene_; }
  const BeamWidth& beam() const { return beam_; }
  std::shared_ptr<const SweptWindow> window(std::int64_t number);

 private:
  struct Kept {
    std::once_flag made;
    std::shared_ptr<const SweptWindow> window;
    std::uint64_t asked = 0;  // for, lately
  };
  static constexpr std::size_t kMostKept = 16;

  const EmbreeScene& scene_;
  BeamWidth beam_;
  RTCIntersectFunctionN meet_;
  std::mutex mutex_;
  std::uint64_t asked_ = 0;
  std::map<std::int64_t, std::shared_ptr<Kept>> kept_;
};

}  // namespace standpoint
