// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/surface/partition.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include <tbb/parallel_invoke.h>

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr auto kNoPartition = std::numeric_limits<std::uint32_t>::max();

// A part as a whole, or one triangle of a part that is too large.
struct Item {
  Vector3d centre = Vector3d::Zero();
  std::uint32_t first = 0;  // triangle
  std::uint32_t count = 0;
};

std::vector<std::uint32_t> partOfTriangle(std::size_t vertices, std::span<const Triangle> triangles) {
  std::vector<std::uint32_t> joined(vertices);
  std::iota(joined.begin(), joined.end(), 0U);
  const auto root = [&](std::uint32_t v) {
    while (joined[v] != v) v = joined[v] = joined[joined[v]];
    return v;
  };
  for (const auto& t : triangles)
    for (const auto v : {t[1], t[2]}) {
      const auto a = root(t[0]), b = root(v);
      joined[std::max(a, b)] = std::min(a, b);
    }
  std::vector<std::uint32_t> part(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) part[i] = root(triangles[i][0]);
  return part;
}

class Cutter {
 public:
  Cutter(std::vector<Item>& items, std::size_t most, double cut) : items_(items), most_(most), cut_(cut) {}

  // The items [first, last) as cells, appended in order.
  void split(std::size_t first, std::size_t last, std::vector<std::pair<std::size_t, std::size_t>>& cells) {
    std::size_t triangles = 0;
    Vector3d low = items_[first].centre, high = low;
    for (auto i = first; i < last; ++i) {
      triangles += items_[i].count;
      low = low.cwiseMin(items_[i].centre);
      high = high.cwiseMax(items_[i].centre);
    }
    if (triangles <= most_ || last - first == 1) {
      cells.emplace_back(first, last);
      return;
    }
    int axis = 0;
    (high - low).maxCoeff(&axis);
    const auto middle =
        first + std::clamp<std::size_t>(static_cast<std::size_t>(cut_ * static_cast<double>(last - first)), 1,
                                        last - first - 1);
    const auto at = [&](std::size_t i) { return items_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(middle), at(last), [axis](const Item& a, const Item& b) {
      return a.centre[axis] != b.centre[axis] ? a.centre[axis] < b.centre[axis] : a.first < b.first;
    });
    std::vector<std::pair<std::size_t, std::size_t>> right;
    tbb::parallel_invoke([&] { split(first, middle, cells); }, [&] { split(middle, last, right); });
    cells.insert(cells.end(), right.begin(), right.end());
  }

 private:
  std::vector<Item>& items_;
  std::size_t most_;
  double cut_;
};

}  // namespace

Partition partition(std::span<const Vector3d> positions, std::span<const Triangle> triangles, std::size_t most,
                    double cut) {
  Partition result;
  result.shared.assign(positions.size(), 0);
  if (triangles.empty()) return result;
  const auto part = partOfTriangle(positions.size(), triangles);
  std::vector<std::uint32_t> size(positions.size(), 0);
  for (const auto p : part) ++size[p];
  std::vector<Item> items;
  items.reserve(static_cast<std::size_t>(
      std::count_if(part.begin(), part.end(), [&](std::uint32_t p) { return size[p] > most; })));
  std::vector<std::uint32_t> item_of_part(positions.size(), kNoPartition), next(triangles.size(), kNoPartition),
      last(positions.size(), kNoPartition);
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const auto& t = triangles[i];
    const Vector3d centre = (positions[t[0]] + positions[t[1]] + positions[t[2]]) / 3;
    const auto p = part[i];
    if (size[p] > most || item_of_part[p] == kNoPartition) {
      if (size[p] <= most) item_of_part[p] = static_cast<std::uint32_t>(items.size());
      items.push_back({centre, i, 1});
    } else {
      Item& item = items[item_of_part[p]];
      ++item.count;
      item.centre += (centre - item.centre) / item.count;
      next[last[p]] = i;
    }
    last[p] = i;
  }
  std::vector<std::pair<std::size_t, std::size_t>> ranges;
  Cutter(items, most, cut).split(0, items.size(), ranges);
  std::vector<std::uint32_t> cell_of_vertex(positions.size(), kNoPartition);
  for (const auto& [first, end] : ranges) {
    auto& cell = result.cells.emplace_back();
    const auto index = static_cast<std::uint32_t>(result.cells.size() - 1);
    for (auto i = first; i < end; ++i) {
      const bool whole = size[part[items[i].first]] <= most;
      for (auto t = items[i].first; t != kNoPartition; t = whole ? next[t] : kNoPartition) {
        cell.push_back(t);
        for (const auto v : triangles[t]) {
          if (cell_of_vertex[v] == kNoPartition)
            cell_of_vertex[v] = index;
          else if (cell_of_vertex[v] != index)
            result.shared[v] = 1, result.any_shared = true;
        }
      }
    }
  }
  return result;
}

}  // namespace standpoint
