// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "core/survey.h"
#include "pointclouds/inspection/wall_fit.h"
#include "project/latest_task.h"

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
  explicit WallView(std::function<void()> wake) : latest_("Measure a wall", std::move(wake)) {}
  void start(WallRequest request);
  bool busy() const { return latest_.busy() && latest_.wanted(); }
  void wait() { latest_.wait(); }
  void poll() { latest_.poll(); }  // once a frame
  // Of the last start; null until it is done, and where there is none, or see problem().
  std::shared_ptr<const WallResult> result() const;
  std::string problem() const;
  void clear() { latest_.drop(); }

 private:
  std::uint64_t started_ = 0;
  LatestTask<std::uint64_t, std::shared_ptr<const WallResult>> latest_;  // by the number of its start
};

}  // namespace standpoint
