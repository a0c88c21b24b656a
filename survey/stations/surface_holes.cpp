// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/stations/surface_holes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

namespace standpoint {

namespace {

using Eigen::Vector3d;
using LinkCell = std::tuple<std::int64_t, std::int64_t, std::int64_t>;

// In sides of the square for which one sample stands: some 18 samples are within a link, and 2.6 on a square.
constexpr double kLink = 2.4, kSquare = 1.6;
constexpr double kEven = 0.9;         // cosine between normals of one hole
constexpr double kOffPlane = 0.35;    // of a link
constexpr std::size_t kFewest = 4;    // samples: fewer are an edge or chance
constexpr double kMostSquares = 800;  // about; those of a large hole are larger
constexpr double kLevelPlane = 0.99;  // a normal so steep has no level direction of its own

std::int64_t floored(double v) { return static_cast<std::int64_t>(std::floor(v)); }

// One product's samples, by whether they are seen.
struct OfProduct {
  std::vector<std::size_t> hidden, seen;
};

class HoleFinder {
 public:
  HoleFinder(const SurfaceSamples& samples, std::span<const double> spacing_m)
      : samples_(samples), spacing_m_(spacing_m), side_m_(std::sqrt(samples.each_m2())) {}

  void find(std::uint32_t product, const OfProduct& of, std::vector<SurfaceHole>& holes) const {
    const auto spacing = median(of.seen);
    for (const auto& group : groups(of.hidden)) {
      SurfaceHole hole;
      hole.product = product;
      hole.area_m2 = samples_.each_m2() * static_cast<double>(group.size());
      hole.spacing_m = spacing;
      hole.at = middleOf(group);
      hole.shape = shapeOf(group, of.seen);
      holes.push_back(std::move(hole));
    }
  }

 private:
  const SurfacePlace& place(std::size_t k) const { return samples_.samples[k].place; }

  std::optional<double> median(const std::vector<std::size_t>& seen) const {
    std::vector<double> all;
    for (const auto k : seen) all.push_back(spacing_m_[k]);
    if (all.empty()) return std::nullopt;
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    return *middle;
  }

  bool hangTogether(const SurfacePlace& a, const SurfacePlace& b) const {
    const double link_m = kLink * side_m_;
    const Vector3d way = b.position - a.position;
    return way.squaredNorm() <= link_m * link_m && a.normal.dot(b.normal) >= kEven &&
           std::abs(way.dot(a.normal)) <= kOffPlane * link_m;
  }

  std::vector<std::vector<std::size_t>> groups(const std::vector<std::size_t>& hidden) const {
    std::vector<std::size_t> group(hidden.size());
    std::iota(group.begin(), group.end(), std::size_t{0});
    const auto root = [&](std::size_t i) {
      while (group[i] != i) i = group[i] = group[group[i]];
      return i;
    };
    const auto cellOf = [&](const Vector3d& p) {
      const Vector3d c = p / (kLink * side_m_);
      return LinkCell{floored(c.x()), floored(c.y()), floored(c.z())};
    };
    std::map<LinkCell, std::vector<std::size_t>> in_cell;
    for (std::size_t i = 0; i < hidden.size(); ++i) {
      const auto [x, y, z] = cellOf(place(hidden[i]).position);
      for (const auto dx : {-1, 0, 1})
        for (const auto dy : {-1, 0, 1})
          for (const auto dz : {-1, 0, 1}) {
            const auto near = in_cell.find({x + dx, y + dy, z + dz});
            if (near == in_cell.end()) continue;
            for (const auto k : near->second)
              if (hangTogether(place(hidden[i]), place(hidden[k]))) group[root(i)] = root(k);
          }
      in_cell[{x, y, z}].push_back(i);
    }
    std::map<std::size_t, std::vector<std::size_t>> by_root;
    for (std::size_t i = 0; i < hidden.size(); ++i) by_root[root(i)].push_back(hidden[i]);
    std::vector<std::vector<std::size_t>> found;
    for (auto& [r, group_of_r] : by_root)
      if (group_of_r.size() >= kFewest) found.push_back(std::move(group_of_r));
    return found;
  }

  // A hole may be a ring: the sample that is nearest to the middle.
  Vector3d middleOf(const std::vector<std::size_t>& group) const {
    Vector3d middle = Vector3d::Zero();
    for (const auto k : group) middle += place(k).position / static_cast<double>(group.size());
    return place(*std::min_element(group.begin(), group.end(),
                                   [&](auto a, auto b) {
                                     return (place(a).position - middle).squaredNorm() <
                                            (place(b).position - middle).squaredNorm();
                                   }))
        .position;
  }

