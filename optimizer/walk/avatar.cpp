// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/walk/avatar.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace standpoint {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kStride = 0.05;   // m
constexpr int kMostSlides = 4;     // of one stride: into a corner and out of it
constexpr double kCrack = 0.04;    // m, between two floors, that a foot does not notice
constexpr double kFoot = 0.12;     // m around the axis: on this much of a floor one still stands
constexpr double kLegs = 0.05;     // m around the axis: less than the narrowest tread that one steps on is deep
constexpr double kUneven = 0.012;  // m that one part of a wall stands out from another: collision shapes keep to 10 mm
constexpr int kMostPushes = 4;
const Vector3d kStepUp(0, 0, kHighestStep);

}  // namespace

std::optional<Contact> Avatar::sweep(const Body& body, const Vector3d& from, const Vector3d& to) const {
  auto first = obstacles_->sweep(body, from, to);
  for (const auto* others : others_) {
    const auto other = others != nullptr ? others->sweep(body, from, to) : std::nullopt;
    if (other && (!first || other->fraction < first->fraction)) first = other;
  }
  return first;
}

std::optional<Contact> Avatar::overlap(const Body& body, const Vector3d& feet, double depth_m) const {
  auto found = obstacles_->overlap(body, feet, depth_m);
  for (const auto* others : others_)
    if (!found && others != nullptr) found = others->overlap(body, feet, depth_m);
  return found;
}

void Avatar::near(const Body& body, const Vector3d& feet, double within_m,
                  const std::function<void(const Contact&, double)>& visit) const {
  obstacles_->near(body, feet, within_m, visit);
  for (const auto* others : others_)
    if (others != nullptr) others->near(body, feet, within_m, visit);
}

// Under the axis itself, so that nobody floats beside a step.
Avatar::Ground Avatar::groundUnder(const Vector3d& p, double below_m) const {
  const auto hit = obstacles_->ray(p + kStepUp, p - Vector3d(0, 0, below_m));
  if (!hit) return {};
  const double least = std::cos(kSteepestSlopeDeg * std::numbers::pi / 180) - 1e-6;
  return {hit->normal.z() >= least ? Under::floor : Under::steep, hit->point.z()};
}

// Whether a floor is under the feet somewhere, so that nobody falls into a crack or off an edge with the toes.
bool Avatar::carries(const Vector3d& p) const {
  for (int i = 0; i < 8; ++i) {
    const double angle = i * std::numbers::pi / 4;
    const auto ground = groundUnder(p + kFoot * Vector3d(std::cos(angle), std::sin(angle), 0), 0.02);
    if (ground.kind == Under::floor && ground.height <= p.z() + 0.02) return true;
  }
  return false;
}

bool Avatar::stand(const Vector3d& p, double reach_m) {
  const auto ground = groundUnder(p, reach_m);
  if (ground.kind != Under::floor) return false;
  const Vector3d feet(p.x(), p.y(), ground.height);
  if (overlap(upper(), feet + kStepUp, 1e-3)) return false;
  feet_ = feet;
  on_floor_ = true;
  return true;
}

// That gets past an unevenness of the wall that the body touches.
Body Avatar::slim() const {
  const Body body = upper();
  return {std::max(0.5 * body.radius_m, body.radius_m - kUneven), body.height_m};
}

// The treads of a stair are higher than a step from the second on, and narrow where it winds: a body as wide as the
// shoulders meets them, and legs do not. Other things of their height have no tread before them.
bool Avatar::isTreadAhead(const Contact& contact) const {
  const double up = contact.point.z() - feet_.z();
  if (up <= kHighestStep - kUneven || up > 2 * kHighestStep + kUneven) return false;
  for (const double share : {0.3, 0.5, 0.7, 0.9}) {
    const Vector2d between = feet_.head<2>() + share * (contact.point - feet_).head<2>();
    const auto ground = groundUnder({between.x(), between.y(), feet_.z()}, 0.02);
    if (ground.kind == Under::floor && ground.height > feet_.z() + 0.05) return true;
  }
  return false;
}

// What the body meets on its way; over the treads of a stair that it climbs, with the trunk and the legs apart.
std::optional<Contact> Avatar::meets(const Vector3d& from_feet, const Vector3d& to_feet) const {
  const auto hit = sweep(upper(), from_feet + kStepUp, to_feet + kStepUp);
  const Body trunk{body_.radius_m, body_.height_m - 2 * kHighestStep};
  if (!hit || trunk.height_m < 2 * trunk.radius_m || !isTreadAhead(*hit)) return hit;
  const auto above = sweep(trunk, from_feet + 2 * kStepUp, to_feet + 2 * kStepUp);
  const auto below = sweep({std::min(kLegs, body_.radius_m), upper().height_m}, from_feet + kStepUp, to_feet + kStepUp);
  return above && (!below || above->fraction < below->fraction) ? above : below;
}

// Beside what reaches into the body a little from aside; nothing where it stays in something.
std::optional<Vector3d> Avatar::offWalls(Vector3d feet) const {
  for (int i = 0; i < kMostPushes; ++i) {
    double deepest = -1e-4;
    Vector2d away = Vector2d::Zero();
    near(upper(), feet + kStepUp, 0, [&](const Contact& contact, double gap) {
      const Vector2d side = contact.normal.head<2>();
      if (gap >= deepest || gap < -kUneven || side.norm() < 0.7) return;
      deepest = gap;
      away = side.normalized() * (1e-5 - gap);
    });
    if (away.isZero()) break;
    feet.head<2>() += away;
  }
  return overlap(upper(), feet + kStepUp, 1e-3) ? std::nullopt : std::optional(feet);
}

