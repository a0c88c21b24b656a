// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/placing/placement_view.h"

#include "survey/instruments.h"
#include "survey/stations/station_places.h"

namespace standpoint {

void PlacementView::follow(std::shared_ptr<const RayScene> scene) {
  if (scene == scene_) return;
  placement_.reset();
  scene_ = std::move(scene);
  asked_.reset();
  judged_.clear();
  answer_ = {Verdict::unknown, "Preparing the model …", {}};
  if (!scene_) return;
  const auto stand = readTripodStand(tripodStandFile());
  if (stand) placement_ = std::make_unique<StationPlacement>(*scene_, *stand, kUsualTrunnion_m);
}

const PlaceVerdict& PlacementView::judge(const RayHit& hit, double height_m, double nearest_m) {
  const bool same = asked_ && *asked_ == hit.position && asked_height_m_ == height_m && asked_nearest_m_ == nearest_m;
  if (!placement_ || same) return answer_;
  asked_ = hit.position;
  asked_height_m_ = height_m;
  asked_nearest_m_ = nearest_m;
  answer_ = judgePlace(*placement_, hit, height_m, nearest_m);
  return answer_;
}

const PlaceVerdict* PlacementView::judgeStation(const Eigen::Vector3d& centre, bool on_tripod, double nearest_m) const {
  constexpr std::size_t kMostKept = 4;
  if (!placement_) return nullptr;
  for (const auto& judged : judged_)
    if (judged.centre == centre && judged.on_tripod == on_tripod && judged.nearest_m == nearest_m)
      return &judged.verdict;
  judged_.push_front(
      {centre, on_tripod, nearest_m, standpoint::judgeStation(*placement_, centre, on_tripod, nearest_m)});
  if (judged_.size() > kMostKept) judged_.pop_back();
  return &judged_.front().verdict;
}

}  // namespace standpoint
