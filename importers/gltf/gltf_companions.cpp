// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/gltf_companions.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <span>

#include <fmt/format.h>

namespace standpoint {

namespace {

using Json = nlohmann::json;

constexpr double kSeenAt = 1e-3;  // of the screen's height: a deviation that is larger shows

std::span<const Instance> instancesOf(const Environment& environment, std::uint32_t product) {
  const auto range =
      std::equal_range(environment.instances.begin(), environment.instances.end(), Instance{0, product, {}},
                       [](const Instance& a, const Instance& b) { return a.product < b.product; });
  return {range.first, range.second};
}

bool sameMeshes(const Environment& a, std::span<const Instance> of_a, const Environment& b,
                std::span<const Instance> of_b) {
  return std::equal(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), [&](const Instance& x, const Instance& y) {
    return a.meshes[x.mesh] == b.meshes[y.mesh] && x.world_from_mesh.matrix() == y.world_from_mesh.matrix();
  });
}

// The share of the screen's area that a product takes where a deviation of it begins to show.
double coverageAt(double deviation_m, double diagonal_m) {
  const double height = deviation_m > 0 ? kSeenAt * diagonal_m / deviation_m : 1;
  return std::min(1.0, height * height);
}

void use(tinygltf::Model& model, const char* extension) {
  auto& used = model.extensionsUsed;
  if (std::find(used.begin(), used.end(), extension) == used.end()) used.emplace_back(extension);
}

int addNode(tinygltf::Model& model, tinygltf::Node node) {
  model.nodes.push_back(std::move(node));
  return static_cast<int>(model.nodes.size() - 1);
}

// tinygltf from 2.9 on has a member for them and drops an extension of that name.
template <class Node>
void nameLevels(Node& node, const std::vector<int>& ids) {
  if constexpr (requires { node.lods; })
    node.lods = ids;
  else
    node.extensions["MSFT_lod"] = gltfValue({{"ids", ids}});
}

class LevelWriter {
 public:
  LevelWriter(GltfScene& scene, const Environment& finest, const std::vector<GltfLevel>& levels)
      : scene_(scene), finest_(finest), levels_(levels), bounds_(productBounds(finest)) {}

  void add(std::uint32_t product, int node) {
    std::vector<int> ids;
    Json coverage = Json::array();
    const Environment* last = &finest_;
    auto shown = instancesOf(finest_, product);
    double smallest = 1;
    for (std::size_t k = 0; k < levels_.size(); ++k) {
      const auto simpler = instancesOf(*levels_[k].environment, product);
      if (sameMeshes(*last, shown, *levels_[k].environment, simpler)) continue;
      last = levels_[k].environment;
      shown = simpler;
      ids.push_back(levelNode(product, k, simpler));
      smallest = std::min(smallest, coverageAt(levels_[k].max_deviation_m[product], bounds_[product].diagonal()));
      coverage.push_back(smallest);
    }
    if (ids.empty()) return;
    coverage.push_back(0);
    auto& shown_node = nodeAt(node);
    nameLevels(shown_node, ids);
    memberOf(shown_node.extras, "MSFT_screencoverage") = gltfValue(coverage);
    use(scene_.model, "MSFT_lod");
  }

 private:
  tinygltf::Node& nodeAt(int index) { return scene_.model.nodes[static_cast<std::size_t>(index)]; }

  // Not in the scene's tree: readers that do not know levels show the finest. Empty where nothing of the product is
  // left.
  int levelNode(std::uint32_t product, std::size_t level, std::span<const Instance> instances) {
    const auto name = fmt::format("{} LOD{}", finest_.products[product].name, level + 1);
    std::vector<int> parts;
    for (const auto& instance : instances) {
      parts.push_back(scene_.node(instance, scene_.mesh(levels_[level].environment->meshes[instance.mesh], name)));
      nodeAt(parts.back()).extras = {};
    }
    const int whole = parts.size() == 1 ? parts[0] : addNode(scene_.model, {});
    if (parts.size() > 1) nodeAt(whole).children = parts;
    nodeAt(whole).name = gltfName(name);
    nodeAt(whole).extras = gltfValue({{"standpoint",
                                       {{"level", levels_[level].name},
                                        {"max_deviation_m", levels_[level].max_deviation_m[product]},
                                        {"mean_deviation_m", levels_[level].mean_deviation_m[product]}}}});
    return whole;
  }

