// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/scan_readiness.h"

namespace standpoint {

std::shared_ptr<const ScanPreparation> ScanReadiness::at_hand() {
  if (task_ && task_->done()) {
    if (auto made = task_->take()) made_ = *std::move(made);
    task_.reset();
  }
  return made_;
}

void ScanReadiness::follow(const Document& document, const std::shared_ptr<const RayScene>& of_model,
                           const std::function<void()>& wake) {
  if (!document.environment() || !document.job || !of_model) return;
  const Wish wish{document.environment(), document.materials, document.job};
  if (wish == wish_) return;
  if (const auto made = at_hand(); made && made->fits(document)) {  // a station has moved
    wish_ = wish;
    return;
  }
  task_.reset();
  made_.reset();  // two of a large model need not lie in memory
  wish_ = wish;
  task_ = std::make_unique<Task<std::shared_ptr<const ScanPreparation>>>(
      "Prepare scans", [document, of_model](Progress& progress) { return prepareScan(document, of_model, progress); },
      wake);
}

}  // namespace standpoint
