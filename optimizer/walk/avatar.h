// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <optional>

#include <Eigen/Core>

#include "optimizer/walk/obstacles.h"
#include "optimizer/walk/walkable.h"

namespace standpoint {

inline constexpr double kHighestStep = 0.30;  // m that one person climbs; the walkable surface asks for less

// Somebody who walks: an upright capsule whose feet are on the floor under its axis, who climbs what is no higher than
// a step and lets nothing else through. No window, no clock: whoever steers it says how far it wants to go. Keeps a
// reference to the obstacles.
class Avatar {
 public:
  explicit Avatar(const Obstacles& obstacles, const Body& body = {}) : obstacles_(&obstacles), body_(body) {}

  // Puts it on the highest floor at most `reach_m` under p on which it has room; false, and it stays where it is, where
  // there is none.
  bool stand(const Eigen::Vector3d& p, double reach_m = 3);

  // Goes by this much, in strides so short that no step is left out, and slides along what is in the way. Where the
  // floor ends, or goes down by more than a step, it stops.
  void walk(const Eigen::Vector2d& way_m);

  // One stride, of at most 5 cm. It goes over the edge of a floor, and has nothing under its feet then.
  void strideOut(const Eigen::Vector2d& way_m) { stride(way_m, true); }
  bool onFloor() const { return on_floor_; }
  // Down by this much, or to the floor that is nearer, sliding off what the body meets.
  void fall(double down_m);

  // What else is in the way, as it stands between two strides; null: nothing. The floor is not among it.
  void alsoMeet(const Obstacles* others, const Obstacles* more = nullptr) { others_ = {others, more}; }

  const Eigen::Vector3d& feet() const { return feet_; }
  // How high it can be where it is, as far as `most_m`.
  double headroom(double most_m) const;
  // How high the lowest thing over it is, as far as `most_m`: the round crown of a body gets higher at its edge.
  double ceiling(double most_m) const;
  double height() const { return body_.height_m; }
  void setHeight(double height_m) { body_.height_m = height_m; }

 private:
  enum class Under { floor, steep, nothing };
  struct Ground {
    Under kind = Under::nothing;
    double height = 0;
  };
  Body upper() const { return {body_.radius_m, body_.height_m - kHighestStep}; }
  std::optional<Contact> sweep(const Body& body, const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;
  std::optional<Contact> overlap(const Body& body, const Eigen::Vector3d& feet, double depth_m) const;
  void near(const Body& body, const Eigen::Vector3d& feet, double within_m,
            const std::function<void(const Contact&, double)>& visit) const;
  Ground groundUnder(const Eigen::Vector3d& p, double below_m) const;
  bool carries(const Eigen::Vector3d& p) const;
  Body slim() const;
  bool isTreadAhead(const Contact& contact) const;
  std::optional<Contact> meets(const Eigen::Vector3d& from_feet, const Eigen::Vector3d& to_feet) const;
  std::optional<Eigen::Vector3d> offWalls(Eigen::Vector3d feet) const;
  enum class Step { made, refused, met };
  Step moveTo(const Eigen::Vector3d& place, bool over_edges, Contact& met);
  void stride(Eigen::Vector2d way_m, bool over_edges);

  const Obstacles* obstacles_;
  std::array<const Obstacles*, 2> others_{};
  Body body_;
  Eigen::Vector3d feet_ = Eigen::Vector3d::Zero();
  bool on_floor_ = true;
};

}  // namespace standpoint
