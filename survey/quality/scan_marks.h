// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/points.h"
#include "pointclouds/statistics/neighbourhoods.h"
#include "scanners/forecast/surface_samples.h"

namespace standpoint {

// The samples of a scene's surface in cells, for the question on which of them a point lies: within `radius_m` of its
// place and half of that off its plane. Local frame.
class SampleCells {
 public:
  SampleCells(const RayScene& scene, const SurfaceSamples& samples, double radius_m);
  // Adds 1 to the count of each sample that the point lies on. Of a board thinner than the radius only the side counts
  // that looks to where the point was measured from. Thread-safe, also for the same counts.
  void mark(const Eigen::Vector3d& point, const Eigen::Vector3d& origin, std::span<std::uint32_t> counts) const;
  // Appends the same samples.
  void samplesAt(const Eigen::Vector3d& point, const Eigen::Vector3d& origin, std::vector<std::uint32_t>& found) const;

 private:
  void each(const Eigen::Vector3d& point, const Eigen::Vector3d& origin, const auto& visit) const;
  struct Entry {
    std::uint64_t cell;
    std::uint32_t sample;
  };
  const SurfaceSamples& samples_;
  double radius_m_;
  std::vector<std::uint8_t> thin_;     // of each sample
  std::vector<Entry> entries_;         // by bucket
  std::vector<std::uint32_t> begins_;  // of each bucket, and the end of the last
  std::uint64_t mask_ = 0;
};

// Points drawn evenly from a stream by a hash of their number, at most so many; the same stream gives the same ones.
class EvenDraw {
 public:
  explicit EvenDraw(std::size_t most) : most_(most) {}
  void offer(const Eigen::Vector3d& point);
  const std::vector<Eigen::Vector3d>& points() const { return points_; }

 private:
  std::size_t most_;
  std::uint64_t number_ = 0, limit_ = std::numeric_limits<std::uint64_t>::max();
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::uint64_t> hashes_;
};

// What the points of one scan leave, in memory that does not grow with them.
struct ScanMarks {
  ScanMarks(std::size_t samples, std::size_t most_drawn) : counts(samples), drawn(most_drawn) {}
  std::uint64_t points = 0;
  std::vector<std::uint32_t> counts;  // of points, by sample
  EvenDraw drawn;
  std::vector<Neighbourhood> patches;      // that are waiting for their points …
  std::vector<std::size_t> patch_samples;  // … each about one of the samples
};

// Hands the points of one scan, placed in the local frame, to its marks. Not to be begun twice.
class MarkingSink final : public PointSink {
 public:
  MarkingSink(const SampleCells& cells, const Pose& placed, const Eigen::Vector3d& origin, double patch_m,
              ScanMarks& marks);
  Result<void> begin(const ScanHeader& header) override;
  Result<void> write(const PointBlock& block) override;
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }

 private:
  const SampleCells& cells_;
  Pose placed_;
  Eigen::Vector3d origin_;
  ScanMarks& marks_;
  NeighbourSink patches_;
  std::vector<Eigen::Vector3d> points_;  // of a block
};

}  // namespace standpoint
