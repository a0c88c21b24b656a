// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/statistics/scan_points.h"

#include <algorithm>
#include <numeric>

#include <nanoflann.hpp>

namespace standpoint {
namespace {

template <class T>
void arrange(std::vector<T>& values, const std::vector<std::size_t>& order) {
  std::vector<T> arranged;
  arranged.reserve(values.size());
  for (const std::size_t i : order) arranged.push_back(values[i]);
  values = std::move(arranged);
}

}  // namespace

void ScanPoints::clear() {
  place_m.clear();
  number.clear();
  cell.clear();
}

void ScanPoints::append(const PointBlock& block, std::size_t i, std::uint64_t point, bool grid) {
  place_m.emplace_back(block.x_m[i], block.y_m[i], block.z_m[i]);
  number.push_back(point);
  if (grid) cell.push_back(static_cast<std::uint64_t>(block.column[i]) << 32U | block.row[i]);
}

GridIndex::GridIndex(ScanPoints& points) : points_(points) {
  if (!std::is_sorted(points.cell.begin(), points.cell.end())) {
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return points.cell[a] < points.cell[b]; });
    arrange(points.place_m, order), arrange(points.number, order), arrange(points.cell, order);
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    if (i == 0 || points.cell[i] >> 32U != points.cell[i - 1] >> 32U)
      columns_.push_back(points.cell[i] >> 32U), begins_.push_back(i);
  begins_.push_back(points.size());
}

std::optional<std::size_t> GridIndex::at(std::int64_t column, std::int64_t row) const {
  if (column < 0 || row < 0) return std::nullopt;
  const auto wanted = static_cast<std::uint64_t>(column);
  const auto found = std::lower_bound(columns_.begin(), columns_.end(), wanted);
  if (found == columns_.end() || *found != wanted) return std::nullopt;
  const auto slot = static_cast<std::size_t>(found - columns_.begin());
  const std::uint64_t cell = wanted << 32U | static_cast<std::uint64_t>(row);
  const auto begin = points_.cell.begin() + static_cast<std::ptrdiff_t>(begins_[slot]);
  const auto end = points_.cell.begin() + static_cast<std::ptrdiff_t>(begins_[slot + 1]);
  const auto at = std::lower_bound(begin, end, cell);
  if (at == end || *at != cell) return std::nullopt;
  return static_cast<std::size_t>(at - points_.cell.begin());
}

struct NearestPoints::Tree {
  // What nanoflann wants to know of the points.
  struct Cloud {
    const std::vector<Eigen::Vector3f>& places;
    std::size_t kdtree_get_point_count() const { return places.size(); }
    float kdtree_get_pt(std::size_t i, std::size_t axis) const { return places[i][static_cast<Eigen::Index>(axis)]; }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
      return false;
    }
  };
  using KdTree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Cloud>, Cloud, 3, std::size_t>;

  Cloud cloud;
  KdTree index;
  explicit Tree(const ScanPoints& points)
      : cloud{points.place_m}, index(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(16)) {}
};

NearestPoints::NearestPoints(const ScanPoints& points, std::size_t count)
    : points_(points), count_(points.size() == 0 ? 0 : std::min(count, points.size() - 1)) {
  if (count_ > 0) tree_ = std::make_unique<Tree>(points);
}

NearestPoints::~NearestPoints() = default;

void NearestPoints::of(std::size_t point, std::vector<std::size_t>& neighbours, std::vector<float>& squared_m) const {
  neighbours.resize(count_ + 1);
  squared_m.resize(count_ + 1);
  const std::size_t found =
      tree_->index.knnSearch(points_.place_m[point].data(), count_ + 1, neighbours.data(), squared_m.data());
  // The point itself is among them, unless more than `count` others lie in the very same place.
  const auto end = neighbours.begin() + static_cast<std::ptrdiff_t>(found);
  const auto self = std::min(std::find(neighbours.begin(), end, point), end - 1);
  squared_m.erase(squared_m.begin() + (self - neighbours.begin()));
  neighbours.erase(self);
}

}  // namespace standpoint
