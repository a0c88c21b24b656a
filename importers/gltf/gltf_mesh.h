// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "core/environment.h"
#include "core/report.h"
#include "importers/gltf/gltf_material.h"
#include "importers/gltf/gltf_metadata.h"
#include "importers/gltf/gltf_primitive.h"

namespace standpoint {

// How a node shapes a mesh: nothing for nearly all.
struct GltfPose {
  std::vector<double> weights;          // of morph targets
  std::vector<Eigen::Affine3d> joints;  // glTF's world from the mesh's bind pose; empty: no skin
  bool operator==(const GltfPose& other) const;
};

struct GltfMesh {
  Mesh mesh;
  std::vector<GltfFeature> features;            // EXT_mesh_features with a property table; else empty, as the next
  std::vector<std::int32_t> feature_of_vertex;  // index into features; −1: none
};

// The triangles of /meshes/<index> in the order of its primitives, sorted by surface. A primitive without a material
// gets `no_material`. Primitives that share their attributes share their vertices. Texture coordinates are those of the
// material's image, transformed; without an image the first set. What is not a surface goes to the report.
GltfMesh readGltfMesh(GltfFile& file, std::size_t index, const GltfMaterials& materials, std::uint32_t no_material,
                      const GltfPose& pose, Report& report);

// One part for each feature, in the order in which they are met; what belongs to none comes first.
struct GltfPart {
  Mesh mesh;
  std::optional<GltfFeature> feature;
};
std::vector<GltfPart> splitByFeature(GltfMesh&& whole);

// The vertices of a mesh that has no triangles, which our writer keeps as points.
Mesh readGltfPoints(GltfFile& file, std::size_t index);

// Moves positions as `pose` says; a primitive without targets or joints stays as it is.
void applyPose(GltfFile& file, GltfPrimitive& primitive, const GltfPose& pose, std::vector<Eigen::Vector3f>& positions);

}  // namespace standpoint
