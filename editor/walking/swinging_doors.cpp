// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/walking/swinging_doors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace standpoint {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kOpenBefore_m = 1.2, kDoorReach_m = 1.8;
constexpr double kAway_m = 2, kCloseAfter_s = 2;
constexpr double kSwing_s = 0.4;  // a quarter of a turn
constexpr double kInIt_m = 0.45;
constexpr double kSameStorey_m = 1;
constexpr double kTowardsDoor = 0.3;  // cosine to where one goes

// To the door's opening, seen from above; far where it is on another storey.
Vector2d wayToDoor(const Passage& passage, const Vector3d& feet) {
  if (std::abs(passage.middle.z() - feet.z()) > kSameStorey_m)
    return Vector2d::Constant(std::numeric_limits<double>::max() / 4);
  const Vector2d across = passage.across.head<2>(), off = (feet - passage.middle).head<2>();
  const double along = std::clamp(across.dot(off), -passage.half_width, passage.half_width);
  return along * across - off;
}

bool isTowardsDoor(const Vector2d& way, const Vector2d& going) { return way.dot(going) > kTowardsDoor * way.norm(); }

}  // namespace

SwingingDoors::SwingingDoors(std::shared_ptr<const DoorLeaves> leaves)
    : leaves_(std::move(leaves)), states_(leaves_->doors.size()) {
  if (!states_.empty()) scene_ = std::make_shared<const Environment>(leaves_->scene);
}

void SwingingDoors::open(std::size_t door, const Vector3d& feet) {
  const auto& passage = leaves_->doors[door].passage;
  states_[door].wanted = passage.through.dot(feet - passage.middle) > 0 ? -1 : 1;  // away from whoever comes
}

void SwingingDoors::follow(const Vector3d& feet, const Vector2d& going, double seconds) {
  bool turned = false;
  moves_ = false;
  for (std::size_t i = 0; i < states_.size(); ++i) {
    auto& state = states_[i];
    const Vector2d way = wayToDoor(leaves_->doors[i].passage, feet);
    const double distance = way.norm();
    if (!state.by_hand && state.wanted == 0 && distance < kOpenBefore_m && isTowardsDoor(way, going)) open(i, feet);
    state.away_s = distance > kAway_m ? state.away_s + seconds : 0;
    if (state.away_s > kCloseAfter_s) {
      state.wanted = 0;
      state.by_hand = state.by_hand && state.opened != 0;  // until it has closed
    }
    const double before = state.opened, step = seconds / kSwing_s;
    state.opened += std::clamp(state.wanted - state.opened, -step, step);
    turned = turned || state.opened != before;
    // One that is open waits for its time to close.
    moves_ = moves_ || state.opened != state.wanted || (state.opened != 0 && state.away_s > 0);
  }
  if (!turned) return;
  std::vector<double> opened;
  for (const auto& state : states_) opened.push_back(state.opened);
  scene_ = std::make_shared<const Environment>(swung(*leaves_, opened));
  shutBodies();
}

std::optional<std::size_t> SwingingDoors::inReach(const Vector3d& feet, const Vector2d& ahead) const {
  std::optional<std::size_t> best;
  double nearest = kDoorReach_m;
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const Vector2d way = wayToDoor(leaves_->doors[i].passage, feet);
    if (way.norm() >= nearest || !isTowardsDoor(way, ahead)) continue;
    nearest = way.norm();
    best = i;
  }
  return best;
}

bool SwingingDoors::toggle(const Vector3d& feet, const Vector2d& ahead) {
  const auto door = inReach(feet, ahead);
  if (!door) return false;
  auto& state = states_[*door];
  if (state.wanted == 0) {
    open(*door, feet);
  } else {
    if (wayToDoor(leaves_->doors[*door].passage, feet).norm() < kInIt_m) return false;
    state.wanted = 0;
  }
  state.by_hand = true;
  shutBodies();
  return true;
}

void SwingingDoors::shutBodies() {
  std::vector<CollisionShape> plates;
  for (std::size_t i = 0; i < states_.size(); ++i)
    if (states_[i].shut()) plates.push_back(doorPlate(leaves_->doors[i].passage, leaves_->doors[i].product));
  shut_ = plates.empty() ? nullptr : std::make_unique<Obstacles>(plates);
}

}  // namespace standpoint
