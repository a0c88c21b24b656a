// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "core/environment.h"
#include "optimizer/surface/shape.h"

namespace standpoint {

// How the triangles of a mesh hang together, after equal positions are made one.
struct MeshStatistics {
  std::uint64_t triangles = 0, vertices = 0;
  std::uint64_t parts = 0;         // sets of triangles that share vertices
  std::uint64_t border_edges = 0;  // of one triangle
  std::uint64_t holes = 0;         // closed loops of borders: the rim of an open sheet is one, too
  std::uint64_t odd_edges = 0;     // not manifold: of three triangles or more, or of two that face different ways
  std::uint64_t odd_vertices = 0;  // not manifold: where triangles meet that share no edge there

  bool isClosed() const { return triangles > 0 && border_edges == 0 && odd_edges == 0; }
  MeshStatistics& operator+=(const MeshStatistics& other);
};

MeshStatistics statisticsOf(const Mesh& mesh);
MeshStatistics statisticsOfProduct(const Environment& environment, std::uint32_t product);  // of all its instances
std::uint64_t countParts(const Shape& shape);

}  // namespace standpoint
