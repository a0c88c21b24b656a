// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/surface/manifold.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace standpoint {

namespace {

constexpr auto kNobody = std::numeric_limits<std::uint32_t>::max();

class Sets {  // of things that belong together
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }
  std::uint32_t of(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = of(a);
    b = of(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

struct Side {  // an edge of a triangle: from corner k to the next one
  std::uint32_t low, high, corner;
  bool operator<(const Side& o) const {
    return low != o.low ? low < o.low : high != o.high ? high < o.high : corner < o.corner;
  }
};

class Splitter {
 public:
  explicit Splitter(const Shape& shape)
      : shape_(shape), fans_(3 * shape.triangles.size()), charts_(shape.triangles.size()) {}
  ManifoldShape split();

 private:
  std::uint32_t at(std::uint32_t corner) const { return shape_.triangles[corner / 3][corner % 3]; }
  bool isLine(std::uint32_t one, std::uint32_t other) const;
  void sortEdges();
  void makeVertices();
  void holdAlongLines();

  const Shape& shape_;
  Sets fans_, charts_;
  ManifoldShape result_;
};

// Whether the edges that start at these corners, which are the same in two senses, separate surfaces or paint.
bool Splitter::isLine(std::uint32_t one, std::uint32_t other) const {
  if (shape_.surface_of_triangle[one / 3] != shape_.surface_of_triangle[other / 3]) return true;
  if (shape_.wedges.empty()) return false;
  const auto wedge = [&](std::uint32_t corner) { return shape_.wedges[corner / 3][corner % 3]; };
  return wedge(one) != wedge(nextCorner(other)) || wedge(nextCorner(one)) != wedge(other);
}

void Splitter::sortEdges() {
  std::vector<Side> sides;
  sides.reserve(3 * shape_.triangles.size());
  for (std::uint32_t corner = 0; corner < 3 * shape_.triangles.size(); ++corner) {
    const auto a = at(corner), b = at(nextCorner(corner));
    sides.push_back({std::min(a, b), std::max(a, b), corner});
  }
  std::sort(sides.begin(), sides.end());
  for (std::size_t i = 0, j = 0; i < sides.size(); i = j) {
    while (j < sides.size() && sides[j].low == sides[i].low && sides[j].high == sides[i].high) ++j;
    const auto one = sides[i].corner, other = sides[j - 1].corner;
    if (j - i == 1) {
      result_.border_edges.push_back(one);
    } else if (j - i == 2 && at(one) == at(nextCorner(other))) {
      fans_.join(one, nextCorner(other));
      fans_.join(nextCorner(one), other);
      if (isLine(one, other))
        result_.line_edges.emplace_back(one, other);
      else
        charts_.join(one / 3, other / 3);
    } else {
      result_.odd_edges.emplace_back(sides[i].low, sides[i].high);
    }
  }
}

void Splitter::makeVertices() {
  std::vector<std::uint32_t> index(3 * shape_.triangles.size(), kNobody), first(shape_.positions.size(), kNobody);
  std::vector<bool> fixed(shape_.positions.size(), false);
  for (const auto& [a, b] : result_.odd_edges) fixed[a] = fixed[b] = true;
  result_.triangles.resize(shape_.triangles.size());
  for (std::uint32_t corner = 0; corner < index.size(); ++corner) {
    auto& vertex = index[fans_.of(corner)];
    if (vertex == kNobody) {
      vertex = static_cast<std::uint32_t>(result_.names.size());
      const auto name = at(corner);
      if (std::exchange(first[name], vertex) != kNobody) fixed[name] = true;
      result_.names.push_back(name);
      result_.positions.push_back(shape_.positions[name]);
    }
    result_.triangles[corner / 3][corner % 3] = vertex;
  }
  for (const auto name : result_.names) result_.holds.push_back(fixed[name] ? Hold::fixed : Hold::free);
}

// Where a line ends, branches or returns to itself, its vertex is fixed.
void Splitter::holdAlongLines() {
  std::vector<std::uint8_t> count(result_.names.size(), 0);
  const auto vertex = [&](std::uint32_t corner) { return result_.triangles[corner / 3][corner % 3]; };
  for (const auto& [one, other] : result_.line_edges)
    for (const auto v : {vertex(one), vertex(nextCorner(one))}) {
      if (count[v] < 3) ++count[v];
      if (result_.charts[one / 3] == result_.charts[other / 3]) count[v] = 3;
    }
  for (const auto corner : result_.border_edges)
    for (const auto v : {vertex(corner), vertex(nextCorner(corner))})
      if (count[v] > 0) count[v] = 3;
  for (std::size_t v = 0; v < count.size(); ++v) {
    if (count[v] == 0 || result_.holds[v] == Hold::fixed) continue;
    result_.holds[v] = count[v] == 2 ? Hold::line : Hold::fixed;
  }
}

ManifoldShape Splitter::split() {
  sortEdges();
  makeVertices();
  for (std::uint32_t i = 0; i < shape_.triangles.size(); ++i) result_.charts.push_back(charts_.of(i));
  holdAlongLines();
  return std::move(result_);
}

}  // namespace

ManifoldShape manifoldOf(const Shape& shape, const std::vector<bool>* stays) {
  auto manifold = Splitter(shape).split();
  for (std::size_t i = 0; stays != nullptr && i < manifold.names.size(); ++i)
    if ((*stays)[manifold.names[i]]) manifold.holds[i] = Hold::fixed;
  return manifold;
}

}  // namespace standpoint
