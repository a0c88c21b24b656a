// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/surface/mesh_statistics.h"

#include <algorithm>
#include <vector>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "optimizer/surface/manifold.h"

namespace standpoint {

namespace {

using HalfEdges = OpenMesh::TriMesh_ArrayKernelT<>;
using Vertex = HalfEdges::VertexHandle;

// Where the shape is not manifold, its vertices are repeated, so that half-edges can be made of it.
HalfEdges halfEdgesOf(const ManifoldShape& manifold) {
  [[maybe_unused]] static const bool silent = (omerr().disable(), true);
  HalfEdges mesh;
  mesh.reserve(manifold.positions.size(), manifold.triangles.size() * 3 / 2, manifold.triangles.size());
  for (std::size_t i = 0; i < manifold.positions.size(); ++i) mesh.add_vertex({0, 0, 0});
  for (const auto& t : manifold.triangles)
    mesh.add_face(Vertex(static_cast<int>(t[0])), Vertex(static_cast<int>(t[1])), Vertex(static_cast<int>(t[2])));
  return mesh;
}

// Loops of borders, without those along odd edges, where the half-edges were only cut.
std::uint64_t countHoles(const ManifoldShape& manifold, const HalfEdges& mesh) {
  std::vector<bool> is_border(mesh.n_halfedges(), false), seen(mesh.n_halfedges(), false);
  for (const auto corner : manifold.border_edges) {
    const auto& t = manifold.triangles[corner / 3];
    const auto half = mesh.find_halfedge(Vertex(static_cast<int>(t[nextCorner(corner) % 3])),
                                         Vertex(static_cast<int>(t[corner % 3])));
    if (half.is_valid()) is_border[static_cast<std::size_t>(half.idx())] = true;
  }
  std::uint64_t holes = 0;
  for (std::size_t first = 0; first < seen.size(); ++first) {
    if (!is_border[first] || seen[first]) continue;
    bool all = true;
    auto half = HalfEdges::HalfedgeHandle(static_cast<int>(first));
    do {
      const auto i = static_cast<std::size_t>(half.idx());
      seen[i] = true;
      all = all && is_border[i];
      half = mesh.next_halfedge_handle(half);
    } while (static_cast<std::size_t>(half.idx()) != first);
    holes += all ? 1 : 0;
  }
  return holes;
}

}  // namespace

std::uint64_t countParts(const Shape& shape) {
  std::vector<std::uint32_t> part(shape.positions.size());
  for (std::uint32_t v = 0; v < part.size(); ++v) part[v] = v;
  const auto root = [&](std::uint32_t v) {
    while (part[v] != v) v = part[v] = part[part[v]];
    return v;
  };
  std::uint64_t parts = part.size();
  for (const auto& t : shape.triangles)
    for (const auto v : {t[1], t[2]}) {
      const auto a = root(t[0]), b = root(v);
      if (a == b) continue;
      part[std::max(a, b)] = std::min(a, b);
      --parts;
    }
  return parts;
}

MeshStatistics& MeshStatistics::operator+=(const MeshStatistics& other) {
  triangles += other.triangles;
  vertices += other.vertices;
  parts += other.parts;
  border_edges += other.border_edges;
  holes += other.holes;
  odd_edges += other.odd_edges;
  odd_vertices += other.odd_vertices;
  return *this;
}

MeshStatistics statisticsOf(const Mesh& mesh) {
  const Shape shape = weld(mesh);
  const auto manifold = manifoldOf(shape);
  MeshStatistics result;
  result.triangles = shape.triangles.size();
  result.vertices = shape.positions.size();
  result.parts = countParts(shape);
  result.border_edges = manifold.border_edges.size();
  result.odd_edges = manifold.odd_edges.size();
  result.holes = countHoles(manifold, halfEdgesOf(manifold));
  std::vector<std::uint32_t> fans(shape.positions.size(), 0);
  for (const auto name : manifold.names) ++fans[name];
  for (const auto& [a, b] : manifold.odd_edges) fans[a] = fans[b] = 0;
  result.odd_vertices =
      static_cast<std::uint64_t>(std::count_if(fans.begin(), fans.end(), [](auto n) { return n > 1; }));
  return result;
}

MeshStatistics statisticsOfProduct(const Environment& environment, std::uint32_t product) {
  MeshStatistics sum;
  for (const auto& instance : environment.instances)
    if (instance.product == product) sum += statisticsOf(*environment.meshes[instance.mesh]);
  return sum;
}

}  // namespace standpoint