// The feet go to the floor there, unless it is too high or too steep for them; or too deep, where they mind. What the
// body would meet on its way up or down is `met`.
Avatar::Step Avatar::moveTo(const Vector3d& place, bool over_edges, Contact& met) {
  const auto ground = groundUnder(place, kHighestStep);
  if (ground.kind == Under::steep) return Step::refused;
  if (ground.kind == Under::nothing) {
    if (!over_edges) return Step::refused;
    feet_ = place;
    on_floor_ = on_floor_ && carries(place);
    return Step::made;
  }
  const Vector3d feet(place.x(), place.y(), ground.height);
  if (const auto hit = meets(place, feet)) {
    met = *hit;
    if (sweep(slim(), place + kStepUp, feet + kStepUp)) return Step::met;
    const auto beside = offWalls(feet);
    if (!beside) return Step::met;
    feet_ = *beside;
  } else {
    feet_ = feet;
  }
  on_floor_ = true;
  return Step::made;
}

namespace {

// What is left of a way along what it leads into; nothing where that is level.
Vector2d along(const Vector2d& way, const Contact& contact) {
  const Vector2d across = contact.normal.head<2>();
  if (across.norm() < 1e-3) return Vector2d::Zero();
  return way - across.normalized() * std::min(0.0, way.dot(across.normalized()));
}

}  // namespace

void Avatar::stride(Vector2d way_m, bool over_edges) {
  constexpr double kClimbed = 0.02;  // m
  for (int i = 0; i < kMostSlides && way_m.norm() > 1e-6; ++i) {
    const Vector3d way(way_m.x(), way_m.y(), 0);
    const auto hit = meets(feet_, feet_ + way);
    const double fraction = hit ? hit->fraction : 1, height = feet_.z();
    Contact met;
    if (hit && fraction == 0) {  // a body that has stretched may reach into what it stood beside
      if (const auto beside = offWalls(feet_)) feet_ = *beside;
    } else if (const auto step = moveTo(feet_ + fraction * way, over_edges, met); step == Step::met) {
      const auto slid = along(way_m, met);
      if (slid == way_m) return;
      way_m = slid;
      continue;
    } else if (step == Step::refused) {
      const Vector3d over = way + kCrack * way.normalized();
      if (!hit && !meets(feet_, feet_ + over)) moveTo(feet_ + over, false, met);
      return;
    }
    if (!hit) return;
    way_m *= 1 - fraction;
    if (feet_.z() < height + kClimbed) way_m = along(way_m, *hit);  // else it is below now
  }
}

void Avatar::fall(double down_m) {
  if (const auto ground = groundUnder(feet_, down_m); ground.kind == Under::floor) {
    const Vector3d feet(feet_.x(), feet_.y(), ground.height);
    if (!sweep(upper(), feet_ + kStepUp, feet + kStepUp)) {
      feet_ = feet;
      on_floor_ = true;
      return;
    }
  }
  on_floor_ = false;
  Vector3d way(0, 0, -down_m);
  for (int i = 0; i < kMostSlides && way.norm() > 1e-6; ++i) {
    const auto hit = sweep(upper(), feet_ + kStepUp, feet_ + kStepUp + way);
    feet_ += (hit ? hit->fraction : 1) * way;
    if (!hit) return;
    way *= 1 - hit->fraction;
    way -= hit->normal * std::min(0.0, way.dot(hit->normal));
  }
}

double Avatar::headroom(double most_m) const {
  const double over = most_m - body_.height_m;
  if (over <= 0) return body_.height_m;
  const Vector3d from = feet_ + kStepUp;
  const auto hit = sweep(slim(), from, from + Vector3d(0, 0, over));
  return body_.height_m + (hit ? hit->fraction : 1) * over;
}

double Avatar::ceiling(double most_m) const {
  double lowest = headroom(most_m);
  // From where its crown begins: what is lower beside it, as the next treads of a stair are, is over nobody.
  const Vector3d crown(0, 0, std::max(kHighestStep, body_.height_m - body_.radius_m));
  const auto look = [&](const Vector3d& aside) {
    const Vector3d from = feet_ + aside;
    if (const auto hit = obstacles_->ray(from + crown, from + Vector3d(0, 0, lowest)))
      lowest = hit->point.z() - feet_.z();
  };
  look(Vector3d::Zero());
  for (int i = 0; i < 16; ++i) {
    const double angle = i * std::numbers::pi / 8;
    look((slim().radius_m - 2e-3) * Vector3d(std::cos(angle), std::sin(angle), 0));
  }
  return lowest;
}

void Avatar::walk(const Vector2d& way_m) {
  const double length = way_m.norm();
  if (!std::isfinite(length)) return;
  const int strides = static_cast<int>(std::ceil(std::min(length, 100.0) / kStride));
  for (int i = 0; i < strides; ++i) stride(way_m / strides, false);
}

}  // namespace standpoint
