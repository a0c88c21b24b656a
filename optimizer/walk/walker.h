// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>
#include <optional>

#include <Eigen/Core>

#include "optimizer/walk/avatar.h"

namespace standpoint {

// What whoever steers wants now.
struct WalkWish {
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // m/s
  bool crouch = false;
};

// An avatar with a clock: it speeds up and slows down, falls, crouches under what is low, and comes back from where it
// fell to. Its clock has ticks of its own, so that it ends in the same place however often it is asked.
class Walker {
 public:
  static constexpr double kCrouched_m = 1.20;        // as low as one walks
  static constexpr double kCrownAboveEyes_m = 0.10;  // of the head

  Walker(const Obstacles& obstacles, const Body& body, double lowest_m);

  // As Avatar::stand; crouched where there is no more room.
  bool stand(const Eigen::Vector3d& p, double reach_m = 3);
  void go(const WalkWish& wish, double seconds);

  // Of who walks, from now on; it rises as far as there is room.
  void setHeight(double height_m) { body_.height_m = height_m; }
  void alsoMeet(const Obstacles* others, const Obstacles* more = nullptr) { avatar_.alsoMeet(others, more); }

  Eigen::Vector3d feet() const { return between(before_.feet, now_.feet); }
  Eigen::Vector3d eyes() const { return between(before_.eyes, now_.eyes); }  // up and down without jerks
  double height() const { return avatar_.height(); }
  bool moves() const { return moves_; }
  // Of what it cannot stand up under, or get under at all.
  const std::optional<double>& headroom() const { return headroom_; }
  bool wasBroughtBack() const { return brought_back_s_ > 0; }  // a moment ago

 private:
  struct Pose {
    Eigen::Vector3d feet = Eigen::Vector3d::Zero(), eyes = Eigen::Vector3d::Zero();
  };
  Eigen::Vector3d between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;
  Eigen::Vector3d eyesOverFeet() const;
  void tick(const WalkWish& wish);
  void speedUp(const Eigen::Vector2d& wish);
  void stretch(bool crouch);
  void stride(const Eigen::Vector2d& way_m);
  bool strideLower(const Avatar& from, double height_m, const Eigen::Vector2d& way_m, double least_m);
  void fall();
  void rememberFirmPlace();
  void smoothEyes();

  Avatar avatar_;
  Body body_;
  double lowest_m_ = 0;
  Eigen::Vector2d velocity_ = Eigen::Vector2d::Zero();
  double top_speed_ = 0;   // that it last wanted
  double fall_speed_ = 0;  // m/s, down
  double fell_from_m_ = 0;
  double rest_s_ = 0;  // not yet walked
  Pose before_, now_;  // the last two ticks
  std::optional<double> headroom_;
  std::deque<Eigen::Vector3d> firm_;  // one each quarter of a second, oldest first
  int since_firm_ = 0;                // ticks
  double brought_back_s_ = 0;
  bool moves_ = false;
};

}  // namespace standpoint
