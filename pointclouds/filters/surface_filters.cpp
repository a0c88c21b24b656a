// SPDX-License-Identifier: GPL-3.0-or-later
// Filters that judge a point by those around it. They hold the points of one scan at a time.
#include <cmath>
#include <numbers>
#include <optional>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/decompositions.h"
#include "pointclouds/filters/filters.h"
#include "pointclouds/statistics/cloud_sample.h"
#include "pointclouds/statistics/scan_points.h"

namespace standpoint {
namespace {

// Gathers a scan, and takes the points that `wrong` marks.
class ScanFilter : public PointFilter {
 public:
  Result<void> beginScan(const ScanHeader& header) override {
    grid_ = header.rows > 0 && header.columns > 0;
    has_station_ = stationOf(header).has_value();
    points_.clear();
    return {};
  }
  Result<void> see(const PointBlock& block, std::uint64_t first, Remaining& remaining) override {
    for (std::size_t i = 0; i < block.size(); ++i)
      if (remaining.has(first + i)) points_.append(block, i, first + i, grid_);
    return {};
  }
  Result<void> endScan(Remaining& remaining) override {
    const std::vector<std::uint8_t> marks = wrong(points_);
    for (std::size_t i = 0; i < marks.size(); ++i)
      if (marks[i] != 0) remaining.take(points_.number[i]);
    points_.clear();
    return {};
  }

 protected:
  virtual std::vector<std::uint8_t> wrong(ScanPoints& points) const = 0;  // an entry for each point
  bool grid_ = false, has_station_ = false;

 private:
  ScanPoints points_;
};

template <class Judge>
void forEachPoint(std::size_t count, Judge judge) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 4096), [&](const auto& part) {
    for (std::size_t i = part.begin(); i < part.end(); ++i) judge(i);
  });
}

// Statistical outliers after Rusu et al. 2008 (Towards 3D point cloud based object maps), but of the mean distance to
// the neighbours as a share of the range: a scanner's points lie the farther apart the farther off they are.
class OutlierFilter final : public ScanFilter {
 public:
  OutlierFilter(std::size_t neighbours, double sigmas) : neighbours_(neighbours), sigmas_(sigmas) {}

 private:
  std::vector<std::uint8_t> wrong(ScanPoints& points) const override {
    const NearestPoints nearest(points, neighbours_);
    std::vector<std::uint8_t> marks(points.size(), 0);
    if (nearest.count() < neighbours_) return marks;  // too few to say what is usual
    std::vector<double> spacing(points.size());       // logarithm; points in one place have the smallest there is
    forEachPoint(points.size(), [&](std::size_t i) {
      thread_local std::vector<std::size_t> around;
      thread_local std::vector<float> squared_m;
      nearest.of(i, around, squared_m);
      double sum = 0;
      for (const float s : squared_m) sum += std::sqrt(static_cast<double>(s));
      const double range_m = has_station_ ? std::max(0.01, static_cast<double>(points.place_m[i].norm())) : 1;
      spacing[i] = std::log(std::max(1e-6, sum / static_cast<double>(squared_m.size())) / range_m);
    });
    double mean = 0, squares = 0;
    for (const double s : spacing) mean += s / static_cast<double>(spacing.size());
    for (const double s : spacing) squares += (s - mean) * (s - mean);
    const double most = mean + sigmas_ * std::sqrt(squares / static_cast<double>(spacing.size()));
    for (std::size_t i = 0; i < marks.size(); ++i) marks[i] = spacing[i] > most ? 1 : 0;
    return marks;
  }

  std::size_t neighbours_;
  double sigmas_;
};

// What a beam that met two surfaces leaves between them. In a grid: a nearer point to one side and a farther to the
// other, each so far off in range that the line to it lies within `angle` of the beam. So does a surface that is seen
// very flatly; but it goes on in a straight line to both sides.
class MixedFilter final : public ScanFilter {
 public:
  explicit MixedFilter(const MixedOptions& options)
      : sine_(std::sin(options.angle_deg * std::numbers::pi / 180)),
        cosine_(std::cos(options.angle_deg * std::numbers::pi / 180)),
        jump_m_(options.jump_m),
        neighbours_(options.neighbours),
        by_(options.by) {}

