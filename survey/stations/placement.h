// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scanners/engine/ray_engine.h"
#include "scanners/instruments/stand.h"

namespace standpoint {

// Why a station cannot stand where it should, and what helps. `brief` is the reason in some five words.
struct Refusal {
  std::string reason, remedy, brief;
};

// What is straight below an instrument.
struct Ground {
  double z = 0;  // local frame
  double slope_rad = 0;
  std::string product;   // "IfcSlab #12 'Floor'"; empty where the model ends and its lowest height stands in
  bool ceiling = false;  // a suspended one
  std::optional<std::uint32_t> index = {};  // of the product
  bool modelled() const { return !product.empty(); }
};

// Whether an instrument can stand at a place of a scene. Built once for a scene, asked often; thread-safe.
class StationPlacement {
 public:
  // `trunnion_m`: of the tilting axis above the tripod's plate. The scene must outlive this.
  StationPlacement(const RayScene& scene, const TripodStand& stand, double trunnion_m);

  // All checks of a station on a tripod: clearance, headroom, ground, feet, bodies.
  std::optional<Refusal> whyNot(const Eigen::Vector3d& centre) const;
  // The same on a surface that was pointed at.
  std::optional<Refusal> whyNotOn(const RayHit& hit, double height_m) const;
  // Of a scanner that hangs or is held: only that it touches nothing.
  std::optional<Refusal> tooNear(const Eigen::Vector3d& centre) const;
  // The surface that is nearest to an instrument, where one is nearer than `reach_m`.
  struct Near {
    double distance_m = 0;
    std::uint32_t product = 0;
  };
  std::optional<Near> nearest(const Eigen::Vector3d& centre, double reach_m) const;
  // A quick look for many places: what passes may still be refused by whyNot().
  bool worthTrying(const Eigen::Vector3d& centre) const;

  // What is odd about a place that is not refused: it lies in a body without a class, which may be a room drawn as one
  // skin.
  std::optional<std::string> remark(const Eigen::Vector3d& centre) const;

  std::optional<Ground> groundBelow(const Eigen::Vector3d& centre) const;
  std::optional<Refusal> badHeight(double height_m) const;
  double lowest_m() const { return stand_.lowest_m(trunnion_m_); }
  double highest_m() const { return stand_.highest_m(trunnion_m_); }
  const TripodStand& stand() const { return stand_; }
  const RayScene& scene() const { return scene_; }

 private:
  std::string steepText(double slope_rad, const Product& product) const;
  std::optional<Refusal> noHeadroom(const Eigen::Vector3d& centre) const;
  std::optional<Refusal> badGround(const Eigen::Vector3d& centre) const;
  std::optional<Refusal> noFooting(const Eigen::Vector3d& centre, const Ground& ground) const;

  const RayScene& scene_;
  TripodStand stand_;
  double trunnion_m_ = 0;
  Bounds all_;
  std::vector<Bounds> instances_;  // empty of what is not in the scene
};

// Of a hit's triangle against the horizontal, 0 to π/2.
double slopeOf(const RayHit& hit);
// What people call a product of its class: "wall", "building element", or "object" where it has none.
std::string plainKind(const Product& product);
// With its article: "a wall", "an object".
std::string someKind(const Product& product);

}  // namespace standpoint
