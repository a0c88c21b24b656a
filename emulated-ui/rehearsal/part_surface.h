// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <tuple>
#include <unordered_set>
#include <vector>

#include <Eigen/Core>

#include "core/environment.h"
#include "core/points.h"
#include "emulated-ui/rehearsal/exercise.h"
#include "scanners/forecast/surface_samples.h"

namespace standpoint {

// Which surfaces a part of an exercise means, and which points are on them. Places are in the local frame; the part and
// what it is made from must outlive it.
class PartSurface {
 public:
  PartSurface(const ExercisePart& part, const Environment& environment, const Eigen::Vector3d& shift_m);
  bool has(const SurfaceSample& sample) const;
  bool hasProducts() const { return !products_.empty(); }  // that the model has
  // Whether one of them reaches into the box; `bounds` are those of all products, local frame.
  bool meets(const std::vector<Bounds>& bounds) const;
  bool isLabel(const LabelledProduct& label) const { return labels_.contains(label.global_id + "/" + label.id); }
  bool inBox(const Eigen::Vector3d& local_m) const;

 private:
  bool isMeant(const Product& product) const;
  const ExercisePart& part_;
  Eigen::Vector3d shift_m_;
  std::set<std::uint32_t> products_;
  std::set<std::string> labels_;
};

// Where there are points: each makes the place around it one that is seen.
class SeenCells {
 public:
  static constexpr double kNear_m = 0.05;
  void add(const Eigen::Vector3d& p) { cells_.insert(cellOf(p)); }
  bool near(const Eigen::Vector3d& p) const;

 private:
  using Cell = std::tuple<std::int32_t, std::int32_t, std::int32_t>;
  struct CellHash {
    std::size_t operator()(const Cell& c) const;
  };
  static Cell cellOf(const Eigen::Vector3d& p);
  std::unordered_set<Cell, CellHash> cells_;
};

// The places of the largest patch: those that hang together by steps of 25 cm. Empty: there are none.
std::vector<Eigen::Vector3d> largestPatch(const std::vector<Eigen::Vector3d>& places);

}  // namespace standpoint
