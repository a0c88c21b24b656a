// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/environment.h"
#include "core/georeference.h"
#include "core/part_file.h"
#include "core/physical_material.h"
#include "core/progress.h"
#include "core/result.h"

namespace standpoint {

// glTF binary. Exactly invertible: readEnvironmentGlb(writeEnvironmentGlb(e)) has the same meshes with
// their texture coordinates and colours, surfaces, images and instances bit for bit (product records are not in it;
// nodes carry the product's index in `extras`).
Result<void> writeEnvironmentGlb(const Environment& environment, const Georeference& georeference, PartFile& file,
                                 Progress& progress);
Result<Environment> readEnvironmentGlb(const std::filesystem::path& file, Progress& progress);

// A simpler level of detail of the same products, and what it costs each.
struct GltfLevel {
  std::string name;  // "LOD 1: 10000 triangles"
  const Environment* environment = nullptr;
  std::vector<double> max_deviation_m, mean_deviation_m;  // one for each product
};
enum class CollisionNaming {
  unreal,   // UCX_<name of the mesh>_01 beside it; only what is convex, for Unreal makes hulls of these
  godot,    // <name>-convcolonly, -colonly
  physics,  // nodes with KHR_physics_rigid_bodies colliders, whose meshes nobody draws
};
struct GltfCollision {
  const Environment* shapes = nullptr;  // an instance for each shape; its surfaces do not matter
  std::vector<bool> convex;             // one for each instance
  CollisionNaming naming = CollisionNaming::physics;
};
struct GltfCompanions {
  std::vector<GltfLevel> levels;  // from fine to coarse; as MSFT_lod of each product's node
  std::optional<GltfCollision> collision;
  std::vector<const PhysicalMaterial*> physical;  // one for each surface, or none at all; null: not assigned
};

// The same for other programs, as .glb or, by the file's extension, as .gltf with a .bin beside it: Y up as glTF
// demands, each product a node with its name, ids and properties in `extras`, above a node for each instance where it
// has several. importFile of it gives the same triangles, surfaces, images, places and georeference, without the
// companions.
Result<void> exportEnvironmentGltf(const Environment& environment, const Georeference& georeference,
                                   const std::filesystem::path& file, Progress& progress,
                                   const GltfCompanions& companions = {});

}  // namespace standpoint
