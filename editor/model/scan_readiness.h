// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <thread>

#include "project/scan_preparation.h"

namespace standpoint {

// Keeps what a scan of the document needs at hand, so that its first points come at once. Made beside the interface.
class ScanReadiness {
 public:
  ScanReadiness() = default;
  ~ScanReadiness();
  ScanReadiness(const ScanReadiness&) = delete;
  ScanReadiness& operator=(const ScanReadiness&) = delete;

  // To be called while a scan may be asked for. `of_model`: the picker's scene, null while it is being built.
  void follow(const Document& document, const std::shared_ptr<const RayScene>& of_model,
              const std::function<void()>& wake);
  void wait();
  // Null while it is being made, or when it cannot be.
  std::shared_ptr<const ScanPreparation> at_hand();

 private:
  struct Wish {
    std::shared_ptr<const Environment> model;
    std::shared_ptr<const MaterialChoice> materials;
    std::shared_ptr<const Job> job;
    bool operator==(const Wish&) const = default;
  };
  void stop();

  std::optional<Wish> wish_;
  std::shared_ptr<const ScanPreparation> made_;
  std::shared_ptr<const ScanPreparation> result_;  // the worker's, until done_
  std::unique_ptr<Progress> progress_;
  std::atomic<bool> done_{false};
  std::thread worker_;
};

}  // namespace standpoint
