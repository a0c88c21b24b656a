// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/panels/place_verdict_row.h"

#include "editor/model/outliner_rows.h"
#include "editor/model/station_steps.h"
#include "editor/widgets/verdict_sign.h"
#include "editor/widgets/widgets.h"
#include "editor/words/sentences.h"

namespace standpoint {

void drawPlaceVerdict(const Model& model, const Eigen::Vector3d& centre, bool on_tripod) {
  const auto* found = verdictOfStation(model, centre, on_tripod);
  if (found == nullptr) return;
  ui::verdict(found->verdict);
  ui::wrapped(withVerdictWord(found->verdict, trSentence(found->brief)));
  if (!found->reason.empty()) ui::dimWrapped(withReadableClasses(trSentence(found->reason)));
}

}  // namespace standpoint
