// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/feature_edges.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(welded[mesh.triangles[t][k]], welded[mesh.triangles[t][(k + 1) % 3]]);
      if (low != high) all.push_back({low, high, t});
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

}  // namespace

std::vector<EdgeLine> featureEdges(const Mesh& mesh, double angle_rad) {
  const auto all = sides(mesh);
  const auto flat = static_cast<float>(std::cos(angle_rad));
  std::vector<EdgeLine> edges;
  for (std::size_t i = 0; i < all.size();) {
    std::size_t end = i + 1;
    while (end < all.size() && all[end].low == all[i].low && all[end].high == all[i].high) ++end;
    // Faces may be wound either way, so only the angle between their planes counts.
    bool sharp = end - i == 1;
    for (std::size_t j = i + 1; j < end && !sharp; ++j)
      sharp = std::abs(normal(mesh, all[i].triangle).dot(normal(mesh, all[j].triangle))) < flat;
    if (sharp) edges.push_back({all[i].low, all[i].high});
    i = end;
  }
  return edges;
}

}  // namespace standpoint
