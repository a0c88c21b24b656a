// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "optimizer/simplify/preview.h"
#include "project/document.h"

namespace standpoint {

// The model at the budget that a slider has right now. Works in the background; of several wishes only the last counts.
class BudgetPreview {
 public:
  explicit BudgetPreview(std::function<void()> wake) : wake_(std::move(wake)) {}
  ~BudgetPreview();
  // Of the imported model with the document's treatments. Other limits, or another model, are prepared first.
  void want(const Document& document, const SimplificationRequest& request);
  void drop();  // shows nothing and forgets what was prepared

  struct State {
    bool preparing = false;
    std::shared_ptr<const Environment> shown;  // null until there is one
    std::uint64_t triangles = 0, least = 0;
    std::string error;
  };
  State state() const;

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
  void work();
  void prepare(const Wish& wish);

  std::function<void()> wake_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Wish> wish_;
  bool ended_ = false;
  State state_;
  std::unique_ptr<Progress> progress_;        // of what is prepared
  std::unique_ptr<OptimizePreview> preview_;  // the worker's own
  std::thread worker_;
};

}  // namespace standpoint
