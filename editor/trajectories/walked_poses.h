// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/motion/carriers.h"
#include "core/motion/cubic_spline.h"
#include "core/motion/pose_function.h"
#include "core/result.h"
#include "editor/camera/camera.h"

namespace standpoint {

// A moment of somebody's walk with a scanner.
struct WalkMoment {
  double time_s = 0;                               // since the walk began
  Eigen::Vector3d feet = Eigen::Vector3d::Zero();  // local frame
  Pose local_from_scanner;                         // x ahead, y left, z up
};

// Of whoever looks through the camera and carries a scanner of this mount ("hand", "body" or "any"): it looks where
// they look, turned and tilted as the camera is, and stays beside them, because the lever arm from the eyes turns with
// the heading alone. In the hand it is 0.2 m ahead and 0.3 m lower, on the back 0.1 m behind and 0.3 m higher: for
// eyes at 1.6 m as high above the floor as the carriers have it (core/motion/carriers.h), and within the body of
// whoever walks, so that it enters no wall.
Pose scannerOf(const Camera& camera, const std::string& mount);
// What bears a scanner of that mount on foot; null: nothing does.
const Carrier* carrierOnFoot(const std::string& mount);

// The poses of a walk while it goes on, each moment of which is met; between them cubic, with slopes by the moments
// before and after (Catmull and Rom, for uneven steps), so that what is settled does not change when more comes. Not
// for several threads while it grows.
class WalkedPoses : public PoseFunction {
 public:
  // Of a moment that is not later than the last one nothing is kept.
  void add(const WalkMoment& moment);
  bool empty() const { return knots_.empty(); }

  Pose pose(double time_s) const override;
  double first_s() const override { return knots_.front().at; }
  double last_s() const override { return knots_.back().at; }
  // Until then it stays as it is.
  double settled_s() const;
  double feetHeight_m(double time_s) const;

 private:
  static constexpr std::size_t kFeet = 7;  // after the place and the four parts of the quaternion
  std::array<double, 8> at(double time_s) const;

  std::vector<SplineKnot<8>> knots_;
};

// The walk as its carrier goes it: without the jitter of frames, gait and shaking added, 200 poses a second. The same
// for the same moments, seed and name. Needs two moments.
Result<Trajectory> carriedAlong(std::span<const WalkMoment> moments, const Carrier& carrier, std::uint64_t seed,
                                const std::string& name);

}  // namespace standpoint
