// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/feature_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace standpoint {

namespace {

// For each position the first of those that are equal to it.
std::vector<std::uint32_t> weldedIndices(const std::vector<Eigen::Vector3f>& positions) {
  std::vector<std::uint32_t> order(positions.size()), first(positions.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto less = [&](std::uint32_t a, std::uint32_t b) {
    const auto &p = positions[a], &q = positions[b];
    if (p.x() != q.x()) return p.x() < q.x();
    if (p.y() != q.y()) return p.y() < q.y();
    return p.z() != q.z() ? p.z() < q.z() : a < b;
  };
  std::sort(order.begin(), order.end(), less);
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && positions[order[i]] == positions[order[i - 1]] ? first[order[i - 1]] : order[i];
  return first;
}

struct Side {
  std::uint32_t low, high;  // welded ends, low < high
  std::uint32_t triangle;
};

std::vector<Side> sides(const Mesh& mesh) {
  const auto welded = weldedIndices(mesh.positions);
  std::vector<Side> all;
  all.reserve(mesh.triangles.size() * 3);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::array corners = {welded[mesh.triangles[t][0]], welded[mesh.triangles[t][1]],
                                welded[mesh.triangles[t][2]]};
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(corners[k], corners[(k + 1) % 3]);
      all.push_back({low, high, t});
    }
  }
  std::sort(all.begin(), all.end(), [](const Side& a, const Side& b) {
    if (a.low != b.low) return a.low < b.low;
    return a.high != b.high ? a.high < b.high : a.triangle < b.triangle;
  });
  return all;
}

Eigen::Vector3f normal(const Mesh& mesh, std::uint32_t triangle) {
  const auto& t = mesh.triangles[triangle];
  return (mesh.positions[t[1]] - mesh.positions[t[0]]).cross(mesh.positions[t[2]] - mesh.positions[t[0]]).normalized();
}

constexpr std::uint32_t kNoNeighbour = 0xFFFFFFFF;

// Triangles that are only there to join a corner to a side that it lies on: they have no plane. Two faces meet at one
// as if it were not there: at each of its shorter sides with what lies beyond its longest one.
class Needles {
 public:
  Needles(const Mesh& mesh, const std::vector<Side>& sides) : mesh_(mesh), sides_(sides) {
    const std::size_t triangles = mesh.triangles.size();
    longest_.assign(triangles, 0), others_.assign(triangles, {0, 0}), thin_.assign(triangles, false);
    std::vector<std::array<std::uint32_t, 3>> own(triangles);
    std::vector<std::uint8_t> known(triangles, 0);
    for (std::uint32_t i = 0; i < sides.size(); ++i) {
      const auto t = sides[i].triangle;
      own[t][known[t]++] = i;
      if (known[t] == own[t].size()) know(t, own[t]);
    }
  }
  bool isLongestOfOne(std::uint32_t side) const {
    const auto t = sides_[side].triangle;
    return thin_[t] && isSame(sides_[longest_[t]], sides_[side]);
  }
  // The triangle that counts at this side; kNoNeighbour where the surface ends there.
  std::uint32_t behind(std::uint32_t side) const {
    constexpr int kMostInARow = 32;
    auto triangle = sides_[side].triangle;
    const Eigen::Vector3f middle = middleOf(sides_[side]);
    auto entered = side;
    for (int i = 0; i < kMostInARow && triangle != kNoNeighbour && thin_[triangle]; ++i) {
      const bool by_longest = isSame(sides_[longest_[triangle]], sides_[entered]);
      const auto left_by = by_longest ? nearest(triangle, middle) : longest_[triangle];
      entered = beyond(left_by);
      triangle = entered == kNoNeighbour ? kNoNeighbour : sides_[entered].triangle;
    }
    return triangle;
  }

 private:
  static constexpr float kThin_m = 2e-5F;  // a few times what single precision gives at a hundred metres

  static bool isSame(const Side& a, const Side& b) { return a.low == b.low && a.high == b.high; }
  Eigen::Vector3f middleOf(const Side& s) const { return (mesh_.positions[s.low] + mesh_.positions[s.high]) / 2; }
  // The same side of another triangle.
  std::uint32_t beyond(std::uint32_t side) const {
    if (side + 1 < sides_.size() && isSame(sides_[side + 1], sides_[side])) return side + 1;
    return side > 0 && isSame(sides_[side - 1], sides_[side]) ? side - 1 : kNoNeighbour;
  }
  // Of its two shorter sides the one that this place lies on.
  std::uint32_t nearest(std::uint32_t triangle, const Eigen::Vector3f& place) const {
    const auto detour_m = [&](std::uint32_t side) {
      const auto &a = mesh_.positions[sides_[side].low], &b = mesh_.positions[sides_[side].high];
      return (place - a).norm() + (place - b).norm() - (b - a).norm();
    };
    const auto [one, other] = others_[triangle];
    return detour_m(one) < detour_m(other) ? one : other;
  }
  float length_m(std::uint32_t side) const {
    return (mesh_.positions[sides_[side].high] - mesh_.positions[sides_[side].low]).norm();
  }
  void know(std::uint32_t t, std::array<std::uint32_t, 3> own) {
    std::sort(own.begin(), own.end(), [&](auto a, auto b) { return length_m(a) > length_m(b); });
    longest_[t] = own[0];
    others_[t] = {own[1], own[2]};
    const auto& [a, b, c] = mesh_.triangles[t];
    const auto& p = mesh_.positions;
    thin_[t] = (p[b] - p[a]).cross(p[c] - p[a]).norm() < kThin_m * length_m(own[0]);
  }

  const Mesh& mesh_;
  const std::vector<Side>& sides_;
  std::vector<std::uint32_t> longest_;  // for each triangle, of its sides
  std::vector<std::pair<std::uint32_t, std::uint32_t>> others_;
  std::vector<bool> thin_;
};

}  // namespace

std::vector<EdgeLine> featureEdges(const Mesh& mesh, double angle_rad) {
  const auto all = sides(mesh);
  const Needles needles(mesh, all);
  const auto flat = static_cast<float>(std::cos(angle_rad));
  std::vector<EdgeLine> edges;
  for (std::uint32_t i = 0; i < all.size();) {
    std::uint32_t end = i + 1;
    while (end < all.size() && all[end].low == all[i].low && all[end].high == all[i].high) ++end;
    bool drawn_in_parts = false, sharp = end - i == 1;
    for (std::uint32_t j = i; j < end; ++j)
      drawn_in_parts = drawn_in_parts || (end - i > 1 && needles.isLongestOfOne(j));
    // Faces may be wound either way, so only the angle between their planes counts.
    const auto first = needles.behind(i);
    for (std::uint32_t j = i + 1; j < end && !sharp && !drawn_in_parts; ++j) {
      const auto other = needles.behind(j);
      sharp = first == kNoNeighbour || other == kNoNeighbour ||
              (first != other && std::abs(normal(mesh, first).dot(normal(mesh, other))) < flat);
    }
    if (sharp && !drawn_in_parts) edges.push_back({all[i].low, all[i].high});
    i = end;
  }
  return edges;
}

}  // namespace standpoint
