// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/points.h"
#include "core/progress.h"
#include "core/result.h"
#include "core/survey.h"
#include "pointclouds/statistics/distribution.h"

namespace standpoint {

// Places of a cloud, drawn evenly by a hash of their number, in bounded memory.
class PlaceSampler final : public PointSink {
 public:
  // `origin_m` of the places, frame of the file: floats are fine near it.
  explicit PlaceSampler(const Eigen::Vector3d& origin_m, std::size_t most = 2'000'000)
      : origin_m_(origin_m), most_(most) {}
  Result<void> begin(const ScanHeader& header) override;
  Result<void> write(const PointBlock& block) override;
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }

  const Eigen::Vector3d& origin_m() const { return origin_m_; }
  const std::vector<Eigen::Vector3f>& places_m() const { return places_m_; }
  std::vector<Eigen::Vector3f> part(std::size_t most) const;  // an even one of them

 private:
  Eigen::Vector3d origin_m_;
  std::size_t most_;
  std::uint64_t points_ = 0, limit_ = std::numeric_limits<std::uint64_t>::max();
  Pose pose_;
  std::vector<Eigen::Vector3f> places_m_;
  std::vector<std::uint64_t> hashes_;
};

struct LargestDifference {
  Eigen::Vector3d at_m = Eigen::Vector3d::Zero();  // frame of the cloud's file
  double distance_m = 0;                           // mean of the points there
  std::uint64_t points = 0;
};

// How far an even part of a cloud is from another cloud: from the plane through the points of the other one nearby,
// so that neither spacing nor noise of the other adds to it; where these are no plane, or it ends before, from the
// nearest point.
struct CloudDistances {
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();  // of place_m, frame of the cloud's file
  std::vector<Eigen::Vector3f> place_m;
  std::vector<float> distance_m;  // of each
  Distribution distribution_m;
  // The cubic metre with the largest sum of distances, of which each counts a metre at most: beyond, there is nothing
  // of the other cloud.
  std::optional<LargestDifference> largest;
};
// Empty where either cloud is. Errors: cancelled.
Result<CloudDistances> distancesBetween(const PlaceSampler& from, const PlaceSampler& to, Progress& progress);

}  // namespace standpoint