  Result<void> beginScan(const ScanHeader& header) override {
    if (auto begun = ScanFilter::beginScan(header); !begun) return begun;
    if (!has_station_) return failure(ErrorKind::unusable, "no scanner position: beams are unknown", header.name);
    if (by_ == NeighbourSearch::grid && !grid_)
      return failure(ErrorKind::unusable, "no grid of rows and columns; leave out 'by', or use by=distance",
                     header.name);
    return {};
  }

 private:
  static constexpr int kReach = 2;  // cells: a beam wider than the grid's step leaves two mixed points side by side

  std::vector<std::uint8_t> wrong(ScanPoints& points) const override {
    return grid_ && by_ != NeighbourSearch::distance ? byGrid(points) : byDistance(points);
  }

  std::vector<std::uint8_t> byGrid(ScanPoints& points) const {
    const GridIndex grid(points);
    std::vector<std::uint8_t> marks(points.size(), 0);
    forEachPoint(points.size(), [&](std::size_t i) {
      static constexpr int kDirections[4][2] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}};
      for (const auto& d : kDirections)
        if (between(points, grid, i, d[0], d[1])) marks[i] = 1;
    });
    return marks;
  }

  struct Line {
    std::optional<Eigen::Vector3f> at[2 * kReach + 1];  // the point itself in the middle
  };

  bool between(const ScanPoints& points, const GridIndex& grid, std::size_t i, int columns, int rows) const {
    const auto column = static_cast<std::int64_t>(points.cell[i] >> 32U);
    const auto row = static_cast<std::int64_t>(points.cell[i] & 0xFFFFFFFFU);
    Line line;
    line.at[kReach] = points.place_m[i];
    for (int k = -kReach; k <= kReach; ++k)
      if (const auto found = k == 0 ? std::nullopt : grid.at(column + k * columns, row + k * rows))
        line.at[kReach + k] = points.place_m[*found];
    const bool up = jumps(line, -1, -1) && jumps(line, 1, 1), down = jumps(line, -1, 1) && jumps(line, 1, -1);
    if (!up && !down) return false;
    const auto before = goesOn(line, -1), after = goesOn(line, 1);
    return !(before || after) || !before.value_or(true) || !after.value_or(true);
  }

  // Whether a point to that side is farther (`sign` 1) or nearer (-1) along the beam.
  bool jumps(const Line& line, int side, int sign) const {
    const Eigen::Vector3f& point = *line.at[kReach];
    const float range_m = point.norm();
    for (int k = 1; k <= kReach; ++k) {
      const auto& other = line.at[kReach + side * k];
      if (!other) continue;
      const Eigen::Vector3f to = *other - point;
      const double along = sign * static_cast<double>(to.dot(point)) / range_m;
      if (along > jump_m_ && along > cosine_ * to.norm()) return true;
    }
    return false;
  }

  // Whether the next but one point to that side lies where a straight line through the next one leads: of a straight
  // line the inverse range changes by equal steps from beam to beam. Nothing where a point is missing, as at the scan's
  // border.
  static std::optional<bool> goesOn(const Line& line, int side) {
    const auto &next = line.at[kReach + side], &second = line.at[kReach + 2 * side];
    if (!next || !second) return std::nullopt;
    const float here_m = line.at[kReach]->norm(), next_m = next->norm(), second_m = second->norm();
    const float inverse = 2 / next_m - 1 / here_m;
    return inverse > 0 && std::abs(1 / inverse - second_m) < 0.25F * std::abs(next_m - here_m);
  }

  // Without a grid: the plane of the neighbours lies along the beam, or they are a line along it.
  std::vector<std::uint8_t> byDistance(const ScanPoints& points) const {
    const NearestPoints nearest(points, neighbours_);
    std::vector<std::uint8_t> marks(points.size(), 0);
    if (nearest.count() < 6) return marks;
    forEachPoint(points.size(), [&](std::size_t i) { marks[i] = alongBeam(points, nearest, i) ? 1 : 0; });
    return marks;
  }

  bool alongBeam(const ScanPoints& points, const NearestPoints& nearest, std::size_t i) const {
    thread_local std::vector<std::size_t> around;
    thread_local std::vector<float> squared_m;
    nearest.of(i, around, squared_m);
    const Eigen::Vector3d beam = points.place_m[i].cast<double>().normalized();
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const std::size_t k : around) mean += (points.place_m[k] - points.place_m[i]).cast<double>();
    mean /= static_cast<double>(around.size());
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    double nearest_m = 0, farthest_m = 0;
    for (const std::size_t k : around) {
      const Eigen::Vector3d to = (points.place_m[k] - points.place_m[i]).cast<double>();
      moments += (to - mean) * (to - mean).transpose();
      nearest_m = std::min(nearest_m, beam.dot(to));
      farthest_m = std::max(farthest_m, beam.dot(to));
    }
    if (-nearest_m < jump_m_ || farthest_m < jump_m_) return false;
    return std::abs(principalAxes(moments).axes.col(0).dot(beam)) < sine_;
  }

  double sine_, cosine_, jump_m_;
  std::size_t neighbours_;
  std::optional<NeighbourSearch> by_;
};

