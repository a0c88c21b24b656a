// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/scene_edges.h"

#include <algorithm>
#include <array>
#include <bit>
#include <tuple>

#include <Eigen/Geometry>
#include <tbb/parallel_sort.h>

namespace standpoint {

namespace {

// Of vertices in one place the first stands for all.
std::vector<std::uint32_t> welded(const Mesh& mesh) {
  struct Place {
    std::array<std::uint32_t, 3> bits;
    std::uint32_t vertex;
    bool operator<(const Place& other) const { return std::tie(bits, vertex) < std::tie(other.bits, other.vertex); }
  };
  std::vector<Place> places(mesh.positions.size());
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    const Eigen::Vector3f p = mesh.positions[i] + Eigen::Vector3f::Zero();  // one zero, not two
    places[i] = {std::bit_cast<std::array<std::uint32_t, 3>>(std::array{p.x(), p.y(), p.z()}), i};
  }
  tbb::parallel_sort(places);
  std::vector<std::uint32_t> first(places.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    first[places[i].vertex] =
        i > 0 && places[i].bits == places[i - 1].bits ? first[places[i - 1].vertex] : places[i].vertex;
  return first;
}

struct Side {
  std::uint64_t edge = 0;  // its vertices, the lower one first
  std::uint32_t opposite = 0;
  bool operator<(const Side& other) const { return std::tie(edge, opposite) < std::tie(other.edge, other.opposite); }
  bool operator==(const Side&) const = default;
};

// One plane on both sides of the edge: to 2 arcsec, which float corners of small triangles need.
bool flat(const Mesh& mesh, const MeshEdge& edge) {
  const auto at = [&](std::uint32_t k) -> Eigen::Vector3d { return mesh.positions[k].cast<double>(); };
  const Eigen::Vector3d from = at(edge.from), along = at(edge.to) - from;
  const Eigen::Vector3d left = along.cross(at(edge.left) - from), right = along.cross(at(edge.right) - from);
  const double cosine = left.dot(right), product = std::sqrt(left.squaredNorm() * right.squaredNorm());
  return cosine < 0 && left.cross(right).norm() < 1e-5 * product;
}

}  // namespace

std::vector<MeshEdge> outlineEdges(const Mesh& mesh) {
  const auto first = welded(mesh);
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (const Triangle& triangle : mesh.triangles) {
    const std::uint32_t corners[3] = {first[triangle[0]], first[triangle[1]], first[triangle[2]]};
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(corners[k], corners[(k + 1) % 3]);
      sides.push_back({std::uint64_t{low} << 32U | high, corners[(k + 2) % 3]});
    }
  }
  tbb::parallel_sort(sides);
  sides.erase(std::unique(sides.begin(), sides.end()), sides.end());  // a face and its back are one
  std::vector<MeshEdge> edges;
  for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
    while (end < sides.size() && sides[end].edge == sides[i].edge) ++end;
    MeshEdge edge{.from = static_cast<std::uint32_t>(sides[i].edge >> 32U),
                  .to = static_cast<std::uint32_t>(sides[i].edge),
                  .left = sides[i].opposite};
    if (end - i == 2) {
      edge.right = sides[i + 1].opposite;
      if (flat(mesh, edge)) continue;
    }
    edges.push_back(edge);
  }
  return edges;
}

}  // namespace standpoint