  GltfScene& scene_;
  const Environment& finest_;
  const std::vector<GltfLevel>& levels_;
  std::vector<Bounds> bounds_;
};

// What a class of products loses at most and in the mean of its products, for whoever chooses a level.
Json lossByClass(const Environment& finest, const GltfLevel& level) {
  Json classes = Json::object();
  std::map<std::string, std::size_t> counts;
  for (std::size_t i = 0; i < finest.products.size(); ++i) {
    if (instancesOf(finest, static_cast<std::uint32_t>(i)).empty()) continue;
    auto& row = classes[finest.products[i].ifc_class];
    if (row.is_null()) row = {{"max_deviation_m", 0.0}, {"mean_deviation_m", 0.0}};
    ++counts[finest.products[i].ifc_class];
    row["max_deviation_m"] = std::max(row["max_deviation_m"].get<double>(), level.max_deviation_m[i]);
    row["mean_deviation_m"] = row["mean_deviation_m"].get<double>() + level.mean_deviation_m[i];
  }
  for (auto& [name, row] : classes.items())
    row["mean_deviation_m"] = row["mean_deviation_m"].get<double>() / static_cast<double>(counts[name]);
  return classes;
}

// Unreal finds the shapes of a mesh by its name, so that it must be one word and no other's.
std::string renderName(const std::string& name, std::uint32_t product) {
  std::string word;
  for (const char c : name)
    word += std::isalnum(static_cast<unsigned char>(c)) != 0 && static_cast<unsigned char>(c) < 128 ? c : '_';
  return fmt::format("{}_{}", word.empty() ? "Object" : word, product);
}

tinygltf::Value collisionExtras() { return gltfValue({{"standpoint", {{"collision", true}}}}); }

class CollisionWriter {
 public:
  CollisionWriter(GltfScene& scene, const Environment& model, const GltfCollision& collision,
                  const std::map<std::uint32_t, int>& node_of_product)
      : scene_(scene), model_(model), collision_(collision), node_of_product_(node_of_product) {}

  std::vector<int> run() {
    for (std::size_t i = 0; i < collision_.shapes->instances.size(); ++i) add(i);
    return std::move(roots_);
  }

 private:
  void add(std::size_t index) {
    const Instance& shape = collision_.shapes->instances[index];
    const bool convex = collision_.convex[index];
    const auto product = shape.product;
    const auto& name = model_.products[product].name;
    if (collision_.naming == CollisionNaming::unreal) {
      if (!convex || !rename(product)) return;
      return place(shape, fmt::format("UCX_{}_{:02}", render_name_[product], ++count_[product]), true);
    }
    if (collision_.naming == CollisionNaming::godot)
      return place(shape, name + (convex ? "-convcolonly" : "-colonly"), true);
    place(shape, name + " shape", false);
    const Json geometry = {{"node", scene_.model.nodes.size() - 1}, {"convexHull", convex}};
    tinygltf::Node body;
    body.name = gltfName(name + " collider");
    body.extensions["KHR_physics_rigid_bodies"] = gltfValue({{"collider", {{"geometry", geometry}}}});
    body.extras = collisionExtras();
    use(scene_.model, "KHR_physics_rigid_bodies");
    roots_.push_back(addNode(scene_.model, std::move(body)));
  }

  void place(const Instance& shape, const std::string& name, bool in_scene) {
    const int index = scene_.node(shape, scene_.bare(collision_.shapes->meshes[shape.mesh], name));
    auto& node = scene_.model.nodes[static_cast<std::size_t>(index)];
    node.name = gltfName(name);
    node.extras = collisionExtras();
    if (in_scene) roots_.push_back(index);
  }

  // The product's first mesh carries the shapes; a mesh that several products share, those of the first.
  bool rename(std::uint32_t product) {
    if (render_name_.contains(product)) return !render_name_[product].empty();
    auto& name = render_name_[product];
    const auto instances = instancesOf(model_, product);
    if (instances.empty() || !named_.insert(model_.meshes[instances.front().mesh].get()).second) return false;
    name = renderName(model_.products[product].name, product);
    const int mesh = scene_.mesh(model_.meshes[instances.front().mesh], name);
    if (mesh >= 0) scene_.model.meshes[static_cast<std::size_t>(mesh)].name = name;
    if (const auto node = node_of_product_.find(product); node != node_of_product_.end())
      scene_.model.nodes[static_cast<std::size_t>(node->second)].name = name;
    return true;
  }

  GltfScene& scene_;
  const Environment& model_;
  const GltfCollision& collision_;
  const std::map<std::uint32_t, int>& node_of_product_;
  std::map<std::uint32_t, std::string> render_name_;
  std::map<std::uint32_t, int> count_;
  std::set<const Mesh*> named_;
  std::vector<int> roots_;
};

}  // namespace

void addGltfLevels(GltfScene& scene, const Environment& finest, const std::vector<GltfLevel>& levels,
                   const std::map<std::uint32_t, int>& node_of_product) {
  if (levels.empty()) return;
  LevelWriter writer(scene, finest, levels);
  for (const auto& [product, node] : node_of_product) writer.add(product, node);
  Json list = Json::array();
  for (const auto& level : levels)
    list.push_back({{"level", level.name},
                    {"triangles", triangleCount(*level.environment)},
                    {"classes", lossByClass(finest, level)}});
  memberOf(memberOf(scene.model.asset.extras, "standpoint"), "levels") = gltfValue(list);
}

std::vector<int> addGltfCollision(GltfScene& scene, const Environment& model, const GltfCollision& collision,
                                  const std::map<std::uint32_t, int>& node_of_product) {
  return CollisionWriter(scene, model, collision, node_of_product).run();
}

bool isGltfCollision(const tinygltf::Node& node) {
  const auto extras = gltfExtras(node);
  if (memberOf(memberOf(extras, "standpoint"), "collision") == true) return true;
  std::string name = node.name;
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const char* prefix : {"ucx_", "ubx_", "usp_", "ucp_"})
    if (name.starts_with(prefix)) return true;
  return name.ends_with("-colonly") || name.ends_with("-convcolonly");
}

}  // namespace standpoint
