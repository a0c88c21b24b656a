// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "editor/clouds/cropped_cloud.h"
#include "editor/clouds/underlay_view.h"
#include "project/task.h"

namespace standpoint {

// What scans have measured around a place, read in the background and drawn over the model.
struct PlaceRequest {
  std::vector<PosedScan> scans;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // local frame
  double radius_m = 1;
  Eigen::Vector3d shift_m = Eigen::Vector3d::Zero();
};

class PlacePoints {
 public:
  void start(PlaceRequest request, const std::function<void()>& wake);
  void poll();  // once a frame; where a scan cannot be read, there are no points
  void drop();
  const std::optional<ShownUnderlay>& shown() const { return shown_; }
  bool busy() const { return task_ && !task_->done(); }
  void wait() {
    if (task_) task_->wait();
  }

 private:
  std::unique_ptr<Task<Cloud>> task_;
  std::optional<ShownUnderlay> shown_;
};

}  // namespace standpoint
