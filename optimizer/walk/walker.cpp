// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/walk/walker.h"

#include <algorithm>
#include <cmath>

namespace standpoint {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kTick = 1.0 / 120;     // s
constexpr double kLongestFrame = 0.2;   // s; a picture that took longer does not make one run
constexpr double kSpeedUp = 0.1;        // s from standing to full speed, and back
constexpr double kGravity = 9.81;       // m/s²
constexpr double kFastestFall = 20;     // m/s
constexpr double kDeepestFall = 6;      // m, from which one comes back
constexpr double kBelowAll = 1;         // m under the lowest thing there is
constexpr double kStretching = 3.3;     // m/s of the head when one crouches or rises: 0.5 m in 0.15 s
constexpr double kUnderCeiling = 2e-3;  // m that stay free
constexpr double kEyesFollow = 0.04;    // s: nine tenths of a step in 100 ms
constexpr double kMostLag = 0.25;       // m
constexpr int kFirmTicks = 30;          // between two firm places …
constexpr std::size_t kFirmPlaces = 4;  // … of a second in all
constexpr double kNoteFor = 4;          // s
constexpr double kLookAhead = 0.05;     // m, to what is too low

}  // namespace

Walker::Walker(const Obstacles& obstacles, const Body& body, double lowest_m)
    : avatar_(obstacles, body), body_(body), lowest_m_(lowest_m) {}

bool Walker::stand(const Vector3d& p, double reach_m) {
  Avatar tried = avatar_;
  tried.setHeight(body_.height_m);
  if (!tried.stand(p, reach_m)) {
    tried.setHeight(std::min(kCrouched_m, body_.height_m));
    if (!tried.stand(p, reach_m)) return false;
    tried.setHeight(std::max(tried.height(), tried.headroom(body_.height_m) - kUnderCeiling));
  }
  avatar_ = tried;
  velocity_.setZero();
  fall_speed_ = rest_s_ = 0;
  headroom_.reset();
  firm_.assign(1, avatar_.feet());
  before_ = now_ = {avatar_.feet(), eyesOverFeet()};
  return true;
}

Vector3d Walker::between(const Vector3d& a, const Vector3d& b) const { return a + rest_s_ / kTick * (b - a); }

Vector3d Walker::eyesOverFeet() const { return avatar_.feet() + Vector3d(0, 0, avatar_.height() - kCrownAboveEyes_m); }

void Walker::go(const WalkWish& wish, double seconds) {
  if (!wish.velocity.allFinite()) return;
  rest_s_ += std::clamp(seconds, 0.0, kLongestFrame);
  while (rest_s_ > kTick - 1e-9) {
    tick(wish);
    rest_s_ -= kTick;
  }
  rest_s_ = std::max(rest_s_, 0.0);
}

void Walker::tick(const WalkWish& wish) {
  before_ = now_;
  speedUp(wish.velocity);
  stretch(wish.crouch);
  if (!velocity_.isZero()) stride(velocity_ * kTick);
  fall();
  rememberFirmPlace();
  smoothEyes();
  brought_back_s_ = std::max(0.0, brought_back_s_ - kTick);
  moves_ = before_.feet != now_.feet || (before_.eyes - now_.eyes).norm() > 1e-5 || brought_back_s_ > 0 ||
           !avatar_.onFloor();
}

void Walker::speedUp(const Vector2d& wish) {
  if (!wish.isZero()) top_speed_ = wish.norm();
  const Vector2d change = wish - velocity_;
  const double most = std::max(top_speed_, velocity_.norm()) / kSpeedUp * kTick;
  velocity_ = change.norm() <= most ? wish : Vector2d(velocity_ + change.normalized() * most);
}

void Walker::stretch(bool crouch) {
  const double wanted = crouch ? std::min(kCrouched_m, body_.height_m) : body_.height_m, height = avatar_.height();
  headroom_.reset();
  if (height > wanted) {
    avatar_.setHeight(std::max(wanted, height - kStretching * kTick));
  } else if (height < wanted) {
    const double free = avatar_.headroom(wanted + kUnderCeiling);
    avatar_.setHeight(std::clamp(free - kUnderCeiling, height, std::min(wanted, height + kStretching * kTick)));
    if (free < wanted) headroom_ = avatar_.ceiling(body_.height_m);
  }
}

// What is too low for the body as it stands may be high enough for one that crouches; if not, it is said how high it
// is.
void Walker::stride(const Vector2d& way_m) {
  const Avatar from = avatar_;
  avatar_.strideOut(way_m);
  const double moved = (avatar_.feet() - from.feet()).head<2>().norm();
  if (moved > 0.5 * way_m.norm()) return;
  const double least = moved + 0.3 * way_m.norm();
  if (avatar_.height() > kCrouched_m && strideLower(from, kCrouched_m, way_m, least)) return;
  Avatar tiny = from;
  tiny.setHeight(kHighestStep + 2 * body_.radius_m);
  if (tiny.height() >= kCrouched_m) return;
  tiny.strideOut(kLookAhead * way_m.normalized());
  if ((tiny.feet() - from.feet()).head<2>().norm() < 0.6 * kLookAhead) return;
  if (const double free = tiny.ceiling(body_.height_m); free < kCrouched_m) headroom_ = free;
}

bool Walker::strideLower(const Avatar& from, double height_m, const Vector2d& way_m, double least_m) {
  Avatar lower = from;
  lower.setHeight(height_m);
  lower.strideOut(way_m);
  if ((lower.feet() - from.feet()).head<2>().norm() < least_m) return false;
  headroom_ = lower.ceiling(body_.height_m);
  lower.setHeight(std::clamp(lower.headroom(body_.height_m) - kUnderCeiling, height_m, from.height()));
  avatar_ = lower;
  return true;
}

void Walker::fall() {
  if (avatar_.onFloor()) {
    fall_speed_ = 0;
    fell_from_m_ = avatar_.feet().z();
    return;
  }
  fall_speed_ = std::min(kFastestFall, fall_speed_ + kGravity * kTick);
  avatar_.fall(fall_speed_ * kTick);
  const double z = avatar_.feet().z();
  if (z > lowest_m_ - kBelowAll && z > fell_from_m_ - kDeepestFall) return;
  const Vector3d firm = firm_.empty() ? before_.feet : firm_.front();
  if (!stand(firm + Vector3d(0, 0, 0.01), 0.1)) return;
  brought_back_s_ = kNoteFor;
}

void Walker::rememberFirmPlace() {
  if (!avatar_.onFloor() || ++since_firm_ < kFirmTicks) return;
  since_firm_ = 0;
  firm_.push_back(avatar_.feet());
  if (firm_.size() > kFirmPlaces) firm_.pop_front();
}

void Walker::smoothEyes() {
  const Vector3d eyes = eyesOverFeet();
  const double behind = now_.eyes.z() - eyes.z();
  const double lag = std::clamp(behind * std::exp(-kTick / kEyesFollow), -kMostLag, kMostLag);
  now_ = {avatar_.feet(), eyes + Vector3d(0, 0, std::abs(lag) < 1e-5 ? 0 : lag)};
}

}  // namespace standpoint
