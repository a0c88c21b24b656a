// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "project/answers.h"
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

const AnswerFields<ProductLoss>& answerFields(const ProductLoss*);
struct OptimizedProduct : ProductIdentity, ProductLoss {
  std::string lod;
  std::optional<std::string> engine, rule;  // that made it lighter; that decided its limits
};
const AnswerFields<OptimizedProduct>& answerFields(const OptimizedProduct*);
struct OptimizeAnswer : ProductLoss {  // of all products
  std::string lod;
  bool budget_reached = true;
  std::optional<std::uint64_t> smallest_budget;  // where the budget was not reached
  std::vector<OptimizedProduct> products;        // that had triangles
};
const AnswerFields<OptimizeAnswer>& answerFields(const OptimizeAnswer*);
Result<Answered<OptimizeAnswer>> runOptimize(const Document& document, const SimplificationRequest& request,
                                             Progress& progress);
// The same towards a budget that is a wish: where the deviations do not allow it, the least that they allow takes its
// place in the request that is kept, and a note says so.
Result<Answered<OptimizeAnswer>> optimizeTowards(const Document& document, const SimplificationRequest& request,
                                                 Progress& progress);

}  // namespace standpoint
