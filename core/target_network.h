// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/result.h"
#include "core/survey.h"

namespace standpoint {

// A target as a station measured it, in the station's own frame.
struct Sighting {
  std::size_t station = 0, target = 0;
  Eigen::Vector3d place_m = Eigen::Vector3d::Zero();
  double sigma_m = 0.001;  // of each axis, before the fit
};
// A target whose place is known from elsewhere.
struct KnownPlace {
  std::size_t target = 0;
  Eigen::Vector3d place_m = Eigen::Vector3d::Zero();
  double sigma_m = 0.001;
};

// Stations tied by the targets that they share. Either one station is held, or known places hold all.
struct TargetNetwork {
  std::size_t stations = 0, targets = 0;
  std::vector<Sighting> sightings;
  std::vector<KnownPlace> known;
  std::optional<std::pair<std::size_t, Pose>> held;
};

struct NetworkFit {
  std::vector<Pose> pose;                                      // of each station
  std::vector<Eigen::Vector3d> sigma_shift_m, sigma_turn_rad;  // of each, 1 σ by what the fit leaves; zero where held
  std::vector<std::optional<Eigen::Vector3d>> target;          // nothing where nobody saw it
  std::vector<Eigen::Vector3d> residual_m;  // of each sighting, in the common frame: as placed less the target
  double sigma_factor = 0;                  // the sightings scatter by this times their stated σ; 0: nothing left over
  int redundancy = 0;                       // observations less unknowns
  int iterations = 0;
};

// Why a network does not hold together, for who knows the stations' names.
struct NetworkProblem {
  std::optional<std::size_t> station;  // that cannot be tied
  std::size_t shared = 0;              // targets that it has in common with those that are tied
  bool on_one_line = false;
};

// Chains the stations by three and more shared targets, then adjusts all at once (Gauss–Newton over stations and
// targets). Errors: fewer than three shared targets or all on one line (then `problem` says where), nothing held.
Result<NetworkFit> fitNetwork(const TargetNetwork& network, NetworkProblem* problem = nullptr);

// How far two stations disagree about a target that both saw: as one places it less as the other does.
struct LinkRow {
  std::size_t target = 0;
  Eigen::Vector3d difference_m = Eigen::Vector3d::Zero();
};
struct NetworkLink {
  std::size_t from = 0, to = 0;
  std::vector<LinkRow> rows;
  double rms_m = 0, mean_m = 0;  // of the 3D differences
  // What the differences would be without the freedom of the fit: rms · √(3n / (3n - 6)); nothing with two targets.
  std::optional<double> unbiased_m;
};
std::vector<NetworkLink> linksOf(const TargetNetwork& network, const NetworkFit& fit);

}  // namespace standpoint
