// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/gltf_scene.h"

#include <algorithm>

namespace standpoint {

namespace {

Eigen::Affine3d compose(const std::vector<double>& t, const std::vector<double>& r, const std::vector<double>& s) {
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  if (!r.empty()) {
    const Eigen::Quaterniond q(r[3], r[0], r[1], r[2]);
    if (q.norm() > 0) result.linear() = q.normalized().toRotationMatrix();
  }
  if (!s.empty()) result.linear() = result.linear() * Eigen::Vector3d(s[0], s[1], s[2]).asDiagonal();
  if (!t.empty()) result.translation() = Eigen::Vector3d(t[0], t[1], t[2]);
  return result;
}

Eigen::Affine3d placement(const tinygltf::Node& node) {
  if (node.matrix.empty()) return compose(node.translation, node.rotation, node.scale);
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 3; ++r) result.matrix()(r, c) = node.matrix[static_cast<std::size_t>(4 * c + r)];
  return result;
}

// Indices such as /scenes/0/nodes, last first, ready for a stack.
std::vector<std::size_t> reversed(const std::vector<int>& list) { return {list.rbegin(), list.rend()}; }

std::vector<std::size_t> rootNodes(const GltfFile& file) {
  const auto& nodes = file.model().nodes;
  std::vector<bool> is_child(nodes.size(), false);
  for (const auto& node : nodes)
    for (const auto child : reversed(node.children))
      if (child < is_child.size()) is_child[child] = true;
  std::vector<std::size_t> roots;
  for (std::size_t i = is_child.size(); i-- > 0;)
    if (!is_child[i]) roots.push_back(i);
  return roots;
}

using Visit = std::function<void(const GltfNode&)>;

// From the given roots, last first.
std::vector<bool> walk(GltfFile& file, const std::vector<std::size_t>& roots, const std::string& from,
                       const Visit& visit) {
  struct Entry {
    std::size_t index;
    GltfNode parent;
    std::string asked_by;
  };
  std::vector<Entry> stack;
  const auto push = [&](const std::vector<std::size_t>& last_first, const GltfNode& parent,
                        const std::string& asked_by) {
    for (const auto index : last_first) stack.push_back({index, parent, asked_by});
  };
  push(roots, {}, from);
  std::vector<bool> seen(file.model().nodes.size(), false);
  while (!stack.empty() && !file.failed()) {
    const Entry entry = std::move(stack.back());
    stack.pop_back();
    GltfNode node = entry.parent;
    node.index = entry.index;
    node.place = "/nodes/" + std::to_string(entry.index);
    node.gltf = &file.element(file.model().nodes, "nodes", entry.index, entry.asked_by);
    if (file.failed()) break;
    if (seen[entry.index]) {
      file.fail(node.place, "has two parents: node hierarchies must be trees");
      break;
    }
    seen[entry.index] = true;
    node.world_from_node = entry.parent.world_from_node * placement(*node.gltf);
    if (!node.world_from_node.matrix().allFinite()) file.fail(node.place, "its placement is not finite");
    const auto extras = gltfExtras(*node.gltf);
    const auto& ours = memberOf(extras, "standpoint");
    if (const auto product = file.index(ours, "product", node.place + "/extras/standpoint");
        product && product != node.product) {
      node.product = product;
      node.product_node = node.gltf;
    }
    if (file.failed()) break;
    visit(node);
    push(reversed(node.gltf->children), node, node.place);
  }
  return seen;
}

}  // namespace

std::vector<bool> walkScene(GltfFile& file, const Visit& visit) {
  if (file.failed()) return {};
  const auto& model = file.model();
  if (model.scenes.empty()) return walk(file, rootNodes(file), "", visit);
  const auto scene = gltfIndex(model.defaultScene).value_or(0);
  const std::string place = "/scenes/" + std::to_string(scene);
  return walk(file, reversed(file.element(model.scenes, "scenes", scene, "/scene").nodes), place, visit);
}

std::vector<Eigen::Affine3d> jointsOf(GltfFile& file, std::size_t skin, const std::string& asked_by) {
  const std::string place = "/skins/" + std::to_string(skin);
  const auto& gltf = file.element(file.model().skins, "skins", skin, asked_by);
  const std::vector<std::size_t> joints(gltf.joints.begin(), gltf.joints.end());
  std::vector<float> inverse_bind;
  if (const auto accessor = gltfIndex(gltf.inverseBindMatrices)) {
    inverse_bind = file.floats(*accessor, 16, place + "/inverseBindMatrices");
    if (inverse_bind.size() < 16 * joints.size())
      file.fail(place + "/inverseBindMatrices", "has fewer matrices than the skin has joints");
  }
  std::vector<Eigen::Affine3d> world(file.model().nodes.size(), Eigen::Affine3d::Identity());
  walk(file, rootNodes(file), "", [&](const GltfNode& node) { world[node.index] = node.world_from_node; });
  std::vector<Eigen::Affine3d> result;
  for (std::size_t i = 0; i < joints.size() && !file.failed(); ++i) {
    if (joints[i] >= world.size())
      file.fail(place + "/joints/" + std::to_string(i), "refers to a node that does not exist");
    if (file.failed()) break;
    Eigen::Affine3d bind = Eigen::Affine3d::Identity();
    if (!inverse_bind.empty())
      bind.matrix().topRows<3>() =
          Eigen::Map<const Eigen::Matrix4f>(inverse_bind.data() + 16 * i).cast<double>().topRows<3>();
    result.push_back(world[joints[i]] * bind);
  }
  return file.failed() ? std::vector<Eigen::Affine3d>{} : result;
}

std::vector<Eigen::Affine3d> instancesOf(GltfFile& file, const GltfNode& node) {
  const auto extension = gltfExtension(*node.gltf, "EXT_mesh_gpu_instancing");
  if (!extension.is_object()) return {Eigen::Affine3d::Identity()};
  const std::string place = node.place + "/extensions/EXT_mesh_gpu_instancing/attributes";
  const auto column = [&](const char* name, std::size_t components) {
    const auto accessor = file.index(memberOf(extension, "attributes"), name, place);
    return accessor ? file.floats(*accessor, components, place + "/" + name) : std::vector<float>{};
  };
  const auto t = column("TRANSLATION", 3), r = column("ROTATION", 4), s = column("SCALE", 3);
  const std::size_t count = std::max({t.size() / 3, r.size() / 4, s.size() / 3});
  const auto fits = [&](const std::vector<float>& values, std::size_t n) {
    return values.empty() || values.size() == n * count;
  };
  if (!fits(t, 3) || !fits(r, 4) || !fits(s, 3)) file.fail(place, "its accessors have different counts");
  if (file.failed() || !file.spend(count * sizeof(Eigen::Affine3d), place)) return {};
  std::vector<Eigen::Affine3d> result;
  for (std::size_t i = 0; i < count; ++i) {
    const auto row = [i](const std::vector<float>& values, std::size_t n) {
      return values.empty() ? std::vector<double>{}
                            : std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(i * n),
                                                  values.begin() + static_cast<std::ptrdiff_t>((i + 1) * n));
    };
    result.push_back(compose(row(t, 3), row(r, 4), row(s, 3)));
  }
  return result;
}

}  // namespace standpoint
