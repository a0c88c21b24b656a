// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/gltf_companions.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <span>
#include <string_view>

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

void use(Json& json, const char* extension) {
  auto& used = json["extensionsUsed"];
  if (std::find(used.begin(), used.end(), extension) == used.end()) used.push_back(extension);
}

class LevelWriter {
 public:
  LevelWriter(GltfScene& scene, const Environment& finest, const std::vector<GltfLevel>& levels)
      : scene_(scene), finest_(finest), levels_(levels), bounds_(productBounds(finest)) {}

  void add(std::uint32_t product, std::size_t node) {
    Json ids = Json::array(), coverage = Json::array();
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
    auto& json = scene_.json["nodes"][node];
    json["extensions"]["MSFT_lod"]["ids"] = std::move(ids);
    json["extras"]["MSFT_screencoverage"] = std::move(coverage);
    use(scene_.json, "MSFT_lod");
  }

 private:
  // Not in the scene's tree: readers that do not know levels show the finest. Empty where nothing of the product is
  // left.
  std::size_t levelNode(std::uint32_t product, std::size_t level, std::span<const Instance> instances) {
    const auto name = fmt::format("{} LOD{}", finest_.products[product].name, level + 1);
    Json parts = Json::array();
    for (const auto& instance : instances) {
      const auto index = scene_.node(instance, scene_.mesh(levels_[level].environment->meshes[instance.mesh], name));
      scene_.json["nodes"][index].erase("extras");
      parts.push_back(index);
    }
    if (parts.size() != 1) {
      scene_.json["nodes"].push_back(Json::object());
      if (!parts.empty()) scene_.json["nodes"].back()["children"] = parts;
      parts = Json::array({scene_.json["nodes"].size() - 1});
    }
    auto& node = scene_.json["nodes"][parts[0].get<std::size_t>()];
    node["name"] = name;
    node["extras"]["standpoint"] = {{"level", levels_[level].name},
                                    {"max_deviation_m", levels_[level].max_deviation_m[product]},
                                    {"mean_deviation_m", levels_[level].mean_deviation_m[product]}};
    return parts[0];
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

class CollisionWriter {
 public:
  CollisionWriter(GltfScene& scene, const Environment& model, const GltfCollision& collision,
                  const std::map<std::uint32_t, std::size_t>& node_of_product)
      : scene_(scene), model_(model), collision_(collision), node_of_product_(node_of_product) {}

  std::vector<std::size_t> run() {
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
      if (!rename(product)) return;
      return place(shape, fmt::format("UCX_{}_{:02}", render_name_[product], ++count_[product]), true);
    }
    if (collision_.naming == CollisionNaming::godot)
      return place(shape, name + (convex ? "-convcolonly" : "-colonly"), true);
    place(shape, name + " shape", false);
    Json body = {{"name", name + " collider"}};
    body["extensions"]["KHR_physics_rigid_bodies"]["collider"]["geometry"] = {{"node", scene_.json["nodes"].size() - 1},
                                                                              {"convexHull", convex}};
    body["extras"]["standpoint"] = {{"collision", true}};
    use(scene_.json, "KHR_physics_rigid_bodies");
    roots_.push_back(scene_.json["nodes"].size());
    scene_.json["nodes"].push_back(std::move(body));
  }

  void place(const Instance& shape, const std::string& name, bool in_scene) {
    const auto node = scene_.node(shape, scene_.bare(collision_.shapes->meshes[shape.mesh], name));
    scene_.json["nodes"][node]["name"] = name;
    scene_.json["nodes"][node]["extras"] = {{"standpoint", {{"collision", true}}}};
    if (in_scene) roots_.push_back(node);
  }

  // The product's first mesh carries the shapes; a mesh that several products share, those of the first.
  bool rename(std::uint32_t product) {
    if (render_name_.contains(product)) return !render_name_[product].empty();
    auto& name = render_name_[product];
    const auto instances = instancesOf(model_, product);
    if (instances.empty() || !named_.insert(model_.meshes[instances.front().mesh].get()).second) return false;
    name = renderName(model_.products[product].name, product);
    const auto mesh = scene_.mesh(model_.meshes[instances.front().mesh], name);
    scene_.json["meshes"][mesh]["name"] = name;
    if (const auto node = node_of_product_.find(product); node != node_of_product_.end())
      scene_.json["nodes"][node->second]["name"] = name;
    return true;
  }

  GltfScene& scene_;
  const Environment& model_;
  const GltfCollision& collision_;
  const std::map<std::uint32_t, std::size_t>& node_of_product_;
  std::map<std::uint32_t, std::string> render_name_;
  std::map<std::uint32_t, int> count_;
  std::set<const Mesh*> named_;
  std::vector<std::size_t> roots_;
};

}  // namespace

void addGltfLevels(GltfScene& scene, const Environment& finest, const std::vector<GltfLevel>& levels,
                   const std::map<std::uint32_t, std::size_t>& node_of_product) {
  if (levels.empty()) return;
  LevelWriter writer(scene, finest, levels);
  for (const auto& [product, node] : node_of_product) writer.add(product, node);
  auto& list = scene.json["asset"]["extras"]["standpoint"]["levels"];
  for (const auto& level : levels)
    list.push_back({{"level", level.name},
                    {"triangles", triangleCount(*level.environment)},
                    {"classes", lossByClass(finest, level)}});
}

std::vector<std::size_t> addGltfCollision(GltfScene& scene, const Environment& model, const GltfCollision& collision,
                                          const std::map<std::uint32_t, std::size_t>& node_of_product) {
  return CollisionWriter(scene, model, collision, node_of_product).run();
}

bool isGltfCollision(const Json& node) {
  if (!node.is_object()) return false;
  if (const auto extras = node.find("extras"); extras != node.end() && extras->is_object())
    if (const auto ours = extras->find("standpoint");
        ours != extras->end() && ours->is_object() && ours->value("collision", Json()) == true)
      return true;
  const auto named = node.find("name");
  if (named == node.end() || !named->is_string()) return false;
  std::string name = *named;
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const std::string_view view = name;
  for (const char* prefix : {"ucx_", "ubx_", "usp_", "ucp_"})
    if (view.starts_with(prefix)) return true;
  return view.ends_with("-colonly") || view.ends_with("-convcolonly");
}

}  // namespace standpoint
