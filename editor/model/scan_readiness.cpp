// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/scan_readiness.h"

namespace standpoint {

ScanReadiness::~ScanReadiness() { stop(); }

void ScanReadiness::stop() {
  if (progress_) progress_->cancel();
  if (worker_.joinable()) worker_.join();
}

void ScanReadiness::wait() {
  if (worker_.joinable()) worker_.join();
}

std::shared_ptr<const ScanPreparation> ScanReadiness::at_hand() {
  if (done_.exchange(false)) {
    wait();
    made_ = std::move(result_);
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
  stop();
  done_.store(false);
  made_.reset();  // two of a large model need not lie in memory
  wish_ = wish;
  progress_ = std::make_unique<Progress>();
  worker_ = std::thread([this, document, of_model, wake] {
    if (auto prepared = prepareScan(document, of_model, *progress_)) result_ = *std::move(prepared);
    done_.store(true);
    if (wake) wake();
  });
}

}  // namespace standpoint
