// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/budget_preview.h"

#include "project/model/optimize_verb.h"

namespace standpoint {

BudgetPreview::~BudgetPreview() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    if (progress_) progress_->cancel();
  }
  changed_.notify_all();
  if (worker_.joinable()) worker_.join();
}

void BudgetPreview::want(const Document& document, const SimplificationRequest& request) {
  const Wish wish{document.imported, document.treatments, request.by_view ? document.collision : nullptr, request};
  const std::lock_guard lock(mutex_);
  if (wish_ == wish) return;
  if (progress_ && wish_ && !wish_->sameModel(wish)) progress_->cancel();
  wish_ = wish;
  if (!worker_.joinable()) worker_ = std::thread([this] { work(); });
  changed_.notify_all();
}

void BudgetPreview::drop() {
  const std::lock_guard lock(mutex_);
  if (!wish_) return;
  wish_.reset();
  state_ = {};
  if (progress_) progress_->cancel();
  changed_.notify_all();
}

BudgetPreview::State BudgetPreview::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

void BudgetPreview::prepare(const Wish& wish) {
  preview_.reset();
  Progress* progress = nullptr;
  {
    const std::lock_guard lock(mutex_);
    progress_ = std::make_unique<Progress>();
    progress = progress_.get();
    state_ = {true, state_.shown, state_.triangles, 0, {}};
  }
  Document document;
  document.imported = wish.imported;
  document.treatments = wish.treatments;
  document.collision = wish.collision;
  const auto plan = planLightening(document, wish.request, *progress);
  auto made = plan ? OptimizePreview::prepare(wish.imported, plan->options, *progress) : failure(plan.error());
  const std::lock_guard lock(mutex_);
  progress_.reset();
  state_.preparing = false;
  if (made)
    preview_ = std::move(*made);
  else if (made.error().kind != ErrorKind::cancelled)
    state_.error = describe(made.error());
}

void BudgetPreview::work() {
  std::optional<Wish> prepared, done;
  while (true) {
    Wish wish;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return ended_ || wish_ != done; });
      if (ended_) return;
      done = wish_;
      if (!wish_) {
        preview_.reset();
        prepared.reset();
        continue;
      }
      wish = *wish_;
    }
    if (!prepared || !prepared->sameModel(wish)) {
      prepared = wish;
      prepare(wish);
      if (!preview_) prepared.reset();
    }
    if (!preview_) {
      if (wake_) wake_();
      continue;
    }
    auto shown = preview_->at(wish.request.budget.value_or(1));
    {
      const std::lock_guard lock(mutex_);
      if (wish_ && wish_->sameModel(wish)) state_ = {false, shown, sceneTriangleCount(*shown), preview_->least(), {}};
    }
    if (wake_) wake_();
  }
}

}  // namespace standpoint
