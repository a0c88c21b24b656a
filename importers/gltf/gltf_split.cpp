// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <limits>
#include <numeric>

#include "importers/gltf/gltf_mesh.h"

namespace standpoint {

namespace {

constexpr auto kUnused = std::numeric_limits<std::uint32_t>::max();

// Of a mesh, the triangles from `first` to `last` of `order` with the vertices that they need.
Mesh extracted(const Mesh& whole, const std::vector<std::uint32_t>& order, std::size_t first, std::size_t last,
               std::vector<std::uint32_t>& new_of_old) {
  Mesh part;
  std::vector<std::uint32_t> used;
  for (std::size_t i = first; i < last; ++i) {
    Triangle triangle = whole.triangles[order[i]];
    for (auto& corner : triangle) {
      if (new_of_old[corner] == kUnused) {
        new_of_old[corner] = static_cast<std::uint32_t>(used.size());
        used.push_back(corner);
      }
      corner = new_of_old[corner];
    }
    part.triangles.push_back(triangle);
    part.surface_of_triangle.push_back(whole.surface_of_triangle[order[i]]);
  }
  for (const auto old : used) {
    part.positions.push_back(whole.positions[old]);
    if (!whole.texture_coordinates.empty()) part.texture_coordinates.push_back(whole.texture_coordinates[old]);
    if (!whole.colours.empty()) part.colours.push_back(whole.colours[old]);
    new_of_old[old] = kUnused;
  }
  return part;
}

}  // namespace

std::vector<GltfPart> splitByFeature(GltfMesh&& whole) {
  std::vector<GltfPart> parts;
  if (whole.features.empty()) {
    parts.push_back({std::move(whole.mesh), std::nullopt});
    return parts;
  }
  const auto feature = [&](std::uint32_t triangle) {
    return whole.feature_of_vertex[whole.mesh.triangles[triangle][0]];
  };
  std::vector<std::uint32_t> order(whole.mesh.triangles.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return feature(a) < feature(b); });
  std::vector<std::uint32_t> new_of_old(whole.mesh.positions.size(), kUnused);
  for (std::size_t first = 0, last = 0; first < order.size(); first = last) {
    const auto id = feature(order[first]);
    while (last < order.size() && feature(order[last]) == id) ++last;
    GltfPart part{extracted(whole.mesh, order, first, last, new_of_old), std::nullopt};
    if (id >= 0) part.feature = whole.features[static_cast<std::size_t>(id)];
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace standpoint
