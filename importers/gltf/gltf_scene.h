// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>

#include <Eigen/Geometry>

#include "importers/gltf/gltf_file.h"

namespace standpoint {

struct GltfNode {
  std::size_t index = 0;
  std::string place;  // "/nodes/7"
  const tinygltf::Node* gltf = nullptr;
  Eigen::Affine3d world_from_node = Eigen::Affine3d::Identity();  // glTF's world, Y up
  // In a file of ours: the product that it or a node above it stands for, and the node that says so.
  std::optional<std::size_t> product;
  const tinygltf::Node* product_node = nullptr;
};

// Visits the nodes of the default scene (of all root nodes where the file has no scene), parents first, in the file's
// order. A node that is reached twice is a fault: node hierarchies are trees. Says which nodes were visited.
std::vector<bool> walkScene(GltfFile& file, const std::function<void(const GltfNode&)>& visit);

// EXT_mesh_gpu_instancing: the places of a node's mesh in the node's own frame; one identity where it has none.
std::vector<Eigen::Affine3d> instancesOf(GltfFile& file, const GltfNode& node);

// Of a skin at rest: for each joint, glTF's world from the frame in which the skin's mesh was bound.
std::vector<Eigen::Affine3d> jointsOf(GltfFile& file, std::size_t skin, const std::string& asked_by);

}  // namespace standpoint