  // Where more samples are hidden than seen; and squares that chance has given none, but most of whose neighbours are
  // hidden.
  static std::set<HoleSquare> hiddenSquares(const std::map<HoleSquare, int>& surplus) {
    constexpr int kMostOfEight = 5;
    std::set<HoleSquare> hidden;
    for (const auto& [at, more] : surplus)
      if (more > 0) hidden.insert(at);
    std::map<HoleSquare, int> beside;  // hidden neighbours of squares without a sample
    for (const auto& [i, j] : hidden)
      for (const auto di : {-1, 0, 1})
        for (const auto dj : {-1, 0, 1})
          if (!surplus.contains({i + di, j + dj})) ++beside[{i + di, j + dj}];
    for (const auto& [at, count] : beside)
      if (count >= kMostOfEight) hidden.insert(at);
    return hidden;
  }

  HoleShape shapeOf(const std::vector<std::size_t>& group, const std::vector<std::size_t>& seen) const {
    HoleShape shape;
    Vector3d normal = Vector3d::Zero(), origin = Vector3d::Zero();
    for (const auto k : group)
      normal += place(k).normal, origin += place(k).position / static_cast<double>(group.size());
    shape.normal = normal.normalized();
    const Vector3d level = Vector3d::UnitZ().cross(shape.normal);
    const Vector3d right = std::abs(shape.normal.z()) > kLevelPlane
                               ? Vector3d(Vector3d::UnitY().cross(shape.normal).normalized())
                               : Vector3d(level.normalized());
    const Vector3d up = shape.normal.cross(right);
    const double area_m2 = samples_.each_m2() * static_cast<double>(group.size());
    const double side_m = std::max(kSquare * side_m_, std::sqrt(area_m2 / kMostSquares));
    shape.origin = origin, shape.right = right * side_m, shape.up = up * side_m;
    const auto squareOf = [&](const Vector3d& p) {
      const Vector3d off = p - origin;
      return HoleSquare{static_cast<int>(std::floor(off.dot(right) / side_m)),
                        static_cast<int>(std::floor(off.dot(up) / side_m))};
    };
    std::map<HoleSquare, int> surplus;  // of hidden samples over seen ones
    for (const auto k : group) ++surplus[squareOf(place(k).position)];
    for (const auto k : seen)
      if (std::abs((place(k).position - origin).dot(shape.normal)) < side_m &&
          place(k).normal.dot(shape.normal) >= kEven)
        --surplus[squareOf(place(k).position)];
    const auto squares = hiddenSquares(surplus);
    shape.squares.assign(squares.begin(), squares.end());
    return shape;
  }

  const SurfaceSamples& samples_;
  std::span<const double> spacing_m_;
  double side_m_;
};

}  // namespace

std::vector<HoleEdge> rimOf(const std::set<HoleSquare>& squares) {
  std::vector<HoleEdge> rim;
  for (const bool upright : {false, true}) {
    std::map<HoleSquare, HoleSquare> edges;  // begins at the first and ends at the second
    for (const auto& s : squares)
      for (const int side : {0, 1}) {
        const auto other = upright ? HoleSquare{s[0] + 2 * side - 1, s[1]} : HoleSquare{s[0], s[1] + 2 * side - 1};
        if (squares.contains(other)) continue;
        const auto from = upright ? HoleSquare{s[0] + side, s[1]} : HoleSquare{s[0], s[1] + side};
        edges[from] = upright ? HoleSquare{from[0], from[1] + 1} : HoleSquare{from[0] + 1, from[1]};
      }
    while (!edges.empty()) {
      auto [from, to] = *edges.begin();
      edges.erase(edges.begin());
      for (auto next = edges.find(to); next != edges.end(); next = edges.find(to)) {
        to = next->second;
        edges.erase(next);
      }
      rim.push_back({from, to});
    }
  }
  return rim;
}

std::vector<SurfaceHole> surfaceHoles(const SurfaceSamples& samples, std::span<const double> spacing_m,
                                      std::size_t most) {
  std::map<std::uint32_t, OfProduct> products;
  for (std::size_t k = 0; k < samples.samples.size(); ++k) {
    const auto& sample = samples.samples[k];
    if (!sample.exposed) continue;
    auto& of = products[sample.product];
    (spacing_m[k] > 0 ? of.seen : of.hidden).push_back(k);
  }
  std::vector<SurfaceHole> holes;
  const HoleFinder finder(samples, spacing_m);
  for (const auto& [product, of] : products) finder.find(product, of, holes);
  std::stable_sort(holes.begin(), holes.end(),
                   [](const SurfaceHole& a, const SurfaceHole& b) { return a.area_m2 > b.area_m2; });
  holes.resize(std::min(holes.size(), most));
  return holes;
}

}  // namespace standpoint
