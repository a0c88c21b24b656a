// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/points.h"
#include "core/progress.h"
#include "core/result.h"
#include "editor/points/cloud_colours.h"
#include "pointclouds/octree/cloud_point.h"
#include "project/task.h"

namespace standpoint {

// A point cloud as it is shown over the model: an even sample of the file's points, in the local frame.
struct Cloud {
  std::filesystem::path file;
  CloudHeader header;
  std::vector<CloudPoint> points;  // relative to header.origin_m
  CloudColouring colouring;
  std::vector<PointColour> colours;  // of the points, by colourOf() and `colouring`
  std::uint64_t points_in_file = 0;
};

constexpr std::uint64_t kMostShownPoints = 600000;  // what software rendering still turns smoothly

// Keeps every k-th point of the scans that are written to it; k doubles whenever more than `most` would be kept.
class CloudSampler : public PointSink {
 public:
  CloudSampler(std::uint64_t step, std::uint64_t most, const Eigen::Vector3d& shift_m)
      : step_(step), most_(most), maker_(shift_m) {}
  Result<void> begin(const ScanHeader& header) override;
  Result<void> write(const PointBlock& block) override;
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }

  Cloud coloured() const;                       // what there is so far
  std::uint64_t seen() const { return seen_; }  // points, kept or not
  bool empty() const { return points_.empty(); }

 private:
  void halve();
  std::uint64_t step_, most_, seen_ = 0;
  CloudPointMaker maker_;
  std::vector<CloudPoint> points_;
};

// Every k-th point, so that at most `most` are kept; memory does not grow with the file.
Result<Cloud> sampleCloud(const std::filesystem::path& file, const Eigen::Vector3d& shift_m, std::uint64_t most,
                          Progress& progress);

// Reads a cloud in the background.
class CloudLoader {
 public:
  void start(const std::filesystem::path& file, const Eigen::Vector3d& shift_m, std::function<void()> wake);
  bool busy() const { return task_ && !task_->done(); }
  Progress* progress() { return busy() ? &task_->progress() : nullptr; }
  double seconds() const { return busy() ? task_->seconds() : 0; }
  // What the last start brought; once.
  std::optional<Result<Cloud>> take();

 private:
  std::unique_ptr<Task<Cloud>> task_;
};

}  // namespace standpoint