// A point that too few of those around it in the grid are as far as. Other than MixedFilter it needs no second surface,
// takes what stands alone, and takes thin things as well.
class StrayFilter final : public ScanFilter {
 public:
  explicit StrayFilter(const StrayOptions& options) : options_(options) {}

  Result<void> beginScan(const ScanHeader& header) override {
    if (auto begun = ScanFilter::beginScan(header); !begun) return begun;
    if (!has_station_) return failure(ErrorKind::unusable, "no scanner position: ranges are unknown", header.name);
    if (!grid_)
      return failure(ErrorKind::unusable, "no grid of rows and columns; use 'outliers' for such a cloud", header.name);
    return {};
  }

 private:
  std::vector<std::uint8_t> wrong(ScanPoints& points) const override {
    const GridIndex grid(points);
    std::vector<float> range_m(points.size());
    forEachPoint(points.size(), [&](std::size_t i) { range_m[i] = points.place_m[i].norm(); });
    std::vector<std::uint8_t> marks(points.size(), 0);
    forEachPoint(points.size(), [&](std::size_t i) { marks[i] = strays(points, grid, range_m, i) ? 1 : 0; });
    return marks;
  }

  bool strays(const ScanPoints& points, const GridIndex& grid, const std::vector<float>& range_m, std::size_t i) const {
    const auto column = static_cast<std::int64_t>(points.cell[i] >> 32U);
    const auto row = static_cast<std::int64_t>(points.cell[i] & 0xFFFFFFFFU);
    const auto reach = static_cast<std::int64_t>(options_.window / 2);
    std::size_t around = 0, alike = 0;
    for (std::int64_t c = column - reach; c <= column + reach; ++c)
      for (std::int64_t r = row - reach; r <= row + reach; ++r) {
        const auto found = c == column && r == row ? std::nullopt : grid.at(c, r);
        if (!found) continue;
        ++around;
        if (std::abs(range_m[*found] - range_m[i]) <= static_cast<float>(options_.distance_m)) ++alike;
      }
    return static_cast<double>(alike) < options_.share * static_cast<double>(std::max<std::size_t>(around, 1));
  }

  StrayOptions options_;
};

}  // namespace

MadeFilter makeStrayFilter(const StrayOptions& options) {
  if (options.window % 2 == 0) return failure(ErrorKind::usage, "'window' must be odd");
  return std::make_unique<StrayFilter>(options);
}

MadeFilter makeOutlierFilter(const OutlierOptions& options) {
  return std::make_unique<OutlierFilter>(options.neighbours, options.sigmas);
}

MadeFilter makeMixedFilter(const MixedOptions& options) { return std::make_unique<MixedFilter>(options); }

}  // namespace standpoint
