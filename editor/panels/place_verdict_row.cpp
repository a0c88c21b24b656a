// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/panels/place_verdict_row.h"

#include "editor/model/model.h"
#include "editor/model/outliner_rows.h"
#include "editor/model/station_steps.h"
#include "editor/widgets/verdict_sign.h"
#include "editor/widgets/widgets.h"
#include "editor/words/sentences.h"

namespace standpoint {

const PlaceVerdict* placeVerdict(const Model& model, KeptVerdict& kept, const Eigen::Vector3d& centre, bool on_tripod) {
  const auto* placement = model.placement.placement();
  const auto scene = model.picker.scene();
  if (placement == nullptr || &placement->scene() != scene.get()) return nullptr;
  const double nearest_m = nearestRange_m(model);
  if (kept.scene.lock() != scene || kept.centre != centre || kept.on_tripod != on_tripod || kept.nearest_m != nearest_m)
    kept = {scene, centre, on_tripod, nearest_m, judgeStation(*placement, centre, on_tripod, nearest_m)};
  return &kept.answer;
}

void drawPlaceVerdict(const Model& model, KeptVerdict& kept, const Eigen::Vector3d& centre, bool on_tripod) {
  const auto* found = placeVerdict(model, kept, centre, on_tripod);
  if (found == nullptr) return;
  ui::verdict(found->verdict);
  ui::wrapped(withVerdictWord(found->verdict, trSentence(found->brief)));
  if (!found->reason.empty()) ui::dimWrapped(withReadableClasses(trSentence(found->reason)));
}

}  // namespace standpoint
