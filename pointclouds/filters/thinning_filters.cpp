// SPDX-License-Identifier: GPL-3.0-or-later
// Filters by which points near each other become one, in all scans of a file together. Their memory grows with what
// they leave, not with what they see.
#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "pointclouds/filters/filters.h"
#include "pointclouds/statistics/cloud_sample.h"
#include "pointclouds/statistics/coverage.h"

namespace standpoint {
namespace {

class VoxelFilter final : public PointFilter {
 public:
  explicit VoxelFilter(double cell_m) : cell_m_(cell_m) {}
  Result<void> beginScan(const ScanHeader& header) override { return pose_ = header.file_from_scanner, Result<void>{}; }
  Result<void> see(const PointBlock& b, std::uint64_t first, Remaining& remaining) override {
    for (std::size_t i = 0; i < b.size(); ++i) {
      if (!remaining.has(first + i)) continue;
      const Eigen::Vector3d place = pose_ * Eigen::Vector3d(b.x_m[i], b.y_m[i], b.z_m[i]);
      const Cell cell = cellAt(place, cell_m_);
      const double off_m = (place - (cell.cast<double>().array() + 0.5).matrix() * cell_m_).norm();
      const auto [at, fresh] = nearest_.try_emplace(hashOf(cell), Nearest{off_m, first + i});
      if (fresh) continue;
      const bool better = off_m < at->second.off_m;
      remaining.take(better ? at->second.point : first + i);
      if (better) at->second = {off_m, first + i};
    }
    return {};
  }

 private:
  struct Nearest {
    double off_m;
    std::uint64_t point;
  };
  double cell_m_;
  Pose pose_;
  std::unordered_map<std::uint64_t, Nearest> nearest_;  // by the cell's hash; never walked through
};

// Points that are at least a distance apart, in a hash of cells four times as wide: a point then mostly looks into one
// to four of them, and no more than a dozen points or so of a surface are in each.
class Apart {
 public:
  explicit Apart(double distance_m) : distance_m_(distance_m) {}
  // False when one is nearer already.
  bool add(const Eigen::Vector3d& place) {
    const Cell low = cellAt(place.array() - distance_m_, kWidth * distance_m_);
    const Cell high = cellAt(place.array() + distance_m_, kWidth * distance_m_);
    for (std::int64_t x = low.x(); x <= high.x(); ++x)
      for (std::int64_t y = low.y(); y <= high.y(); ++y)
        for (std::int64_t z = low.z(); z <= high.z(); ++z)
          if (isNearOneOf(Cell(x, y, z), place)) return false;
    const auto [at, fresh] = first_.try_emplace(hashOf(cellAt(place, kWidth * distance_m_)), kNone);
    kept_.push_back({place, at->second});
    at->second = kept_.size() - 1;
    return true;
  }

 private:
  static constexpr std::uint64_t kNone = ~std::uint64_t{0};
  static constexpr double kWidth = 4;
  bool isNearOneOf(const Cell& cell, const Eigen::Vector3d& place) const {
    const auto found = first_.find(hashOf(cell));
    for (std::uint64_t i = found == first_.end() ? kNone : found->second; i != kNone; i = kept_[i].next)
      if ((kept_[i].place - place).squaredNorm() < distance_m_ * distance_m_) return true;
    return false;
  }
  struct Kept {
    Eigen::Vector3d place;
    std::uint64_t next;  // in the same cell
  };
  double distance_m_;
  std::vector<Kept> kept_;
  std::unordered_map<std::uint64_t, std::uint64_t> first_;
};

// Greedy by range: the nearest point to its scanner stays, then the next one that is not too near to one that stays. To
// go by range without holding the whole file the first pass counts ranges, and each later one takes a shell of them.
class DuplicateFilter final : public PointFilter {
 public:
  explicit DuplicateFilter(double distance_m) : apart_(distance_m), counts_(kBins) {}
  Result<void> beginScan(const ScanHeader& header) override {
    pose_ = header.file_from_scanner;
    has_range_ = stationOf(header).has_value();
    return {};
  }
  Result<void> see(const PointBlock& b, std::uint64_t first, Remaining& remaining) override {
    for (std::size_t i = 0; i < b.size(); ++i) {
      if (!remaining.has(first + i)) continue;
      const Eigen::Vector3f p(b.x_m[i], b.y_m[i], b.z_m[i]);
      const float range_m = has_range_ ? p.norm() : 0;  // then the order in the file decides
      const std::size_t bin = std::bit_cast<std::uint32_t>(range_m) >> kShift;
      if (counting_)
        ++counts_[bin];
      else if (bin >= from_ && bin < to_)
        shell_.push_back({range_m, first + i, pose_ * p.cast<double>()});
    }
    return {};
  }
  Result<bool> endPass(Remaining& remaining) override {
    counting_ = false;
    std::sort(shell_.begin(), shell_.end(),
              [](const Seen& a, const Seen& b) { return std::tie(a.range_m, a.point) < std::tie(b.range_m, b.point); });
    for (const Seen& seen : shell_)
      if (!apart_.add(seen.place)) remaining.take(seen.point);
    shell_.clear();
    from_ = to_;
    for (std::uint64_t points = 0; to_ < kBins && (points == 0 || points + counts_[to_] <= kMostInShell); ++to_)
      points += counts_[to_];
    return std::any_of(counts_.begin() + static_cast<std::ptrdiff_t>(from_), counts_.end(),
                       [](auto n) { return n > 0; });
  }

 private:
  static constexpr unsigned kShift = 11;  // bits of a float's mantissa that a bin does not tell
  static constexpr std::size_t kBins = std::size_t{1} << (31 - kShift);  // each 1/4096 of a range wide
  static constexpr std::uint64_t kMostInShell = 8'000'000;
  struct Seen {
    float range_m;
    std::uint64_t point;
    Eigen::Vector3d place;
  };
  Apart apart_;
  Pose pose_;
  bool has_range_ = true, counting_ = true;
  std::vector<std::uint64_t> counts_;
  std::size_t from_ = 0, to_ = 0;
  std::vector<Seen> shell_;
};

}  // namespace

MadeFilter makeVoxelFilter(const VoxelOptions& options) { return std::make_unique<VoxelFilter>(options.cell_m); }

MadeFilter makeDuplicateFilter(const DuplicateOptions& options) {
  return std::make_unique<DuplicateFilter>(options.distance_m);
}

}  // namespace standpoint
