// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "project/task.h"
#include "survey/targets/target_measuring.h"
#include "survey/targets/target_sight.h"

namespace standpoint {

// A target as one station sees it: by what is to be expected, and as its last scan shows it.
struct TargetRow {
  std::size_t target = 0, station = 0;  // indices into the job
  TargetSight sight;
  bool scanned = false;  // by this station, since the target stands
  std::optional<TargetFit> fit;
  std::string why_not;  // of a scan in which it was not found
};

// The list of all of them, kept beside the interface: what is expected at once, fits when the scans have been read.
class TargetList {
 public:
  explicit TargetList(std::function<void()> wake) : wake_(std::move(wake)) {}
  // `settings` are those of the scans to come. Cheap while nothing has changed.
  void follow(const Document& document, const std::shared_ptr<const RayScene>& scene,
              const std::optional<ScanSettings>& settings);
  void wait() {
    if (task_) task_->wait();
  }
  bool busy() const;
  std::vector<TargetRow> rows() const;
  std::string problem() const;  // why the scans could not be read; empty when they could
  // What the program ships; null when it cannot be read.
  const TargetKinds* kinds();

 private:
  struct Wish {
    std::shared_ptr<const Job> job;
    std::shared_ptr<const RayScene> scene;
    SettingValues settings;
    std::uint32_t columns = 0;
    bool operator==(const Wish&) const = default;
  };
  void work(const Document& document, const RayScene& scene, const std::optional<ScanSettings>& settings,
            Progress& progress);

  std::function<void()> wake_;
  std::optional<TargetKinds> kinds_;
  bool kinds_read_ = false;
  std::optional<Wish> wish_;
  mutable std::mutex mutex_;  // of what follows
  bool busy_ = false;
  std::vector<TargetRow> rows_;
  std::string problem_;
  std::string measured_key_;  // what `measured_` was read from: it need not be again when a station has moved
  TargetMeasurements measured_;
  std::unique_ptr<Task<void>> task_;  // last: it writes what is above
};

// The files of the stations' last scans, each once.
std::vector<std::filesystem::path> lastScanFiles(const Job& job);

}  // namespace standpoint
