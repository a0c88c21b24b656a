// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "project/document.h"
#include "project/latest_task.h"

namespace standpoint {

// The model at the budget that a slider has right now. Works in the background; of several wishes only the last counts.
class BudgetPreview {
 public:
  explicit BudgetPreview(std::function<void()> wake) : latest_("Budget preview", std::move(wake)) {}
  // Of the imported model with the document's treatments. Other limits, or another model, are prepared first.
  void want(const Document& document, const SimplificationRequest& request);
  void drop();  // shows nothing and forgets what was prepared

  struct State {
    bool preparing = false;
    std::shared_ptr<const Environment> shown;  // null until there is one
    std::uint64_t triangles = 0, least = 0;
    std::string error;
  };
  const State& state() const { return state_; }

 private:
  struct Wish {
    std::shared_ptr<const Environment> imported;
    std::shared_ptr<const std::vector<Treatment>> treatments;
    std::shared_ptr<const CollideResult> collision;
    SimplificationRequest request;
    // But for the budget.
    bool sameModel(const Wish& o) const {
      Wish other = o;
      other.request.budget = request.budget;
      return *this == other;
    }
    bool operator==(const Wish&) const = default;
  };
  struct Prepared;
  struct Shown {
    std::shared_ptr<const Environment> environment;
    std::uint64_t triangles = 0, least = 0;
  };
  static Result<Shown> shownAt(const Wish& wish, Prepared& prepared, Progress& progress);
  void followAnswer();

  State state_;
  std::shared_ptr<Prepared> prepared_;  // the works' own, which hand it from one to the next
  LatestTask<Wish, Shown> latest_;
};

}  // namespace standpoint
