// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/units.h"
#include "editor/camera/camera.h"
#include "editor/walking/swinging_doors.h"
#include "editor/walking/tripods_in_way.h"
#include "editor/walking/walk_ground.h"
#include "editor/walking/way_walk.h"
#include "optimizer/walk/start.h"
#include "optimizer/walk/walker.h"

namespace standpoint {

// Keys that are held: to the right (x) and ahead (y) of where the camera looks, each -1, 0 or 1.
struct WalkKeys {
  Eigen::Vector2d way = Eigen::Vector2d::Zero();
  bool fast = false, crouch = false;
};

// Somebody in the model through whose eyes the camera looks.
class Walk {
 public:
  static constexpr double kUsualViewAngle_rad = 60 * kRadPerDeg;  // vertical
  static constexpr double kLowestEyes_m = 1.0, kHighestEyes_m = 2.0;
  static constexpr double kNarrowestView_deg = 45, kWidestView_deg = 80;

  // Stands there and looks level; false, and nothing changes, where there is no room.
  bool start(std::shared_ptr<const WalkedGround> ground, const Body& body, const StartPlace& place, Camera& camera);
  // The camera stays at the eyes.
  void stop(Camera& camera);
  bool active() const { return walker_.has_value(); }
  // Whether it walks there, and not between shapes that were computed again since.
  bool isIn(const std::shared_ptr<const WalkedGround>& ground) const { return ground == ground_; }

  // What else stands there, from now on.
  void goAmong(std::vector<Tripod> tripods) { tripods_ = std::move(tripods); }
  void go(const WalkKeys& keys, double seconds, Camera& camera);
  // Goes along it by itself, as fast as is said, and looks where it goes; a key to go ends that.
  void goAlong(std::vector<Eigen::Vector3d> corners, double speed_mps) { way_.emplace(std::move(corners), speed_mps); }
  bool goesByItself() const { return way_.has_value(); }
  void stay() { way_.reset(); }
  // Seconds that were walked or stood, of go(): what is walked in them is as fast as it says.
  double clock_s() const { return clock_s_; }
  // Faster (> 0) or slower, from a quarter to four times a walk.
  void changeSpeed(double steps);
  double speed_mps(bool fast) const;

  const WalkedGround& ground() const { return *ground_; }
  Eigen::Vector3d feet() const { return walker_->feet(); }
  bool moves() const { return walker_ && (way_ || walker_->moves() || doors_->moves()); }
  double eyeHeight_m() const { return walker_->height() - Walker::kCrownAboveEyes_m; }  // now, crouched or not
  // Of whoever stands upright, 1.0 to 2.0 m, and the view angle, 45° to 80°; both last.
  double uprightEyes_m() const { return body_.height_m - Walker::kCrownAboveEyes_m; }
  void setUprightEyes(double height_m);
  double viewAngle_deg() const;
  void setViewAngle(double angle_deg, Camera& camera);

  // Of the nearest door ahead; false where there is none, or where one stands in it.
  bool toggleDoor(const Camera& camera);
  bool doorInReach(const Camera& camera) const;
  // The doors as they stand, null where they are not apart from the model.
  std::shared_ptr<const Environment> doors() const { return walker_ ? doors_->scene() : nullptr; }
  // What is in the way or has just happened: "headroom 1.68 m, body 1.70 m"; "" when nothing.
  std::string note() const;

 private:
  void move(const WalkWish& wish, double seconds);
  void follow(double seconds, Camera& camera);
  void lookFromEyes(Camera& camera) const;

  std::shared_ptr<const WalkedGround> ground_;
  std::optional<Walker> walker_;
  std::optional<WayWalk> way_;            // while it goes by itself
  bool held_up_ = false;                  // it gave up, and nobody has gone on since
  std::unique_ptr<SwingingDoors> doors_;  // while there is a walker
  std::vector<Tripod> tripods_;
  TripodsInWay tripods_in_way_;
  Body body_;
  std::optional<double> chosen_eyes_m_;
  double view_angle_rad_ = kUsualViewAngle_rad;
  double factor_ = 1;  // of the usual speed
  double clock_s_ = 0;
  double view_angle_before_rad_ = 0;
};

}  // namespace standpoint
