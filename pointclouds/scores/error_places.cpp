// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/scores/error_places.h"

#include <algorithm>
#include <cmath>

#include "pointclouds/formats.h"

namespace standpoint {

namespace {

class PlaceSink final : public PointSink {
 public:
  explicit PlaceSink(const TakePlace& take) : take_(take) {}

  Result<void> begin(const ScanHeader& header) override {
    header_ = header;
    return {};
  }
  Result<void> write(const PointBlock& block) override {
    for (std::size_t i = 0; i < block.size(); ++i, ++points) {
      const Eigen::Vector3d at = header_.file_from_scanner * Eigen::Vector3d(block.x_m[i], block.y_m[i], block.z_m[i]);
      if (at.allFinite()) take_(header_, at, points);
    }
    return {};
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }

  std::uint64_t points = 0;

 private:
  const TakePlace& take_;
  ScanHeader header_;
};

}  // namespace

Result<std::uint64_t> forEachPlace(const std::filesystem::path& cloud, const TakePlace& take, Progress& progress) {
  PlaceSink sink(take);
  TRY(readCloud(cloud, sink, progress));
  return sink.points;
}

void AxisSpread::add(double at) {
  if (counts_.empty()) {
    counts_.assign(kBins, 0);
    first_ = std::floor(at / width_) - kBins / 2.0;
  }
  const auto place = [&] { return std::floor(at / width_) - first_; };
  while (!(place() >= 0 && place() < kBins)) {
    const double first = std::floor(first_ / 2);
    const auto odd = static_cast<std::size_t>(first_ - 2 * first);
    std::vector<std::uint64_t> wider(kBins, 0);
    for (std::size_t k = 0; k < kBins; ++k) wider[kBins / 4 + (k + odd) / 2] += counts_[k];
    counts_ = std::move(wider);
    first_ = first - kBins / 4.0;
    width_ *= 2;
  }
  ++counts_[static_cast<std::size_t>(place())];
  ++points_;
}

std::pair<double, double> AxisSpread::range(double left_out) const {
  if (points_ == 0) return {0, 0};
  const auto most = static_cast<std::uint64_t>(left_out * static_cast<double>(points_));
  std::size_t low = 0, high = kBins - 1;
  for (std::uint64_t passed = counts_[low]; passed <= most; passed += counts_[low]) ++low;
  for (std::uint64_t passed = counts_[high]; passed <= most; passed += counts_[high]) --high;
  return {(first_ + static_cast<double>(low)) * width_, (first_ + static_cast<double>(high) + 1) * width_};
}

void PointSpread::add(const Eigen::Vector3d& at) {
  for (std::size_t k = 0; k < axes_.size(); ++k) axes_[k].add(at[static_cast<Eigen::Index>(k)]);
  bounds_.extend(at);
  ++points_;
}

Bounds PointSpread::without(double left_out) const {
  Bounds box;
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    const auto [low, high] = axes_[k].range(left_out);
    box.min[axis] = std::max(low, bounds_.min[axis]);
    box.max[axis] = std::min(high, bounds_.max[axis]);
  }
  return box;
}

void DensestPlace::add(const Eigen::Vector3d& at) {
  if (!origin_) origin_ = at.array().round().matrix();
  const Eigen::Vector3d off = at - *origin_;
  const auto cubeOf = [](const Eigen::Vector3d& p, double edge) {
    constexpr double kFarthest = 1e15;  // whole numbers that a double holds
    Cube cube{};
    for (std::size_t k = 0; k < cube.size(); ++k)
      cube[k] = static_cast<std::int64_t>(
          std::clamp(std::floor(p[static_cast<Eigen::Index>(k)] / edge), -kFarthest, kFarthest));
    return cube;
  };
  auto& content = cubes_[cubeOf(off, edge_m_)];
  ++content.points;
  content.sum += off;
  while (cubes_.size() > kMost) {
    std::map<Cube, Content> wider;
    for (const auto& [cube, what] : cubes_) {
      auto& to = wider[{cube[0] >> 1, cube[1] >> 1, cube[2] >> 1}];
      to.points += what.points;
      to.sum += what.sum;
    }
    cubes_ = std::move(wider);
    edge_m_ *= 2;
  }
}

std::optional<DensestPlace::Place> DensestPlace::place() const {
  if (cubes_.empty()) return std::nullopt;
  Content best;
  for (const auto& [cube, own] : cubes_) {
    Content around;
    for (int k = 0; k < 27; ++k) {
      const auto next = cubes_.find({cube[0] + k / 9 - 1, cube[1] + k / 3 % 3 - 1, cube[2] + k % 3 - 1});
      if (next == cubes_.end()) continue;
      around.points += next->second.points;
      around.sum += next->second.sum;
    }
    if (around.points > best.points) best = around;
  }
  return Place{*origin_ + best.sum / static_cast<double>(best.points), 3 * edge_m_, best.points};
}

}  // namespace standpoint
