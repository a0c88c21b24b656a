// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/points.h"
#include "core/progress.h"
#include "core/result.h"
#include "editor/points/cloud_colours.h"
#include "pointclouds/octree/cloud_point.h"
#include "pointclouds/octree/octree_file.h"

namespace standpoint {

// A point cloud as it is shown over the model: all points of the file, by way of an octree, or an even sample of them.
struct Cloud {
  std::filesystem::path file;
  CloudHeader header;
  Eigen::Vector3d shift_m = Eigen::Vector3d::Zero();  // from the file's frame to the local one, for what is not moved
  std::vector<CloudPoint> points;                     // relative to header.origin_m; of an octree, its coarsest ones
  CloudColouring colouring;
  std::vector<PointColour> colours;  // of the points, by colourOf() and `colouring`
  std::uint64_t points_in_file = 0;
  std::shared_ptr<const OctreeFile> octree;  // where all points are; null: they are `points`
  // By which each of header.stations, and its points, is moved from where the files have it: local frame to local
  // frame. Empty: none is. Points that come from the octree are moved when they are read.
  std::vector<Pose> moves;
  std::vector<std::filesystem::path> files;  // of header.stations, where there are several; `file` is empty then

  // Where the places of `points` are counted from, local frame: not its origin where an octree was made in another one.
  Eigen::Vector3d pointsOrigin_m() const { return header.origin_m - shift_m; }
};

// The cloud with each station where `moves` takes it, one for each of header.stations; `cloud` is not moved yet.
Cloud moved(const Cloud& cloud, std::vector<Pose> moves);
// Moves points relative to `origin_m`, local frame, each as its station.
void move(std::span<CloudPoint> points, const Eigen::Vector3d& origin_m, std::span<const Pose> moves);

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
  std::size_t scans() const { return maker_.header().stations.size(); }
  bool empty() const { return points_.empty(); }

 private:
  void halve();
  std::uint64_t step_, most_, seen_ = 0;
  CloudPointMaker maker_;
  std::vector<CloudPoint> points_;
};

// In all of them.
Result<std::uint64_t> pointsIn(std::span<const std::filesystem::path> files);
// Every k-th of the `points` of the files, so that at most `most` are kept; memory does not grow with the file. Of
// several files, one after the other.
Result<Cloud> sampleCloud(std::span<const std::filesystem::path> files, std::uint64_t points,
                          const Eigen::Vector3d& shift_m, std::uint64_t most, Progress& progress);

}  // namespace standpoint
