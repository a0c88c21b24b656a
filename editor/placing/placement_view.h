// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <list>
#include <memory>
#include <optional>

#include "survey/quality/place_verdict.h"

namespace standpoint {

// Whether a station could stand where the pointer is, asked anew in each frame: the checks of the verb, live. The
// answer is kept while the pointer rests.
class PlacementView {
 public:
  // Null: nothing can be asked yet. Cheap while the scene is the same.
  void follow(std::shared_ptr<const RayScene> scene);
  bool ready() const { return placement_ != nullptr; }
  const StationPlacement* placement() const { return placement_.get(); }
  // `nearest_m`: the shortest range of the instrument. Unknown until it is ready.
  const PlaceVerdict& judge(const RayHit& hit, double height_m, double nearest_m);
  // Of a station by its centre, local frame, as judgeStation() of survey/quality/place_verdict.h; null until it is
  // ready. The last few answers are kept, whoever asked: panels and view ask in each frame.
  const PlaceVerdict* judgeStation(const Eigen::Vector3d& centre, bool on_tripod, double nearest_m) const;

 private:
  std::shared_ptr<const RayScene> scene_;
  std::unique_ptr<StationPlacement> placement_;
  std::optional<Eigen::Vector3d> asked_;
  double asked_height_m_ = 0, asked_nearest_m_ = 0;
  PlaceVerdict answer_;
  struct Judged {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    bool on_tripod = true;
    double nearest_m = 0;
    PlaceVerdict verdict;
  };
  mutable std::list<Judged> judged_;  // the newest first
};

// A place where a station was not put, and why; until the next click.
struct RefusedPlace {
  std::string station;                   // that stays where it was; "" of a new one
  std::string brief, reason;             // as of PlaceVerdict
  std::optional<Eigen::Vector3d> floor;  // local frame
};

}  // namespace standpoint
