// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What stands in an exported glTF beside the model: simpler levels of detail, collision shapes.

#include <functional>
#include <map>

#include "importers/gltf/gltf_model.h"
#include "importers/gltf/gltf_writer.h"

namespace standpoint {

// The file being written, as far as companions add to it. A mesh without vertices has no glTF mesh: −1.
struct GltfScene {
  tinygltf::Model& model;
  std::function<int(const std::shared_ptr<const Mesh>&, const std::string& name)> mesh;  // its index
  std::function<int(const std::shared_ptr<const Mesh>&, const std::string& name)> bare;  // the same without materials
  std::function<int(const Instance&, int mesh)> node;                                    // adds one; its index
};

// Nodes of simpler levels, named by MSFT_lod in the node of each product that has them.
void addGltfLevels(GltfScene& scene, const Environment& finest, const std::vector<GltfLevel>& levels,
                   const std::map<std::uint32_t, int>& node_of_product);

// Nodes of collision shapes; those that belong into the scene's tree are returned.
std::vector<int> addGltfCollision(GltfScene& scene, const Environment& model, const GltfCollision& collision,
                                  const std::map<std::uint32_t, int>& node_of_product);

// Whether a node is a collision shape: by our own word, or by its name as Unreal and Godot read it.
bool isGltfCollision(const tinygltf::Node& node);

}  // namespace standpoint
