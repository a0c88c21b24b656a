// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/budget_preview.h"

#include <optional>

#include "editor/words/sentences.h"
#include "optimizer/simplify/preview.h"
#include "project/model/optimize_verb.h"

namespace standpoint {

// All levels of a model within its limits.
struct BudgetPreview::Prepared {
  std::optional<Wish> of;
  std::unique_ptr<OptimizePreview> levels;
};

Result<BudgetPreview::Shown> BudgetPreview::shownAt(const Wish& wish, Prepared& prepared, Progress& progress) {
  if (!prepared.of || !prepared.of->sameModel(wish)) {
    prepared = {};
    Document document;
    document.imported = wish.imported;
    document.treatments = wish.treatments;
    document.collision = wish.collision;
    TRY_ASSIGN(const auto plan, planLightening(document, wish.request, progress));
    TRY_ASSIGN(prepared.levels, OptimizePreview::prepare(wish.imported, plan.options, progress));
    prepared.of = wish;
  }
  auto shown = prepared.levels->at(wish.request.budget.value_or(1));
  const auto triangles = sceneTriangleCount(*shown);
  return Shown{std::move(shown), triangles, prepared.levels->least()};
}

void BudgetPreview::want(const Document& document, const SimplificationRequest& request) {
  const Wish wish{document.imported, document.treatments, request.by_view ? document.collision : nullptr, request};
  if (!latest_.wants(wish)) {
    using Older = decltype(latest_)::Older;
    const bool goes_on = latest_.wanted() && latest_.wanted()->sameModel(wish);
    if (!prepared_) prepared_ = std::make_shared<Prepared>();
    latest_.want(
        wish, [wish, prepared = prepared_](Progress& progress) { return shownAt(wish, *prepared, progress); },
        goes_on ? Older::ends : Older::stops);
  }
  latest_.poll();
  followAnswer();
}

// What is shown stays until another is made, also while another model is prepared.
void BudgetPreview::followAnswer() {
  const auto& latest = latest_.latest();
  const bool same = latest && latest->wish.sameModel(*latest_.wanted());
  state_.preparing = latest_.busy() && !(same && latest->result);
  if (state_.preparing) state_.least = 0, state_.error.clear();
  if (!same || state_.preparing) return;
  if (latest->result)
    state_ = {false, latest->result->environment, latest->result->triangles, latest->result->least, {}};
  else
    state_.error = trError(latest->result.error());
}

void BudgetPreview::drop() {
  latest_.drop();
  prepared_.reset();
  state_ = {};
}

}  // namespace standpoint
