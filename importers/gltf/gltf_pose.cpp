// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "importers/gltf/gltf_mesh.h"

namespace standpoint {

namespace {

using Positions = std::vector<Eigen::Vector3f>;

// glTF 2.0 §3.7.2.2: position + Σ weight · target.
void morph(GltfFile& file, GltfPrimitive& primitive, const std::vector<double>& weights, Positions& positions) {
  const auto& targets = primitive.gltf().targets;
  for (std::size_t t = 0; t < std::min(targets.size(), weights.size()); ++t) {
    if (weights[t] == 0) continue;
    const std::string place = primitive.place() + "/targets/" + std::to_string(t);
    const auto accessor = targets[t].find("POSITION");
    if (accessor == targets[t].end()) continue;  // it moves normals or colours only
    const auto moves = file.vectors3(static_cast<std::size_t>(accessor->second), place + "/POSITION");
    if (!file.failed() && moves.size() != positions.size())
      file.fail(place + "/POSITION", "count differs from the mesh's positions");
    if (file.failed()) return;
    for (std::size_t i = 0; i < positions.size(); ++i)
      positions[i] = (positions[i].cast<double>() + weights[t] * moves[i].cast<double>()).cast<float>();
  }
}

struct Influences {
  std::vector<float> joints, weights;  // four for each vertex
};

std::vector<Influences> influences(GltfFile& file, GltfPrimitive& primitive, std::size_t count) {
  std::vector<Influences> sets;
  for (std::size_t n = 0; primitive.accessor("JOINTS_" + std::to_string(n)) && !file.failed(); ++n) {
    std::size_t of_joints = 0, of_weights = 0;
    Influences set{primitive.floats("JOINTS_" + std::to_string(n), of_joints),
                   primitive.floats("WEIGHTS_" + std::to_string(n), of_weights)};
    const bool right =
        of_joints == 4 && of_weights == 4 && set.joints.size() == 4 * count && set.weights.size() == 4 * count;
    if (!right)
      file.fail(primitive.place() + "/attributes/JOINTS_" + std::to_string(n),
                "requires four joints and four weights per vertex");
    sets.push_back(std::move(set));
  }
  return sets;
}

// glTF 2.0 §3.7.3.3: the weighted sum of what each joint makes of the vertex.
void skin(GltfFile& file, GltfPrimitive& primitive, const std::vector<Eigen::Affine3d>& joints, Positions& positions) {
  const auto sets = influences(file, primitive, positions.size());
  for (std::size_t i = 0; !sets.empty() && !file.failed() && i < positions.size(); ++i) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double total = 0;
    for (const auto& set : sets)
      for (std::size_t k = 4 * i; k < 4 * i + 4; ++k) {
        const double weight = set.weights[k];
        if (weight == 0) continue;
        if (!(set.joints[k] >= 0 && set.joints[k] < static_cast<float>(joints.size())))
          return file.fail(primitive.place() + "/attributes",
                           "vertex " + std::to_string(i) + " refers to joint " + std::to_string(set.joints[k]) +
                               ", but the skin has " + std::to_string(joints.size()));
        sum += weight * (joints[static_cast<std::size_t>(set.joints[k])] * positions[i].cast<double>());
        total += weight;
      }
    if (total != 0)
      positions[i] = (sum / total).cast<float>();  // the weights of an honest file sum to 1 but for rounding
  }
}

}  // namespace

void applyPose(GltfFile& file, GltfPrimitive& primitive, const GltfPose& pose, Positions& positions) {
  if (!pose.weights.empty()) morph(file, primitive, pose.weights, positions);
  if (!pose.joints.empty()) skin(file, primitive, pose.joints, positions);
  if (pose == GltfPose{}) return;
  for (std::size_t i = 0; !file.failed() && i < positions.size(); ++i)
    if (!positions[i].allFinite())
      file.fail(primitive.place(), "vertex " + std::to_string(i) + " is not finite in the pose of its node");
}

}  // namespace standpoint
