// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "project/survey/scan_preparation.h"
#include "project/task.h"

namespace standpoint {

// Keeps what a scan of the document needs at hand, so that its first points come at once. Made beside the interface.
class ScanReadiness {
 public:
  // To be called while a scan may be asked for. `of_model`: the picker's scene, null while it is being built.
  void follow(const Document& document, const std::shared_ptr<const RayScene>& of_model,
              const std::function<void()>& wake);
  void wait() {
    if (task_) task_->wait();
  }
  // Null while it is being made, or when it cannot be.
  std::shared_ptr<const ScanPreparation> at_hand();

 private:
  struct Wish {
    std::shared_ptr<const Environment> model;
    std::shared_ptr<const MaterialChoice> materials;
    std::shared_ptr<const Job> job;
    bool operator==(const Wish&) const = default;
  };
  std::optional<Wish> wish_;
  std::shared_ptr<const ScanPreparation> made_;
  std::unique_ptr<Task<std::shared_ptr<const ScanPreparation>>> task_;
};

}  // namespace standpoint
