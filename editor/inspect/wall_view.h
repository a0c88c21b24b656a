// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "core/survey.h"
#include "pointclouds/inspection/wall_fit.h"
#include "project/task.h"

namespace standpoint {

// Which wall is measured in which cloud.
struct WallRequest {
  std::string cloud;  // its label
  std::filesystem::path file;
  Pose local_from_cloud;
  Ball ball;            // frame of the cloud's file
  WallOptions options;  // likewise
};

struct WallResult {
  WallRequest request;
  std::uint64_t inside = 0;  // points in the ball, of which fit.points were used
  WallFit fit;               // frame of the cloud's file
};

// The four corners of the fitted patch, in the local frame.
std::array<Eigen::Vector3d, 4> cornersOf(const WallResult& wall);
// Figures, a line each, to be pasted.
std::string wallText(const WallResult& wall);
// In a sentence, to be kept with a measurement.
std::string wallNote(const WallResult& wall);

// Measures in the background; a newer request ends an older one.
class WallView {
 public:
  void start(WallRequest request, const std::function<void()>& wake);
  bool busy() const { return task_ && !task_->done(); }
  Progress* progress() { return busy() ? &task_->progress() : nullptr; }
  double seconds() const { return busy() ? task_->seconds() : 0; }
  void wait() {
    if (task_) task_->wait();
  }
  void poll();  // once a frame
  // Of the last start that is done; null: none, or see problem().
  const std::shared_ptr<const WallResult>& result() const { return result_; }
  const std::string& problem() const { return problem_; }
  void clear();

 private:
  std::unique_ptr<Task<WallResult>> task_;
  std::shared_ptr<const WallResult> result_;
  std::string problem_;
};

}  // namespace standpoint
