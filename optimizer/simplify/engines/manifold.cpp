// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/simplify/engines/manifold.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr auto kNobody = std::numeric_limits<std::uint32_t>::max();
constexpr double kLineWeight = 0.3;  // of an upright plane, times the squared length of its edge

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

std::uint32_t nextCorner(std::uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

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
  void holdAlong(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& edges);
  void addPlane(std::uint32_t corner, std::vector<Quadric>& planes) const;

  const Shape& shape_;
  Sets fans_, charts_;
  std::vector<std::uint32_t> odd_;  // vertices of edges that cannot be kept
  std::vector<std::uint32_t> rims_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> lines_;
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
      rims_.push_back(one);
    } else if (j - i == 2 && at(one) == at(nextCorner(other))) {
      fans_.join(one, nextCorner(other));
      fans_.join(nextCorner(one), other);
      if (isLine(one, other))
        lines_.emplace_back(one, other);
      else
        charts_.join(one / 3, other / 3);
    } else {
      odd_.push_back(sides[i].low);
      odd_.push_back(sides[i].high);
    }
  }
}

void Splitter::makeVertices() {
  std::vector<std::uint32_t> index(3 * shape_.triangles.size(), kNobody), first(shape_.positions.size(), kNobody);
  std::vector<bool> fixed(shape_.positions.size(), false);
  for (const auto v : odd_) fixed[v] = true;
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
void Splitter::holdAlong(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& edges) {
  std::vector<std::uint8_t> count(result_.names.size(), 0);
  const auto vertex = [&](std::uint32_t corner) { return result_.triangles[corner / 3][corner % 3]; };
  for (const auto& [one, other] : edges)
    for (const auto v : {vertex(one), vertex(nextCorner(one))}) {
      if (count[v] < 3) ++count[v];
      if (result_.charts[one / 3] == result_.charts[other / 3]) count[v] = 3;
    }
  for (const auto corner : rims_)
    for (const auto v : {vertex(corner), vertex(nextCorner(corner))})
      if (count[v] > 0) count[v] = 3;
  for (std::size_t v = 0; v < count.size(); ++v) {
    if (count[v] == 0 || result_.holds[v] == Hold::fixed) continue;
    result_.holds[v] = count[v] == 2 ? Hold::line : Hold::fixed;
  }
}

void Splitter::addPlane(std::uint32_t corner, std::vector<Quadric>& planes) const {
  const auto& t = result_.triangles[corner / 3];
  const auto a = t[corner % 3], b = t[nextCorner(corner) % 3], c = t[nextCorner(nextCorner(corner)) % 3];
  const Vector3d edge = result_.positions[b] - result_.positions[a];
  const Vector3d upright = edge.cross(edge.cross(result_.positions[c] - result_.positions[a]));
  const double length = upright.norm();
  if (!(length > 0)) return;
  for (const auto v : {a, b})
    planes[v].addPlane(upright / length, result_.positions[a], kLineWeight * edge.squaredNorm());
}

ManifoldShape Splitter::split() {
  sortEdges();
  makeVertices();
  for (std::uint32_t i = 0; i < shape_.triangles.size(); ++i) result_.charts.push_back(charts_.of(i));
  holdAlong(lines_);
  result_.lines.resize(result_.names.size());
  result_.borders.resize(result_.names.size());
  for (const auto& [one, other] : lines_) {
    addPlane(one, result_.lines);
    addPlane(other, result_.lines);
  }
  for (const auto corner : rims_) addPlane(corner, result_.borders);
  return std::move(result_);
}

}  // namespace

ManifoldShape manifoldOf(const Shape& shape, const std::vector<bool>* stays) {
  auto manifold = Splitter(shape).split();
  for (std::size_t i = 0; stays != nullptr && i < manifold.names.size(); ++i)
    if ((*stays)[manifold.names[i]]) manifold.holds[i] = Hold::fixed;
  return manifold;
}

Result<void> checkReachable(const ManifoldShape& manifold, std::size_t triangles) {
  const auto fixed = static_cast<std::size_t>(
      std::count_if(manifold.triangles.begin(), manifold.triangles.end(), [&](const Triangle& t) {
        return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return manifold.holds[v] == Hold::fixed; });
      }));
  if (fixed > triangles)
    return failure(ErrorKind::unusable,
                   fmt::format("{} triangles are at edges of three or more, {} are requested", fixed, triangles));
  return {};
}

void CollapseRecorder::record(std::uint32_t kept, std::uint32_t removed, std::uint32_t triangles,
                              const Eigen::Vector3d& position) {
  auto& names = manifold_->names;
  auto& holds = manifold_->holds;
  Collapse step;
  step.kept = names[kept];
  step.removed = names[removed];
  if (holds[removed] > holds[kept]) std::swap(step.kept, step.removed);
  step.triangles = triangles;
  step.position = position;
  log_.push_back(step);
  triangles_ -= triangles;
  names[kept] = step.kept;
  holds[kept] = std::max(holds[kept], holds[removed]);
  manifold_->lines[kept] += manifold_->lines[removed];
  manifold_->borders[kept] += manifold_->borders[removed];
  manifold_->positions[kept] = position;
}

}  // namespace standpoint
