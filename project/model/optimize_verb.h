// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "project/fields.h"
#include "project/model/lod_rules.h"
#include "project/verb.h"

namespace standpoint {

// What a request means for the model as it is now: rules looked up, products selected, the author's treatments on top.
struct SimplificationPlan {
  OptimizeOptions options;
  std::vector<LodLevel> levels;  // of the rules; empty without
};
Result<SimplificationPlan> planLightening(const Document& document, const SimplificationRequest& request,
                                          const Progress& progress);

// The verb; its options are kept in the document with what came of them.
const Fields<SimplificationRequest>& optimizeFields();
Result<Outcome> runOptimize(const Document& document, const SimplificationRequest& request, Progress& progress);

}  // namespace standpoint
