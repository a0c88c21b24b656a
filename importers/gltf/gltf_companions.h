// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What stands in an exported glTF beside the model: simpler levels of detail, collision shapes.

#include <functional>
#include <map>

#include <nlohmann/json.hpp>

#include "importers/gltf/gltf_writer.h"

namespace standpoint {

// The file being written, as far as companions add to it.
struct GltfScene {
  nlohmann::json& json;
  std::function<std::size_t(const std::shared_ptr<const Mesh>&, const std::string& name)> mesh;  // its index
  std::function<nlohmann::json(const std::shared_ptr<const Mesh>&, const std::string& name)>
      bare;                                                                      // the same without materials
  std::function<std::size_t(const Instance&, const nlohmann::json& mesh)> node;  // adds one; its index
};

// Nodes of simpler levels, named by MSFT_lod in the node of each product that has them.
void addGltfLevels(GltfScene& scene, const Environment& finest, const std::vector<GltfLevel>& levels,
                   const std::map<std::uint32_t, std::size_t>& node_of_product);

// Nodes of collision shapes; those that belong into the scene's tree are returned.
std::vector<std::size_t> addGltfCollision(GltfScene& scene, const Environment& model, const GltfCollision& collision,
                                          const std::map<std::uint32_t, std::size_t>& node_of_product);

// Whether a node is a collision shape: by our own word, or by its name as Unreal and Godot read it.
bool isGltfCollision(const nlohmann::json& node);

}  // namespace standpoint
